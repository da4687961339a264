#include "proxy/anderson_mixing.h"

#include <cmath>

#include "proxy/tolerances.h"

namespace hl {

Vec3 AndersonMixing::mixed(const Vec3& next, const Vec3& change) const {
  if (passes_ == 0) return next;
  const Vec3 turn = change - last_change_, older_turn = last_change_ - older_change_;
  const double a = turn.squaredNorm(), b = turn.dot(older_turn), c = older_turn.squaredNorm();
  const double with_turn = change.dot(turn), with_older = change.dot(older_turn);
  const double det = a * c - b * b;
  if (passes_ > 1 && det > convergence::kParallelSquared * a * c) {
    const double g1 = (c * with_turn - b * with_older) / det;
    const double g2 = (a * with_older - b * with_turn) / det;
    if (std::abs(g1) < convergence::kMaxMixing && std::abs(g2) < convergence::kMaxMixing)
      return next - g1 * (next - last_next_) - g2 * (last_next_ - older_next_);
  }
  const double g1 = with_turn / a;
  return std::abs(g1) < convergence::kMaxMixing ? Vec3(next - g1 * (next - last_next_)) : next;
}

Vec3 AndersonMixing::guess(const Vec3& next, const Vec3& change) {
  const Vec3 result = mixed(next, change);
  ++passes_;
  older_next_ = last_next_;
  older_change_ = last_change_;
  last_next_ = next;
  last_change_ = change;
  return result;
}

}  // namespace hl
