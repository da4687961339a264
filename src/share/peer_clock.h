// PeerClock: how far the clock of another server is ahead of this one's, and how long a packet is under way. From four
// stamps, as NTP has it (RFC 5905, section 8): a beat of ours sent at t1 (our clock), heard there at t2 (their clock),
// and a beat of theirs that says so, sent at t3 (theirs), heard here at t4 (ours):
//   offset = ((t2 - t1) + (t3 - t4)) / 2,   round trip = (t4 - t1) - (t3 - t2)
// The offset is wrong by half of what one way takes longer than the other. Of the last pairs that of the shortest round
// trip counts, as it was held up least.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace hl {

/// One thread.
class PeerClock {
 public:
  struct Stamps {
    std::int64_t sent_here_ns, heard_there_ns, sent_there_ns, heard_here_ns;
  };
  /// Stamps that make no sense, with a round trip below 0 or above a minute, are left out.
  void add(const Stamps& stamps);
  /// Their clock less ours; nothing before the first pair.
  std::optional<std::int64_t> offset_ns() const;
  /// The shortest of the last pairs; 0 before the first.
  std::int64_t roundTrip_ns() const;

 private:
  struct Pair {
    std::int64_t round_trip_ns, offset_ns;
  };
  static constexpr std::size_t kPairs = 64;  // six seconds of beats: clocks of machines part by 0.3 ms in that time
  const Pair* best() const;

  std::array<Pair, kPairs> pairs_{};
  std::size_t added_ = 0;
};

}  // namespace hl
