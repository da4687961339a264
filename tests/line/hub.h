// Hub: the links between all ends of a line, and which of them a packet takes by its address. Like a link, it knows no
// clock and no socket.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "line/orders.h"

namespace hl::line {

/// 10.77.0.END
std::string addressOf(int end);

class Hub {
 public:
  static constexpr int kMaxEnds = 16;

  /// The links of other seeds lose other packets.
  Hub(int ends, std::uint64_t seed);

  /// Throws hl::Error and changes nothing when the order cannot be done. kCount does nothing.
  void obey(const Order& order);
  /// From one end to the one of its address; one to many goes to all others. What is no IPv4, what asks for groups
  /// (IGMP: each end is in all of them), and what has no such end is left out, uncounted.
  void put(int from, const Packet& packet, std::int64_t now_ns);
  /// Gives what is due to its end.
  void give(std::int64_t now_ns, const std::function<void(int end, const Packet&)>& give);
  /// When the next packet is due; Link::kNever_ns: nothing is on its way.
  std::int64_t due_ns() const;

  LinkCounts counts(int from, int to) const { return links_[index(from, to)].counts(); }
  /// A line of text for each direction.
  std::string describe() const;

 private:
  std::size_t index(int from, int to) const;
  template <typename Visit>
  void eachLink(const Visit& visit) const;

  int ends_;
  std::vector<Link> links_;  // ends_ by ends_; those of an end to itself do nothing
  std::vector<bool> cut_;
  bool multicast_ = true;
};

}  // namespace hl::line
