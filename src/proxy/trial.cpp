#include "proxy/trial.h"

#include <algorithm>

#include "proxy/tolerances.h"

namespace hl {

void Trial::begin(const Vec3& checkpoint) {
  checkpoint_ = checkpoint;
  descents_ = 0;
}

bool Trial::judge(const Goal& goal, double step_m, bool last, Vec3& position) {
  if (!open() || descents_ == 0) return false;
  const bool nearer = goal.nearer(position, *checkpoint_);
  if (!last && !nearer && descents_ < convergence::kMaxDescents && !hopeless(goal, step_m, position)) return false;
  return conclude(goal, position);
}

// A plain step of length s reduces half the squared distance to the goal by s^2 / 2, and by about as much again where
// the surface curves away below it. The trial is hopeless if all remaining steps together cannot make up the loss.
bool Trial::hopeless(const Goal& goal, double step_m, const Vec3& position) const {
  const Vec3 apart = position - *checkpoint_;
  const double lost_m2 = apart.squaredNorm() - 2 * apart.dot(goal.place() - *checkpoint_);
  return lost_m2 > 2 * (convergence::kMaxDescents - descents_) * step_m * step_m;
}

bool Trial::conclude(const Goal& goal, Vec3& position) {
  if (!open()) return false;
  const Vec3 from = *checkpoint_;
  checkpoint_.reset();
  if (goal.nearer(position, from)) {
    boldness_ = std::min(1.0, boldness_ * convergence::kBolder);
    back_off_.worked();
    return false;
  }
  boldness_ /= convergence::kLessBold;
  back_off_.failed();
  const bool moved = position != from;
  position = from;
  return moved;
}

}  // namespace hl
