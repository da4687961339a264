#include "surfaces/implicit/sheet_bricks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surfaces/implicit/plane_reach.h"
#include "surfaces/implicit/sheet_measure.h"
#include "surfaces/slab_pieces.h"

namespace hl {

namespace {

// Of sizes: more than what rounding does to a few sums.
constexpr double kPlaneRounding = 1e-13, kTriangleRounding = 1e-12;
constexpr double kMoved = 0x1p-29;  // of a cell's side: more than crossing() may move a corner

}  // namespace

SheetBricks::SheetBricks(const Sheet& sheet, const GridFrame& frame, const GridBall* ball, const KnownBricks* known)
    : sheet_(sheet), frame_(frame), ball_(ball), known_(known) {}

bool SheetBricks::holds(int level, const Place& at) {
  const bool known = known_ != nullptr && level >= known_->lowest();
  if (known) {
    const double* const bend = known_->find(level, at);
    if (bend == nullptr) return false;
    bend_ = *bend;
  }
  if (level > 0) curved_ = known && std::isfinite(bend_);
  const Box box = sheet_.boxOf(level, at);
  const SmoothFunction::Space space = spaceOf(box, 0);
  if (!(curved_ ? planeByBend(box) : planeBySlopes(level == 1 && !known ? By::kBoth : By::kSlopes, box, space)))
    return false;
  crossing_ = (rest_ + 0.5 * partSide(level) * normal_.cwiseAbs().sum()) * (1 + kTriangleRounding);
  if (!mayBeIn(space)) return false;
  if (ball_ != nullptr) {
    const PlaneReach reach(*ball_, middle_, value_, normal_, rest_);
    if (reach.misses()) return false;
    near_ = {reach.low(), reach.high()};
    if (!near_.meets(box)) return false;
  }
  return mayBeSurface(level, box);
}

double SheetBricks::bendOf(int level, const Place& at) {
  const Box box = sheet_.boxOf(level, at);
  const SmoothFunction::Space space = spaceOf(box, 0);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(), kNoBound = Interval::kNoEnd;
  if (!planeBySlopes(By::kBoth, box, space) || !mayBeIn(space) ||
      !SheetSides().mayHold(sheet_.function(), sheet_.conditions(), sheet_.slack(), space))
    return kNone;
  return curved_ ? bend_ : kNoBound;
}

bool SheetBricks::mayBeIn(const SmoothFunction::Space& space) const {
  return !(std::abs(value_) > rest_ + space[0].half() * normal_.cwiseAbs().sum());
}

// False: the function is not 0 in the box.
bool SheetBricks::planeBySlopes(By by, const Box& box, const SmoothFunction::Space& space) {
  cost_ += by == By::kBoth ? kCostOfBend : kCostOfBrick;
  Jet<Interval, 1> slopes;
  if (by == By::kBoth) {
    const Jet<Interval, 2> jet = sheet_.smooth().bendOver(space);
    slopes = {jet.value, jet.slope, {}};
    bend_ = 0;
    for (std::size_t i = 0; i < jet.bend.size(); ++i)
      bend_ += (jet::kPairs[i][0] == jet::kPairs[i][1] ? 1 : 2) * jet.bend[i].most();
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
  rounding_ = roundingOf();
  rest_ = rounding_ + space[0].half() * vary_;
  const double quarter = 0.25 * space[0].half();  // half of a part's side
  if (by == By::kBoth) curved_ = restByBend(quarter) <= quarter * vary_;
  return true;
}

bool SheetBricks::planeByBend(const Box& box) {
  cost_ += kCostOfParts;
  middle_ = box.centre();
  const Jet<double, 1> jet = sheet_.smooth().slopeAt(middle_);
  value_ = jet.value;
  normal_ = {jet.slope[0], jet.slope[1], jet.slope[2]};
  rounding_ = roundingOf();
  rest_ = rounding_ + restByBend(0.5 * box.size().maxCoeff());
  return true;
}

double SheetBricks::roundingOf() const {
  return kPlaneRounding * (std::abs(value_) + middle_.cwiseAbs().maxCoeff()) +
         kMoved * step() * normal_.cwiseAbs().sum();
}

double SheetBricks::partSide(int level) const {
  return step() * (level == 0 ? 1 : static_cast<double>(BrickPyramid::cells(level - 1)));
}

// Eight parts at once.
void SheetBricks::sift(int level, BrickParts& parts) {
  const double side = partSide(level), half = 0.5 * side;
  const double rest = rounding_ + (curved_ ? restByBend(half) : half * vary_);
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
    curved_ ? void(jet = sheet_.smooth().slopeAt(middles)) : void(jet.value = sheet_.smooth().at(middles));
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 normal = curved_ ? Vec3(jet.slope[0].of[i], jet.slope[1].of[i], jet.slope[2].of[i]) : normal_;
      const double most = (rest + half * normal.cwiseAbs().sum()) * (1 + kTriangleRounding);
      if (std::abs(jet.value.of[i]) > most) continue;
      BrickPart& part = parts[first + i];
      if (pieces.touched(middle[i], jet.value.of[i], normal, rest, part.order)) parts[kept++] = part;
    }
  }
  parts.resize(kept);
}

// A walk comes to a brick from the one that holds it: what is known there is known here.
bool SheetBricks::mayBeSurface(int level, const Box& box) {
  const auto here = static_cast<std::size_t>(level);
  SheetSides sides = sides_[here + 1];
  const auto space = spaceOf(box, kMoved * step());
  const bool may = sides.mayHold(sheet_.function(), sheet_.conditions(), sheet_.slack(), space);
  looks_ += kLooksOfSide * sides.bodies();
  sides_[here] = sides;
  return may;
}

}  // namespace hl
