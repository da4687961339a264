#include "surfaces/implicit/sheet_bricks.h"

#include <algorithm>
#include <cmath>

#include "surfaces/implicit/plane_reach.h"
#include "surfaces/implicit/sheet_measure.h"
#include "surfaces/implicit/slab_pieces.h"

namespace hl {

namespace {

// Of sizes: more than what rounding does to a few sums.
constexpr double kPlaneRounding = 1e-13, kTriangleRounding = 1e-12;

}  // namespace

SheetBricks::SheetBricks(const Sheet& sheet, const GridFrame& frame, const GridBall* ball)
    : sheet_(sheet), frame_(frame), ball_(ball) {}

bool SheetBricks::holds(int level, const Place& at) {
  const Box box = sheet_.boxOf(level, at);
  const SmoothFunction::Space space = spaceOf(box, 0);
  if (level > 0) curved_ = false;
  if (!(curved_ ? planeByBend(box) : planeBySlopes(level, box, space))) return false;
  crossing_ = (rest_ + 0.5 * partSide(level) * normal_.cwiseAbs().sum()) * (1 + kTriangleRounding);
  if (std::abs(value_) > rest_ + space[0].half() * normal_.cwiseAbs().sum()) return false;
  if (ball_ != nullptr) {
    const PlaneReach reach(*ball_, middle_, value_, normal_, rest_);
    if (reach.misses()) return false;
    low_ = reach.low();
    high_ = reach.high();
    if ((low_.array() > box.max.array()).any() || (high_.array() < box.min.array()).any()) return false;
  }
  return level > 0 || mayBeSurface(space);
}

// False: the function is not 0 in the box.
bool SheetBricks::planeBySlopes(int level, const Box& box, const SmoothFunction::Space& space) {
  cost_ += level == kBentLevel ? kCostOfBend : kCostOfBrick;
  Jet<Interval, 1> slopes;
  if (level == kBentLevel) {
    const Jet<Interval, 2> jet = sheet_.smooth().bendOver(space);
    slopes = {jet.value, jet.slope, {}};
    setBend(jet.bend);
  } else {
    slopes = sheet_.smooth().slopeOver(space);
  }
  if (!slopes.value.holds(0)) return false;
  middle_ = box.centre();
  value_ = sheet_.smooth().at(middle_);
  vary_ = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    normal_[static_cast<Eigen::Index>(axis)] = slopes.slope[axis].middle();
    vary_ += slopes.slope[axis].half();
  }
  rounding_ = kPlaneRounding * (std::abs(value_) + middle_.cwiseAbs().maxCoeff());
  rest_ = rounding_ + space[0].half() * vary_;
  if (level == kBentLevel) curved_ = restByBend(0.5 * step()) <= 0.25 * (0.5 * step()) * vary_;
  return true;
}

bool SheetBricks::planeByBend(const Box& box) {
  cost_ += kCostOfParts;
  middle_ = box.centre();
  const Jet<double, 1> jet = sheet_.smooth().slopeAt(middle_);
  value_ = jet.value;
  normal_ = {jet.slope[0], jet.slope[1], jet.slope[2]};
  rounding_ = kPlaneRounding * (std::abs(value_) + middle_.cwiseAbs().maxCoeff());
  rest_ = rounding_ + restByBend(0.5 * box.size().maxCoeff());
  return true;
}

void SheetBricks::setBend(const std::array<Interval, 6>& bend) {
  bend_ = 0;
  for (std::size_t i = 0; i < bend.size(); ++i)
    bend_ += (jet::kPairs[i][0] == jet::kPairs[i][1] ? 1 : 2) * bend[i].most();
}

double SheetBricks::partSide(int level) const {
  return step() * (level == 0 ? 1 : static_cast<double>(BrickPyramid::cells(level - 1)));
}

// Eight parts at once.
void SheetBricks::sift(int level, BrickParts& parts) {
  const double side = partSide(level), half = 0.5 * side;
  const bool curved = curved_ && level <= kBentLevel;
  const double rest = rounding_ + (curved ? restByBend(half) : half * vary_);
  if (!std::isfinite(rest)) return;
  const SlabPieces pieces(*ball_, frame_, side);
  std::size_t kept = 0;
  for (std::size_t first = 0; first < parts.size(); first += kCellCorners) {
    const std::size_t count = std::min<std::size_t>(kCellCorners, parts.size() - first);
    std::array<Lanes, 3> middles;
    std::array<Vec3, kCellCorners> middle;
    for (std::size_t i = 0; i < kCellCorners; ++i) {
      const auto& at = parts[first + std::min(i, count - 1)].at;
      middle[i] = origin() + side * Vec3(at[0] + 0.5, at[1] + 0.5, at[2] + 0.5);
      for (std::size_t axis = 0; axis < 3; ++axis) middles[axis].of[i] = middle[i][static_cast<Eigen::Index>(axis)];
    }
    cost_ += kCostOfParts;
    Jet<Lanes, 1> jet;
    curved ? void(jet = sheet_.smooth().slopeAt(middles)) : void(jet.value = sheet_.smooth().at(middles));
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 normal = curved ? Vec3(jet.slope[0].of[i], jet.slope[1].of[i], jet.slope[2].of[i]) : normal_;
      const double most = (rest + half * normal.cwiseAbs().sum()) * (1 + kTriangleRounding);
      if (std::abs(jet.value.of[i]) > most) continue;
      if (pieces.touched(middle[i], jet.value.of[i], normal, rest)) parts[kept++] = parts[first + i];
    }
  }
  parts.resize(kept);
}

bool SheetBricks::mayBeSurface(const SmoothFunction::Space& box) const {
  const auto conditions = sheet_.function().conditions(sheet_.number());
  return std::all_of(conditions.begin(), conditions.end(), [&](const ImplicitFunction::Condition& condition) {
    return mayHold(sheet_.function(), condition, sheet_.slack(), box);
  });
}

}  // namespace hl
