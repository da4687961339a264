#include "geometry/polygon.h"

#include <cstddef>
#include <utility>

namespace hl {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Newell's normal: twice the area along each axis.
Vec3 areaTwice(std::span<const Vec3> corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) sum += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  return sum;
}

// Along the axis of the largest area, which leaves the coordinates as they are; counter-clockwise.
std::vector<Vec2> flattened(std::span<const Vec3> corners) {
  const Vec3 area = areaTwice(corners);
  Eigen::Index along = 0;
  area.cwiseAbs().maxCoeff(&along);
  Eigen::Index u = (along + 1) % 3, v = (along + 2) % 3;
  if (area[along] < 0) std::swap(u, v);
  std::vector<Vec2> flat;
  flat.reserve(corners.size());
  for (const Vec3& corner : corners) flat.emplace_back(corner[u], corner[v]);
  return flat;
}

// Twice the area; positive: c is to the left of the way from a to b.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// All triangles that share the first corner, which cover the polygon once where all turn as it does; else empty.
std::vector<Triangle> fanOf(const std::vector<Vec2>& corners) {
  const std::size_t n = corners.size();
  std::vector<Triangle> fan;
  fan.reserve(n - 2);
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    if (!(turn(corners[0], corners[i], corners[i + 1]) > 0)) return {};
    fan.push_back({0, i, i + 1});
  }
  return fan;
}

// Cuts off one ear after the other: a corner whose triangle lies in the polygon, with nothing of the outline in it
// (G. H. Meisters, Polygons have ears, 1975). A simple polygon always has two.
class EarClipping {
 public:
  explicit EarClipping(std::vector<Vec2> corners) : corners_(std::move(corners)), links_(corners_.size()) {
    const auto n = static_cast<std::uint32_t>(corners_.size());
    for (std::uint32_t i = 0; i < n; ++i) links_[i] = {(i + n - 1) % n, (i + 1) % n};
    for (std::uint32_t i = 0; i < n; ++i) links_[i].turn = turnAt(i);
  }

  std::vector<Triangle> run() {
    std::vector<Triangle> triangles;
    std::uint32_t at = 0;
    for (std::size_t left = corners_.size(); left > 3; --left) {
      const std::uint32_t ear = nextEar(at, left);
      triangles.push_back({links_[ear].before, ear, links_[ear].next});
      cut(ear);
      at = links_[links_[ear].next].next;  // ears side by side would make a fan of narrow triangles
    }
    triangles.push_back({links_[at].before, at, links_[at].next});
    return triangles;
  }

 private:
  // What an ear may be. Only polygons that touch or cross themselves come beyond the first.
  enum class Rule : std::uint8_t { kNothingWithin, kTipMayBeTouched, kConvex };
  struct Links {
    std::uint32_t before = 0, next = 0;
    double turn = 0;                    // > 0: convex
    Rule least = Rule::kNothingWithin;  // by earlier rules it is no ear, and so it stays while its neighbours do
  };

  double turnAt(std::uint32_t i) const {
    return turn(corners_[links_[i].before], corners_[i], corners_[links_[i].next]);
  }

  std::uint32_t nextEar(std::uint32_t from, std::size_t left) {
    for (const Rule rule : {Rule::kNothingWithin, Rule::kTipMayBeTouched, Rule::kConvex}) {
      std::uint32_t at = from;
      for (std::size_t i = 0; i < left; ++i, at = links_[at].next) {
        if (isEar(at, rule)) return at;
      }
    }
    return from;
  }

  bool isEar(std::uint32_t at, Rule rule) {
    Links& corner = links_[at];
    if (!(corner.turn > 0) || rule < corner.least) return false;
    if (rule == Rule::kConvex || !anyWithin(at, rule)) return true;
    corner.least = rule == Rule::kNothingWithin ? Rule::kTipMayBeTouched : Rule::kConvex;
    return false;
  }

  // Whether the outline enters the ear. Where it does, one of its corners that are not convex is within, or on the
  // border; at the ends of the cut the outline may touch itself.
  bool anyWithin(std::uint32_t ear, Rule rule) const {
    const Links& at = links_[ear];
    const Vec2 &a = corners_[at.before], &b = corners_[ear], &c = corners_[at.next];
    for (std::uint32_t i = links_[at.next].next; i != at.before; i = links_[i].next) {
      const Vec2& p = corners_[i];
      if (links_[i].turn > 0 || turn(c, a, p) < 0 || turn(a, b, p) < 0 || turn(b, c, p) < 0) continue;
      if (p == a || p == c || (rule == Rule::kTipMayBeTouched && p == b)) continue;
      return true;
    }
    return false;
  }

  void cut(std::uint32_t ear) {
    const Links at = links_[ear];
    links_[at.before].next = at.next;
    links_[at.next].before = at.before;
    for (const std::uint32_t neighbour : {at.before, at.next}) {
      links_[neighbour].turn = turnAt(neighbour);
      links_[neighbour].least = Rule::kNothingWithin;
    }
  }

  std::vector<Vec2> corners_;
  std::vector<Links> links_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> trianglesOf(std::span<const Vec3> corners) {
  if (corners.size() < 3) return {};
  if (corners.size() == 3) return {{0, 1, 2}};
  std::vector<Vec2> flat = flattened(corners);
  std::vector<Triangle> fan = fanOf(flat);
  return fan.empty() ? EarClipping(std::move(flat)).run() : fan;
}

}  // namespace hl
