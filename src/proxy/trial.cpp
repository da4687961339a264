#include "proxy/trial.h"

#include <algorithm>

#include "proxy/tolerances.h"

namespace hl {

void Trial::begin(const Vec3& checkpoint) {
  checkpoint_ = checkpoint;
  descents_ = 0;
}

bool Trial::judge(const Goal& goal, bool last, Vec3& position) {
  if (!open() || descents_ == 0) return false;
  if (!last && descents_ < convergence::kMostDescents && !goal.nearer(position, *checkpoint_)) return false;
  return conclude(goal, position);
}

bool Trial::conclude(const Goal& goal, Vec3& position) {
  if (!open()) return false;
  const Vec3 from = *checkpoint_;
  checkpoint_.reset();
  if (goal.nearer(position, from)) {
    boldness_ = std::min(convergence::kMostBoldness, boldness_ * convergence::kBolder);
    return false;
  }
  boldness_ = std::min(1.0, boldness_) / convergence::kBolder;
  back_off_.failed();
  const bool moved = position != from;
  position = from;
  return moved;
}

}  // namespace hl
