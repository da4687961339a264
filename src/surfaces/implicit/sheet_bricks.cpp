#include "surfaces/implicit/sheet_bricks.h"

#include <algorithm>
#include <cmath>

#include "surfaces/implicit/sheet_measure.h"

namespace hl {

namespace {

// Of sizes: more than what rounding does to a few sums.
constexpr double kPlaneRounding = 1e-13, kTriangleRounding = 1e-12;

}  // namespace

SheetBricks::SheetBricks(const Sheet& sheet, const GridFrame& frame, const GridBall* ball)
    : sheet_(sheet), frame_(frame), ball_(ball) {}

std::array<Vec3, 3> SheetBricks::placed(const std::array<Vec3, 3>& corners) const {
  std::array<Vec3, 3> result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = frame_.point(corners[i].x(), corners[i].y(), corners[i].z());
  return result;
}

bool SheetBricks::holds(int level, const Place& at) {
  const Box box = sheet_.boxOf(level, at);
  const SmoothFunction::Space space = spaceOf(box, 0);
  const Jet<Interval, 1> jet = sheet_.smooth().slopeOver(space);
  if (!jet.value.holds(0)) return false;
  middle_ = box.centre();
  value_ = sheet_.smooth().at(middle_);
  double across = 0;
  rest_ = kPlaneRounding * (std::abs(value_) + middle_.cwiseAbs().maxCoeff());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double half = space[axis].half();
    rest_ += jet.slope[axis].half() * half;
    normal_[static_cast<Eigen::Index>(axis)] = jet.slope[axis].middle();
    across += std::abs(jet.slope[axis].middle()) * half;
  }
  if (std::isfinite(rest_)) {
    if (std::abs(value_) > rest_ + across) return false;
    if (!planeIsNear()) return false;
  }
  return level > 0 || mayBeSurface(space);
}

// The value of the plane changes by |normal per metre| each metre.
bool SheetBricks::planeIsNear() const {
  if (ball_ == nullptr) return true;
  const double slope = (ball_->metric().inverse.transpose() * normal_).norm();
  const double from = value_ + normal_.dot(ball_->first() - middle_),
               to = value_ + normal_.dot(ball_->last() - middle_);
  const double reach = (1 + kTriangleRounding) * (ball_->radius() * slope + rest_);
  return std::min(from, to) <= reach && std::max(from, to) >= -reach;
}

bool SheetBricks::mayBeSurface(const SmoothFunction::Space& box) const {
  const auto conditions = sheet_.function().conditions(sheet_.number());
  return std::all_of(conditions.begin(), conditions.end(), [&](const ImplicitFunction::Condition& condition) {
    return mayHold(sheet_.function(), condition, sheet_.slack(), box);
  });
}

bool SheetBricks::mayCross(const Place& cell) const {
  if (!std::isfinite(rest_)) return true;
  const double value = value_ + normal_.dot(sheet_.boxOf(-1, cell).centre() - middle_);
  return std::abs(value) <= (rest_ + 0.5 * step() * normal_.cwiseAbs().sum()) * (1 + kTriangleRounding);
}

// By the plane of the triangle, and by a ball around it.
bool SheetBricks::isNear(const std::array<Vec3, 3>& triangle) const {
  if (ball_ == nullptr) return true;
  const auto& [a, b, c] = triangle;
  const Vec3 first = frame_.point(ball_->first().x(), ball_->first().y(), ball_->first().z());
  const Vec3 last = frame_.point(ball_->last().x(), ball_->last().y(), ball_->last().z());
  const double size = first.cwiseAbs().maxCoeff() + last.cwiseAbs().maxCoeff() + a.cwiseAbs().maxCoeff();
  const double reach = ball_->radius() + kTriangleRounding * size;
  const Vec3 middle = (a + b + c) / 3, way = last - first;
  const double around =
      std::sqrt(std::max({(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()}));
  const double square = way.squaredNorm();
  const double part = square > 0 ? std::clamp((middle - first).dot(way) / square, 0.0, 1.0) : 0;
  if ((first + part * way - middle).norm() > reach + around) return false;
  const Vec3 normal = (b - a).cross(c - a);
  const double from = normal.dot(first - middle), to = normal.dot(last - middle);
  // The normal of a sliver has few digits: those are kept.
  const double far = reach * normal.norm() + kTriangleRounding * around * around * (size + around);
  return std::min(from, to) <= far && std::max(from, to) >= -far;
}

}  // namespace hl
