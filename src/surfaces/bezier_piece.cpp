#include "surfaces/bezier_piece.h"

#include <algorithm>
#include <utility>

namespace hl {

namespace {

using Weighted = Eigen::Vector4d;  // ControlPoint::homogeneous()

// A weighted point of a curve with its derivative.
struct OnCurve {
  Weighted at, derivative;
};

// De Casteljau's algorithm over every `step`-th of `degree` + 1 points.
OnCurve onCurve(const Weighted* points, std::size_t degree, std::size_t step, double part) {
  std::array<Weighted, kMaxPatchOrder> p;
  for (std::size_t i = 0; i <= degree; ++i) p[i] = points[i * step];
  Weighted derivative = Weighted::Zero();
  for (std::size_t s = degree; s > 0; --s) {
    if (s == 1) derivative = static_cast<double>(degree) * (p[1] - p[0]);
    for (std::size_t i = 0; i < s; ++i) p[i] += part * (p[i + 1] - p[i]);
  }
  return {p[0], derivative};
}

using WeightedNet = std::vector<Weighted>;

struct NetSize {
  std::size_t degree_u, degree_v;
};

// Point and derivatives of the surface, in space.
struct OnSurface {
  Vec3 at, along_u, along_v;
};

OnSurface onSurface(const WeightedNet& net, NetSize size, double u, double v) {
  std::array<Weighted, kMaxPatchOrder> at, along;
  for (std::size_t j = 0; j <= size.degree_v; ++j) {
    const OnCurve row = onCurve(&net[j * (size.degree_u + 1)], size.degree_u, 1, u);
    at[j] = row.at;
    along[j] = row.derivative;
  }
  const OnCurve there = onCurve(at.data(), size.degree_v, 1, v);
  const Weighted du = onCurve(along.data(), size.degree_v, 1, v).at;
  const double w = there.at.w();
  const Vec3 point = there.at.head<3>() / w;
  return {point, (du.head<3>() - du.w() * point) / w, (there.derivative.head<3>() - there.derivative.w() * point) / w};
}

// The half before and the half behind the middle, along every `step`-th of the points from `begin` on.
void halve(WeightedNet& low, WeightedNet& high, std::size_t begin, std::size_t degree, std::size_t step) {
  for (std::size_t s = degree; s > 0; --s) {
    high[begin + s * step] = low[begin + degree * step];
    for (std::size_t i = degree; i > degree - s; --i)
      low[begin + i * step] = 0.5 * (low[begin + i * step] + low[begin + (i - 1) * step]);
  }
  high[begin] = low[begin + degree * step];
}

std::pair<WeightedNet, WeightedNet> halvesAlongU(WeightedNet net, NetSize size) {
  WeightedNet high(net.size());
  for (std::size_t j = 0; j <= size.degree_v; ++j) halve(net, high, j * (size.degree_u + 1), size.degree_u, 1);
  return {std::move(net), std::move(high)};
}

std::pair<WeightedNet, WeightedNet> halvesAlongV(WeightedNet net, NetSize size) {
  WeightedNet high(net.size());
  for (std::size_t i = 0; i <= size.degree_u; ++i) halve(net, high, i, size.degree_v, size.degree_u + 1);
  return {std::move(net), std::move(high)};
}

// The largest lengths of a derivative's weighted vectors: of their place, and of their weight.
struct Largest {
  double place = 0, weight = 0;
  void take(const Weighted& v) {
    place = std::max(place, v.head<3>().norm());
    weight = std::max(weight, std::abs(v.w()));
  }
};

// Bounds by differences of control points, which bound the derivatives of the weighted surface A and its weight w. With
// S = A / w: S_u = (A_u - w_u S) / w, S_uv = (A_uv - w_u S_v - w_v S_u - w_uv S) / w, and |S| <= R around the middle.
PatchCurvature directCurvature(WeightedNet net, NetSize size) {
  const std::size_t columns = size.degree_u + 1, rows = size.degree_v + 1;
  Box box;
  double least_w = net.front().w(), reach = 0;
  for (const Weighted& p : net) box.extend(p.head<3>() / p.w());
  for (Weighted& p : net) {
    p.head<3>() -= p.w() * box.centre();
    least_w = std::min(least_w, p.w());
    reach = std::max(reach, p.head<3>().norm() / p.w());
  }
  const double n = static_cast<double>(size.degree_u), m = static_cast<double>(size.degree_v);
  Largest u, v, uu, uv, vv;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const auto p = [&](std::size_t di, std::size_t dj) -> const Weighted& {
        return net[(j + dj) * columns + i + di];
      };
      if (i + 1 < columns) u.take(n * (p(1, 0) - p(0, 0)));
      if (j + 1 < rows) v.take(m * (p(0, 1) - p(0, 0)));
      if (i + 2 < columns) uu.take(n * (n - 1) * (p(2, 0) - 2 * p(1, 0) + p(0, 0)));
      if (j + 2 < rows) vv.take(m * (m - 1) * (p(0, 2) - 2 * p(0, 1) + p(0, 0)));
      if (i + 1 < columns && j + 1 < rows) uv.take(n * m * (p(1, 1) - p(1, 0) - p(0, 1) + p(0, 0)));
    }
  }
  const double s_u = (u.place + u.weight * reach) / least_w, s_v = (v.place + v.weight * reach) / least_w;
  return {(uu.place + 2 * u.weight * s_u + uu.weight * reach) / least_w,
          (uv.place + u.weight * s_v + v.weight * s_u + uv.weight * reach) / least_w,
          (vv.place + 2 * v.weight * s_v + vv.weight * reach) / least_w};
}

// Of parts, whose bounds are nearer to the truth.
PatchCurvature curvatureOf(const WeightedNet& net, NetSize size, int halvings) {
  if (halvings == 0) return directCurvature(net, size);
  PatchCurvature bound;
  const auto [left, right] = halvesAlongU(net, size);
  for (const WeightedNet* side : {&left, &right}) {
    const auto [low, high] = halvesAlongV(*side, size);
    for (const WeightedNet* part : {&low, &high}) {
      const PatchCurvature of_part = curvatureOf(*part, size, halvings - 1);
      // A part's parameters go from 0 to 1 in half the way.
      bound = {std::max(bound.uu, 4 * of_part.uu), std::max(bound.uv, 4 * of_part.uv),
               std::max(bound.vv, 4 * of_part.vv)};
    }
  }
  return bound;
}

WeightedNet weightedNet(const std::vector<ControlPoint>& points) {
  WeightedNet net;
  for (const ControlPoint& point : points) net.push_back(point.homogeneous());
  return net;
}

}  // namespace

BezierPiece::BezierPiece(const BezierNet& net, std::size_t i, std::size_t j)
    : degree_u_(net.degree_u), degree_v_(net.degree_v) {
  for (std::size_t row = 0; row <= degree_v_; ++row) {
    const std::size_t begin = (j * degree_v_ + row) * net.columns() + i * degree_u_;
    for (std::size_t column = 0; column <= degree_u_; ++column) points_.push_back(net.points[begin + column]);
  }
}

Vec3 BezierPiece::point(double u, double v) const {
  return onSurface(weightedNet(points_), {degree_u_, degree_v_}, u, v).at;
}

// Where a side has no length there is no normal on it: that of a place a little inside stands for it.
Vec3 BezierPiece::normal(double u, double v) const {
  constexpr double kFlat = 1e-9;  // sine of the angle between the directions along u and v, and part of the lengths
  const WeightedNet net = weightedNet(points_);
  for (const double inward : {0.0, 1e-5, 1e-3}) {
    const OnSurface there = onSurface(net, {degree_u_, degree_v_}, u + inward * (0.5 - u), v + inward * (0.5 - v));
    const Vec3 cross = there.along_u.cross(there.along_v);
    const double longer = std::max(there.along_u.norm(), there.along_v.norm());
    if (cross.norm() > kFlat * longer * longer) return cross.normalized();
  }
  return Vec3::Zero();
}

PatchCurvature BezierPiece::curvature() const {
  constexpr int kHalvings = 3;
  return curvatureOf(weightedNet(points_), {degree_u_, degree_v_}, kHalvings);
}

std::vector<ControlPoint> BezierPiece::side(std::size_t number) const {
  const std::size_t columns = degree_u_ + 1;
  const bool along_u = number % 2 == 0, far = number == 1 || number == 2;
  const std::size_t begin = far ? (along_u ? degree_v_ * columns : degree_u_) : 0;
  const std::size_t step = along_u ? 1 : columns;
  std::vector<ControlPoint> points;
  for (std::size_t i = 0; i <= (along_u ? degree_u_ : degree_v_); ++i) points.push_back(points_[begin + i * step]);
  return points;
}

Vec3 curvePoint(const std::vector<ControlPoint>& points, double part) {
  if (part <= 0) return points.front().at;
  if (part >= 1) return points.back().at;
  const auto same = [&](const ControlPoint& point) { return point.at == points.front().at; };
  if (std::all_of(points.begin(), points.end(), same)) return points.front().at;
  const WeightedNet net = weightedNet(points);
  const OnCurve there = onCurve(net.data(), points.size() - 1, 1, part);
  return there.at.head<3>() / there.at.w();
}

}  // namespace hl
