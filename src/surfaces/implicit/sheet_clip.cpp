#include "surfaces/implicit/sheet_clip.h"

#include <algorithm>
#include <cstdint>

namespace hl {

namespace {

using ClipNode = ImplicitFunction::Node;

class Clip {
 public:
  Clip(const ImplicitFunction& function, const SheetSides& sides, const std::array<Vec3, 3>& triangle, SheetPieces& out)
      : function_(function), sides_(sides), triangle_(triangle), out_(out) {}

  void run(std::size_t sheet, double slack) {
    out_.count = out_.looks = 0;
    Polygon whole;
    whole.count = 3;
    for (std::size_t i = 0; i < 3; ++i) whole.corners[i] = {triangle_[i], Vec3::Unit(static_cast<Eigen::Index>(i))};
    const auto conditions = function_.conditions(sheet);
    std::array<Pending, kMaxSheets> pending;
    const std::size_t count = std::min(conditions.size(), pending.size());
    for (std::size_t i = 0; i < count; ++i)
      pending[i] = {conditions[i].node, conditions[i].sign, slack, i + 1 < count ? &pending[i + 1] : nullptr};
    keep(whole, count > 0 ? pending.data() : nullptr);
    if (!full_) return;
    out_.count = 1;
    out_.triangles[0] = triangle_;
  }

 private:
  static constexpr std::size_t kMaxCorners = 12;
  /// `weight`: of the corners of the triangle.
  struct Corner {
    Vec3 at, weight;
  };
  struct Polygon {
    std::array<Corner, kMaxCorners> corners;
    std::size_t count = 0;
  };
  /// sign * value + slack >= 0, and what must hold beside it.
  struct Pending {
    std::size_t node = 0;
    double sign = 1, slack = 0;
    const Pending* next = nullptr;
  };

  void keep(const Polygon& polygon, const Pending* pending) {
    if (full_) return;
    if (pending == nullptr) return emit(polygon);
    const auto& [number, sign, slack, next] = *pending;
    const ClipNode& node = function_.node(number);
    if (node.kind == ClipNode::Kind::kSmooth) {
      if (sides_.isAbove(node.first) || sides_.isBelow(node.first)) {
        if (sides_.isAbove(node.first) == (sign > 0)) keep(polygon, next);
        return;
      }
      const Vec3& value = valuesOf(node.first);  // at the corners: all on one side, nothing is cut
      if ((sign * value.array() + slack >= 0).all()) return keep(polygon, next);
      if ((sign * value.array() + slack < 0).all()) return;
      Polygon rest;
      cut(polygon, value, sign, slack, rest);
      if (rest.count >= 3) keep(rest, next);
      return;
    }
    const Pending second{node.second, sign, slack, next};
    if ((node.kind == ClipNode::Kind::kMin) == (sign > 0)) {
      const Pending both{node.first, sign, slack, &second};
      return keep(polygon, &both);
    }
    const Pending first{node.first, sign, slack, next}, not_first{node.first, -sign, -slack, &second};
    keep(polygon, &first);
    keep(polygon, &not_first);
  }

  // Of a smooth function at the corners of the triangle: conditions share functions, so each is evaluated once.
  const Vec3& valuesOf(std::size_t sheet) {
    if (!(known_ >> sheet & 1)) {
      const SmoothFunction& smooth = function_.sheets()[sheet];
      values_[sheet] = {smooth.at(triangle_[0]), smooth.at(triangle_[1]), smooth.at(triangle_[2])};
      known_ |= std::uint64_t{1} << sheet;
      out_.looks += smooth.bodies();
    }
    return values_[sheet];
  }

  void cut(const Polygon& polygon, const Vec3& value, double sign, double slack, Polygon& rest) {
    const auto over = [&](const Corner& corner) { return sign * corner.weight.dot(value) + slack; };
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const Corner &p = polygon.corners[i], &q = polygon.corners[(i + 1) % polygon.count];
      const double at_p = over(p), at_q = over(q);
      if (at_p >= 0) add(p, rest);
      if ((at_p >= 0) == (at_q >= 0)) continue;
      const bool turned = std::lexicographical_compare(q.at.data(), q.at.data() + 3, p.at.data(), p.at.data() + 3);
      add(turned ? between(q, p, at_q, at_p) : between(p, q, at_p, at_q), rest);
    }
  }

  static Corner between(const Corner& p, const Corner& q, double at_p, double at_q) {
    const double part = at_p / (at_p - at_q);
    return {p.at + part * (q.at - p.at), p.weight + part * (q.weight - p.weight)};
  }

  void add(const Corner& corner, Polygon& polygon) {
    if (polygon.count == kMaxCorners) {
      full_ = true;
      return;
    }
    polygon.corners[polygon.count++] = corner;
  }

  void emit(const Polygon& polygon) {
    for (std::size_t i = 2; i < polygon.count; ++i) {
      if (out_.count == kMaxPieces) {
        full_ = true;
        return;
      }
      out_.triangles[out_.count++] = {polygon.corners[0].at, polygon.corners[i - 1].at, polygon.corners[i].at};
    }
  }

  const ImplicitFunction& function_;
  const SheetSides& sides_;
  const std::array<Vec3, 3>& triangle_;
  SheetPieces& out_;
  bool full_ = false;
  std::uint64_t known_ = 0;  // bit i: values_[i] is known
  std::array<Vec3, kMaxSheets> values_;
};

}  // namespace

void clipToSheet(const ImplicitFunction& function, std::size_t sheet, double slack, const SheetSides& sides,
                 const std::array<Vec3, 3>& triangle, SheetPieces& out) {
  if (function.conditions(sheet).empty()) {
    out.count = 1;
    out.looks = 0;
    out.triangles[0] = triangle;
    return;
  }
  Clip(function, sides, triangle, out).run(sheet, slack);
}

}  // namespace hl
