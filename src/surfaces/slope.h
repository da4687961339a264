// Slope of samples that may be missing.
#pragma once

#include <cmath>

namespace hl {

/// The change for each step from `before` to `after` around `here`, by central differences, or by one side if the other
/// is missing (not a number); 0 if both are. RT-safe.
inline double slopeOf(double before, double here, double after) {
  if (std::isnan(before)) return std::isnan(after) ? 0 : after - here;
  return std::isnan(after) ? here - before : (after - before) / 2;
}

}  // namespace hl
