#include "bodies/mesh_pieces.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace hl {

namespace {

using MeshTriangles = std::span<const std::array<std::uint32_t, 3>>;

// Of a right angle: two faces of neighbours that lie on each other have nothing between them.
constexpr double kNoAngle = 1e-6;

struct MeshSide {
  std::uint32_t run = 0;            // of its triangle
  std::uint32_t low = 0, high = 0;  // vertices of the edge
  std::uint32_t triangle = 0, opposite = 0;
  bool upward = false;  // the triangle passes it from low to high
};

// For each vertex the first of those at its place.
std::vector<std::uint32_t> weldedVertices(std::span<const Vec3> vertices) {
  const auto key = [&](std::uint32_t i) { return std::tuple(vertices[i].x(), vertices[i].y(), vertices[i].z()); };
  std::vector<std::uint32_t> order(vertices.size()), welded(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  for (std::size_t i = 0; i < order.size(); ++i)
    welded[order[i]] = i > 0 && vertices[order[i]] == vertices[order[i - 1]] ? welded[order[i - 1]] : order[i];
  return welded;
}

bool ofOneEdge(const MeshSide& a, const MeshSide& b) { return a.low == b.low && a.high == b.high; }

bool precedes(const MeshSide& a, const MeshSide& b) {
  return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
}

// Sorted by triangle.
std::vector<MeshSide> sidesOf(std::span<const Vec3> vertices, MeshTriangles triangles) {
  const std::vector<std::uint32_t> welded = weldedVertices(vertices);
  std::vector<MeshSide> sides;
  for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
    std::array<std::uint32_t, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = welded[triangles[triangle][i]];
    const Vec3 area = (vertices[at[1]] - vertices[at[0]]).cross(vertices[at[2]] - vertices[at[0]]);
    if (area.isZero(0)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = at[i], to = at[(i + 1) % 3];
      sides.push_back({0, std::min(from, to), std::max(from, to), triangle, at[(i + 2) % 3], from < to});
    }
  }
  return sides;
}

// Where all edges have been passed as often up as down, a closed surface ends in the list, and a run of triangles.
void findRuns(std::vector<MeshSide>& sides) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> passed;
  std::size_t open = 0;
  std::uint32_t run = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    MeshSide& side = sides[i];
    int& up = passed[{side.low, side.high}];
    open -= up != 0 ? 1 : 0;
    up += side.upward ? 1 : -1;
    open += up != 0 ? 1 : 0;
    side.run = run;
    if (open > 0 || i % 3 < 2) continue;
    ++run;
    passed.clear();
  }
}

// 0 to 4 for a full turn, ascending with the angle of (x, y) from the x axis; without rounding of a trigonometric
// function, which would not be the same everywhere.
double turnOf(double x, double y) {
  if (y >= 0) return x >= 0 ? y / (x + y) : 1 + x / (x - y);
  return x < 0 ? 2 + y / (x + y) : 3 + x / (x - y);
}

// Six times the volume of the run, or less than 0 if it faces inward.
double volumeOf(std::span<const Vec3> vertices, MeshTriangles triangles, std::span<const MeshSide> run) {
  double volume = 0;
  for (std::size_t i = 0; i < run.size(); i += 3) {
    const auto& corners = triangles[run[i].triangle];
    const Vec3 p = vertices[corners[0]] - vertices[run[0].low], q = vertices[corners[1]] - vertices[run[0].low];
    volume += p.dot(q.cross(vertices[corners[2]] - vertices[run[0].low]));
  }
  return volume;
}

class PieceFinder {
 public:
  PieceFinder(std::span<const Vec3> vertices, std::size_t triangles) : vertices_(vertices), parent_(triangles) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::uint32_t of(std::uint32_t triangle) {
    while (parent_[triangle] != triangle) triangle = parent_[triangle] = parent_[parent_[triangle]];
    return triangle;
  }
  // All of a run at one edge.
  void joinAt(std::span<const MeshSide> edge, bool inward) {
    if (edge.size() == 2) return join(edge[0].triangle, edge[1].triangle);
    for (const MeshSide& side : edge) {
      if (!side.upward) continue;
      const MeshSide* nearest = nullptr;
      double least = 4 - kNoAngle;
      for (const MeshSide& other : edge) {
        if (other.upward) continue;
        const double turn = insideBetween(side, other, inward);
        if (!(turn > kNoAngle && turn < least)) continue;
        least = turn;
        nearest = &other;
      }
      if (nearest != nullptr) join(side.triangle, nearest->triangle);
    }
  }

 private:
  void join(std::uint32_t a, std::uint32_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  // A triangle that passes the edge along an axis has its normal a quarter of a turn about it ahead, the inside behind,
  // unless it faces inward. Of a full turn 4.
  double insideBetween(const MeshSide& side, const MeshSide& other, bool inward) const {
    const Vec3 origin = vertices_[side.low], axis = (vertices_[side.high] - origin).normalized();
    const auto away = [&](std::uint32_t vertex) {
      const Vec3 way = vertices_[vertex] - origin;
      return Vec3((way - axis.dot(way) * axis).normalized());
    };
    const Vec3 from = away(side.opposite), to = away(other.opposite);
    const double ahead = axis.cross(from).dot(to);
    return turnOf(from.dot(to), inward ? ahead : -ahead);
  }

  std::span<const Vec3> vertices_;
  std::vector<std::uint32_t> parent_;
};

void joinRun(std::span<const MeshSide> run, bool inward, PieceFinder& finder) {
  for (auto begin = run.begin(); begin != run.end();) {
    const auto end = std::find_if(begin, run.end(), [&](const MeshSide& side) { return !ofOneEdge(side, *begin); });
    finder.joinAt(run.subspan(static_cast<std::size_t>(begin - run.begin()), static_cast<std::size_t>(end - begin)),
                  inward);
    begin = end;
  }
}

}  // namespace

std::vector<std::vector<std::uint32_t>> piecesOf(std::span<const Vec3> vertices, MeshTriangles triangles) {
  std::vector<MeshSide> sides = sidesOf(vertices, triangles);
  findRuns(sides);
  PieceFinder finder(vertices, triangles.size());
  std::vector<bool> has_area(triangles.size());
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::find_if(begin, sides.end(), [&](const MeshSide& side) { return side.run != begin->run; });
    const std::span<MeshSide> run(&*begin, static_cast<std::size_t>(end - begin));
    const bool inward = volumeOf(vertices, triangles, run) < 0;
    std::sort(begin, end, precedes);
    joinRun(run, inward, finder);
    for (; begin != end; ++begin) has_area[begin->triangle] = true;
  }
  std::vector<std::vector<std::uint32_t>> pieces;
  std::vector<std::size_t> number(triangles.size());
  for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
    if (!has_area[triangle]) continue;
    const std::uint32_t first = finder.of(triangle);
    if (first == triangle) {
      number[triangle] = pieces.size();
      pieces.emplace_back();
    }
    pieces[number[first]].push_back(triangle);
  }
  return pieces;
}

}  // namespace hl
