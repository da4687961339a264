#include "surfaces/implicit/sheet_bricks.h"

#include <algorithm>
#include <cmath>

#include "surfaces/implicit/plane_reach.h"
#include "surfaces/implicit/sheet_measure.h"

namespace hl {

namespace {

// Of sizes: more than what rounding does to a few sums.
constexpr double kPlaneRounding = 1e-13, kTriangleRounding = 1e-12;
/// From this level on bricks are so large that planes tell nothing.
constexpr int kNoPlane = 2;
/// The normals of triangles that are flatter have fewer digits than kNormalRounding says.
constexpr double kFlattest = 1e-6, kNormalRounding = 1e-9;

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
  if (level >= kNoPlane) {
    low_ = ball_ != nullptr ? ball_->low() : box.min;
    high_ = ball_ != nullptr ? ball_->high() : box.max;
    return sheet_.smooth().over(space).holds(0);
  }
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
  if (std::isfinite(rest_) && std::abs(value_) > rest_ + across) return false;
  if (ball_ != nullptr) {
    const PlaneReach reach(*ball_, middle_, value_, normal_, rest_);
    if (reach.misses()) return false;
    low_ = reach.low();
    high_ = reach.high();
    if ((low_.array() > box.max.array()).any() || (high_.array() < box.min.array()).any()) return false;
  }
  return level > 0 || mayBeSurface(space);
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

// What is near in the plane of the triangle is in a disc around the feet of the centre there.
bool SheetBricks::isNear(const std::array<Vec3, 3>& triangle) const {
  if (ball_ == nullptr) return true;
  const auto& [a, b, c] = triangle;
  const Vec3 first = frame_.point(ball_->first().x(), ball_->first().y(), ball_->first().z());
  const Vec3 last = frame_.point(ball_->last().x(), ball_->last().y(), ball_->last().z());
  const double size = first.cwiseAbs().maxCoeff() + last.cwiseAbs().maxCoeff() + a.cwiseAbs().maxCoeff();
  const double radius = ball_->radius() + kTriangleRounding * size;
  const Vec3 middle = (a + b + c) / 3;
  const double around =
      std::sqrt(std::max({(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()}));
  const Vec3 across = (b - a).cross(c - a);
  const double length = across.norm();
  const Vec3 normal = length > kFlattest * around * around ? Vec3(across / length) : Vec3::Zero();
  const double from = normal.dot(first - middle), to = normal.dot(last - middle);
  const double depth = (from > 0) != (to > 0) ? 0 : std::min(std::abs(from), std::abs(to)) * (1 - kNormalRounding);
  if (depth > radius) return false;
  const Vec3 foot = first - from * normal, way = (last - to * normal) - foot;
  const double square = way.squaredNorm();
  const double part = square > 0 ? std::clamp((middle - foot).dot(way) / square, 0.0, 1.0) : 0;
  const double reach = std::sqrt(radius * radius - depth * depth) + around;
  return (foot + part * way - middle).norm() <= reach * (1 + kNormalRounding) + kNormalRounding * radius;
}

}  // namespace hl
