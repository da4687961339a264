#include "surfaces/implicit/sheet_measure.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "surfaces/implicit/sheet_sides.h"

namespace hl {

namespace {

/// Of second derivatives over a box: the largest absolute eigenvalue, and that of their middle.
struct BendBound {
  double most, middle;
};

// An eigenvalue is at most that of the middle and the largest sum of a row of what is around it.
BendBound boundOf(const Jet<Interval, 2>& jet) {
  Mat3 middle, half;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto [a, b] = jet::kPairs[i];
    const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
    middle(row, column) = middle(column, row) = jet.bend[i].middle();
    half(row, column) = half(column, row) = jet.bend[i].half();
  }
  if (!middle.allFinite() || !half.allFinite()) return {Interval::kNoEnd, 0};
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(middle, Eigen::EigenvaluesOnly);
  constexpr double kRounding = 1e-6;  // of the direct formula
  const double of_middle = (1 + kRounding) * solver.eigenvalues().cwiseAbs().maxCoeff();
  return {of_middle + half.rowwise().sum().maxCoeff(), of_middle};
}

Vec3 halfOf(const SmoothFunction::Space& box) { return {box[0].half(), box[1].half(), box[2].half()}; }

// By the gradient's intervals, or by the gradient in the middle and what it may change from there.
double leastSlope(const SmoothFunction& smooth, const SmoothFunction::Space& box, const Jet<Interval, 2>& jet,
                  double most_bend) {
  const double direct = Vec3(jet.slope[0].least(), jet.slope[1].least(), jet.slope[2].least()).norm();
  if (!std::isfinite(most_bend)) return direct;
  const Vec3 middle(box[0].middle(), box[1].middle(), box[2].middle());
  return std::max(direct, (1 - 1e-9) * smooth.gradient(middle).norm() - most_bend * halfOf(box).norm());
}

double mostSlope(const Jet<Interval, 2>& jet) {
  return Vec3(jet.slope[0].most(), jet.slope[1].most(), jet.slope[2].most()).norm();
}

// What is known of all such functions is tighter: of one body's distance the gradient is 1.
Interval slopeOf(const SmoothFunction& smooth, double least, double most) {
  if (!smooth.isNoSteeperThanDistance()) return {least, most};
  return smooth.bodies() == 1 ? Interval{1, 1} : Interval{std::min(least, 1.0), std::min(most, 1.0)};
}

void extend(Interval& slope, const Interval& other) {
  slope = {std::min(slope.low, other.low), std::max(slope.high, other.high)};
}

// Also by the plane in the middle, from which it differs by no more than its gradient may vary.
bool mayBeZero(const SmoothFunction& smooth, const SmoothFunction::Space& space) {
  const Jet<Interval, 1> jet = smooth.slopeOver(space);
  if (!jet.value.holds(0)) return false;
  double reach = 0;
  for (const Interval& slope : jet.slope) reach += slope.most();
  const Vec3 middle(space[0].middle(), space[1].middle(), space[2].middle());
  return !(std::abs(smooth.at(middle)) > (1 + 1e-9) * reach * halfOf(space).maxCoeff());
}

Box partOf(const Box& box, int part) {
  const Vec3 middle = box.centre();
  Box result = box;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    ((part >> axis & 1) != 0 ? result.min : result.max)[axis] = middle[axis];
  return result;
}

}  // namespace

SmoothFunction::Space spaceOf(const Box& box, double margin) {
  SmoothFunction::Space space;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const double more = margin + 1e-12 * (std::abs(box.min[a]) + std::abs(box.max[a]));
    space[axis] = {box.min[a] - more, box.max[a] + more};
  }
  return space;
}

// What the number of triangles grows with.
double SheetSearch::Piece::effort() const {
  return bend_per_m * (cut_slope.high > 0 ? 1 + 2 * cut_slope.high / cut_slope.low : 3);
}

bool SheetSearch::Piece::operator<(const Piece& other) const {
  if (coarse != other.coarse) return other.coarse;
  if (effort() != other.effort()) return effort() < other.effort();
  return order > other.order;
}

SheetSearch::SheetSearch(const ImplicitFunction& function, std::size_t sheet, const Box& within)
    : function_(function), sheet_(sheet), size_(within.size().maxCoeff()), conditions_(function.conditions(sheet)) {
  for (const auto& condition : conditions_) addSheets(condition.node);
  addPeriod(sheet, within);
  for (const std::size_t other : others_) addPeriod(other, within);
  add(within);
}

SheetSearch::SheetSearch(const ImplicitFunction& function, std::size_t sheet, const Box& within, WithoutConditions)
    : function_(function), sheet_(sheet), size_(within.size().maxCoeff()) {
  add(within);
}

void SheetSearch::addSheets(std::size_t number) {
  const ImplicitFunction::Node& node = function_.node(number);
  if (node.kind == ImplicitFunction::Node::Kind::kSmooth) return others_.push_back(node.first);
  addSheets(node.first);
  addSheets(node.second);
}

void SheetSearch::refine(std::size_t most_looks) {
  constexpr double kFine = 1.0 / 8192, kGoodEnough = 1.8;
  if (!periods_.empty()) searchPeriods(most_looks);
  looked_ = 0;
  while (!boxes_.empty() && looked_ < most_looks) {
    const Piece top = boxes_.top();
    const bool fine = top.box.size().maxCoeff() < kFine * size_;
    if ((!top.coarse && top.effort() <= 3 * kGoodEnough * about_) || fine) return;
    boxes_.pop();
    for (int part = 0; part < 8; ++part) add(partOf(top.box, part));
  }
}

void SheetSearch::addPeriod(std::size_t sheet, const Box& within) {
  const std::optional<Vec3> half = function_.sheets()[sheet].halfPeriod();
  if (!half || half->prod() >= (within.size() / 2).prod() || periodOf(sheet) != nullptr) return;
  const Box box{within.centre() - *half, within.centre() + *half};
  Period period{sheet, std::unique_ptr<SheetSearch>(new SheetSearch(function_, sheet, box, WithoutConditions()))};
  period.volume_m3 = box.size().prod();
  periods_.push_back(std::move(period));
}

// The boxes that are there already are looked at again with what is known then.
void SheetSearch::searchPeriods(std::size_t most_looks) {
  for (Period& period : periods_) {
    period.search->refine(most_looks / periods_.size());
    period.measure = period.search->result();
  }
  widen(margin_);
  for (const Period& period : periods_) about_ = std::max(about_, period.search->about_);
}

const SheetSearch::Period* SheetSearch::periodOf(std::size_t sheet) const {
  for (const Period& period : periods_) {
    if (period.sheet == sheet) return &period;
  }
  return nullptr;
}

void SheetSearch::widen(double margin) {
  for (Period& period : periods_) {
    if (margin != margin_) period.search->widen(margin);
  }
  margin_ = margin;
  about_ = 0;
  std::priority_queue<Piece> before;
  before.swap(boxes_);
  for (; !before.empty(); before.pop()) add(before.top().box);
}

void SheetSearch::add(const Box& box) {
  constexpr double kCoarse = 1.0 / 8;
  const SmoothFunction::Space space = spaceOf(box, margin_);
  const SmoothFunction& own = function_.sheets()[sheet_];
  ++looked_;
  if (!mayBeZero(own, space)) return;
  looked_ += 1 + others_.size();
  if (!SheetSides().mayHold(function_, conditions_, 0, space)) return;
  const SheetMeasure none;
  Piece piece{box.size().maxCoeff() > kCoarse * size_, 0, none.own_slope, none.cut_slope, box, order_++};
  look(sheet_, space, piece, piece.own_slope);
  for (const std::size_t other : others_) {
    const SmoothFunction& smooth = function_.sheets()[other];
    if (smooth.over(space).holds(0)) look(other, space, piece, piece.cut_slope);
  }
  boxes_.push(piece);
}

void SheetSearch::look(std::size_t sheet, const SmoothFunction::Space& space, Piece& piece, Interval& slope) {
  const SmoothFunction& smooth = function_.sheets()[sheet];
  const Period* const period = periodOf(sheet);
  const Jet<Interval, 2> jet = smooth.bendOver(space);
  const BendBound bend = boundOf(jet);
  const double least = leastSlope(smooth, space, jet, bend.most), most = mostSlope(jet);
  const double bend_per_m = bend.most == 0 ? 0 : least > 0 ? bend.most / least : Interval::kNoEnd;
  piece.bend_per_m = std::max(piece.bend_per_m, period ? std::min(bend_per_m, period->measure.bend_per_m) : bend_per_m);
  Interval found = slopeOf(smooth, least, most);
  if (period) {
    const Interval& known = period->measure.own_slope;
    found = {std::max(found.low, known.low), std::min(found.high, known.high)};
  }
  extend(slope, found);
  const bool narrow = bend.most <= 2 * bend.middle && most <= 2 * least;
  if (narrow && most > 0) about_ = std::max(about_, bend.middle / most);
}

SheetMeasure SheetSearch::result() const {
  SheetMeasure measure;
  if (!boxes_.empty()) measure.sharpest = boxes_.top().box.centre();
  const Period* const period = periodOf(sheet_);
  for (auto boxes = boxes_; !boxes.empty(); boxes.pop()) {
    const Piece& piece = boxes.top();
    measure.bounds.extend(piece.box);
    measure.bend_per_m = std::max(measure.bend_per_m, piece.bend_per_m);
    extend(measure.own_slope, piece.own_slope);
    extend(measure.cut_slope, piece.cut_slope);
    const double volume_m3 = piece.box.size().prod();
    measure.area_m2 += period ? volume_m3 * period->measure.area_m2 / period->volume_m3 : std::pow(volume_m3, 2.0 / 3);
  }
  return measure;
}

}  // namespace hl
