#include "control/watchdog.h"

namespace hl {

bool Watchdog::look(std::uint64_t steps) {
  // Before its first step the servo makes no force: there is nothing to stop.
  if (steps != steps_ || steps == 0) {
    steps_ = steps;
    unmoved_ = 0;
    return false;
  }
  if (unmoved_ < looks_ && ++unmoved_ == looks_) return true;
  return false;
}

}  // namespace hl
