#include "share/peer_clock.h"

#include <algorithm>

namespace hl {

namespace {

constexpr std::int64_t kLongestRoundTrip_ns = 60'000'000'000;
// Of a clock: 36 years. Sums and differences of four of them stay numbers of 64 bits.
constexpr std::int64_t kLatest_ns = std::int64_t{1} << 60;

bool isTime(std::int64_t time_ns) { return time_ns > -kLatest_ns && time_ns < kLatest_ns; }

}  // namespace

void PeerClock::add(const Stamps& s) {
  if (!isTime(s.sent_here_ns) || !isTime(s.heard_there_ns) || !isTime(s.sent_there_ns) || !isTime(s.heard_here_ns))
    return;
  const std::int64_t round_trip_ns = (s.heard_here_ns - s.sent_here_ns) - (s.sent_there_ns - s.heard_there_ns);
  if (round_trip_ns < 0 || round_trip_ns > kLongestRoundTrip_ns) return;
  const std::int64_t twice_ns = (s.heard_there_ns - s.sent_here_ns) + (s.sent_there_ns - s.heard_here_ns);
  pairs_[added_++ % kPairs] = {round_trip_ns, twice_ns / 2};
}

const PeerClock::Pair* PeerClock::best() const {
  const auto end = pairs_.begin() + static_cast<std::ptrdiff_t>(std::min(added_, kPairs));
  const auto least = std::min_element(pairs_.begin(), end,
                                      [](const Pair& a, const Pair& b) { return a.round_trip_ns < b.round_trip_ns; });
  return least == end ? nullptr : &*least;
}

std::optional<std::int64_t> PeerClock::offset_ns() const {
  const Pair* const pair = best();
  return pair == nullptr ? std::nullopt : std::optional(pair->offset_ns);
}

std::int64_t PeerClock::roundTrip_ns() const {
  const Pair* const pair = best();
  return pair == nullptr ? 0 : pair->round_trip_ns;
}

}  // namespace hl
