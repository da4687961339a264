#include "control/watchdog.h"

namespace hl {

bool Watchdog::look(std::uint64_t steps) {
  if (steps != steps_) {
    steps_ = steps;
    unmoved_ = 0;
    return false;
  }
  if (unmoved_ < looks_ && ++unmoved_ == looks_) return true;
  return false;
}

}  // namespace hl
