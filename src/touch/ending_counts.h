// EndingCounts: how many ticks ended for which reason, so that those who run a session or a trace can distinguish those
// that were cut short from those that came to rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "proxy/tick_report.h"

namespace hl {

class EndingCounts {
 public:
  /// RT-safe.
  void add(Ending ending) { ++counts_[static_cast<std::size_t>(ending)]; }
  std::uint64_t operator[](Ending ending) const { return counts_[static_cast<std::size_t>(ending)]; }
  /// As TickReport::capped().
  std::uint64_t capped() const { return (*this)[Ending::kCapped]; }

  /// Calls use(ending, count) for each way in which a tick can end, in the order of Ending, also where the count is 0.
  template <typename Use>
  void each(Use&& use) const {
    for (std::size_t i = static_cast<std::size_t>(Ending::kGoesOn) + 1; i < kEndings; ++i)
      use(static_cast<Ending>(i), counts_[i]);
  }

 private:
  std::array<std::uint64_t, kEndings> counts_{};
};

}  // namespace hl
