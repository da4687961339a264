// Link: one direction of a line, between two of its ends: which packets come out of it, and when. It knows neither a
// clock nor a socket, and all chance in it comes from its seed, so that a test can say what happens to each packet.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <vector>

namespace hl::line {

/// One of IP, with its header.
using Packet = std::vector<char>;

struct LinkSettings {
  double delay_ms = 0;
  double jitter_ms = 0;  ///< the delay is uniform in delay_ms +- jitter_ms; at most delay_ms
  double loss_percent = 0;
  double rate_Mbit_s = 0;  ///< 0: as fast as they come
  bool reorder = false;    ///< false: a packet waits for those before it, so that with jitter the late ones decide
};

/// Packets since the start: taken = given + lost + cut + full + waiting.
struct LinkCounts {
  std::uint64_t taken = 0, given = 0;
  std::uint64_t lost = 0;  ///< by loss_percent
  std::uint64_t cut = 0;   ///< put on it, or on their way, while it was cut
  std::uint64_t full = 0;  ///< more than kMaxWaiting were on their way
  std::uint64_t waiting = 0;
};

class Link {
 public:
  /// So many packets at most are on their way: 15 MB.
  static constexpr std::size_t kMaxWaiting = 10'000;
  /// What take() waits for when there is nothing.
  static constexpr std::int64_t kNever_ns = INT64_MAX;

  explicit Link(std::uint64_t seed) : random_(seed) {}

  const LinkSettings& settings() const { return settings_; }
  /// For the packets to come; in range, see orders.h.
  void set(const LinkSettings& settings) { settings_ = settings; }
  /// Nothing comes through while it is; what is on its way is gone.
  void cut(bool cut);

  /// Times are of any one clock that does not go back.
  void put(Packet packet, std::int64_t now_ns);
  /// One that is due, the earliest first.
  std::optional<Packet> take(std::int64_t now_ns);
  /// When the next one is due.
  std::int64_t due_ns() const { return waiting_.empty() ? kNever_ns : waiting_.begin()->first; }

  LinkCounts counts() const;

 private:
  double uniform();

  std::mt19937_64 random_;
  LinkSettings settings_;
  bool cut_ = false;
  std::multimap<std::int64_t, Packet> waiting_;      // by when they are due; of the same time in the order they came
  std::int64_t last_due_ns_ = 0, rate_free_ns_ = 0;  // of the last packet; when its last bit is on the line
  LinkCounts counts_;
};

}  // namespace hl::line
