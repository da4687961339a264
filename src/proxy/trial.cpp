#include "proxy/trial.h"

#include <algorithm>

namespace hl {

namespace {

// Steps until a trial must have paid off: on its way down the proxy may meet another surface first.
constexpr int kMostDescents = 8;

// By how much steps become bolder when one has paid off, and less bold when one has not.
constexpr double kBolder = 4, kMostBoldness = 1024;

}  // namespace

void Trial::begin(const Vec3& checkpoint) {
  checkpoint_ = checkpoint;
  descents_ = 0;
}

bool Trial::judge(const Goal& goal, bool last, Vec3& position) {
  if (!open() || descents_ == 0) return false;
  if (!last && descents_ < kMostDescents && !goal.nearer(position, *checkpoint_)) return false;
  return conclude(goal, position);
}

bool Trial::conclude(const Goal& goal, Vec3& position) {
  if (!open()) return false;
  const Vec3 from = *checkpoint_;
  checkpoint_.reset();
  if (goal.nearer(position, from)) {
    boldness_ = std::min(kMostBoldness, boldness_ * kBolder);
    return false;
  }
  boldness_ = std::min(1.0, boldness_) / kBolder;
  back_off_.failed();
  const bool moved = position != from;
  position = from;
  return moved;
}

}  // namespace hl
