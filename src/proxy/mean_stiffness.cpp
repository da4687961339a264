#include "proxy/mean_stiffness.h"

#include <algorithm>

namespace hl {

void MeanStiffness::add(double multiplier_m, double stiffness) {
  const double weight_m = std::max(0.0, multiplier_m);
  weights_m_ += weight_m;
  weighted_m_ += weight_m * stiffness;
  least_ = std::min(least_, stiffness);
  most_ = std::max(most_, stiffness);
}

double MeanStiffness::value() const {
  if (empty()) return 1;
  return weights_m_ > 0 ? std::clamp(weighted_m_ / weights_m_, least_, most_) : least_;
}

}  // namespace hl
