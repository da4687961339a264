#include "bodies/mesh_holes.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>

namespace hl {

namespace {

// Of the size of a mesh: corners of one place that were rounded each for itself.
constexpr double kSameCorner = 1e-6;
// Of the area of a mesh: a hole of less is a crack, as where an edge has a corner that its neighbour does not have.
constexpr double kCrack = 1e-6;

double areaOf(const std::vector<Vec3>& vertices, const Corners& corners) {
  const Vec3& from = vertices[corners[0]];
  return (vertices[corners[1]] - from).cross(vertices[corners[2]] - from).norm() / 2;
}

// For each vertex one that is nearly at its place. Along a direction along which no mesh is drawn few are near.
std::vector<std::uint32_t> samePlaces(const PieceMesh& mesh) {
  const Vec3 direction = Vec3(0.5377, 0.1834, 0.8231).normalized();
  const double apart = kSameCorner * sizeOf(mesh);
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<double> along;
  for (const Vec3& vertex : mesh.vertices) along.push_back(direction.dot(vertex));
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return along[a] < along[b]; });
  std::vector<std::uint32_t> same(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t vertex = order[i];
    same[vertex] = vertex;
    for (std::size_t j = i; j-- > 0 && along[vertex] - along[order[j]] <= apart;) {
      if ((mesh.vertices[vertex] - mesh.vertices[order[j]]).norm() > apart) continue;
      same[vertex] = same[order[j]];
      break;
    }
  }
  return same;
}

void joinSamePlaces(const PieceMesh& mesh, std::vector<Corners>& triangles) {
  const std::vector<std::uint32_t> same = samePlaces(mesh);
  for (Corners& corners : triangles) {
    for (std::uint32_t& corner : corners) corner = same[corner];
  }
  std::erase_if(triangles, [](const Corners& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

using EdgeLoop = std::vector<std::uint32_t>;  // of vertices

// As many edges end at a vertex as begin there, so that a walk along them comes back. Each time it comes to where it
// was, a loop is complete. Where several edges go on, it takes the one that turns back most: so a crack between two
// edges, which share some of their corners only, is a loop of its own.
class LoopWalk {
 public:
  LoopWalk(const std::vector<Vec3>& vertices, std::vector<DirectedEdge> open)
      : vertices_(vertices), open_(std::move(open)), used_(open_.size()), place_(vertices.size(), kNone) {}

  std::vector<EdgeLoop> loops() {
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (!used_[i]) walkFrom(i);
    }
    return std::move(loops_);
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  void walkFrom(std::size_t first) {
    walk_.assign(1, open_[first].first);
    place_[walk_[0]] = 0;
    for (std::optional<std::size_t> edge = first; edge; edge = next()) {
      used_[*edge] = true;
      goTo(open_[*edge].second);
    }
    place_[walk_[0]] = kNone;
  }

  void goTo(std::uint32_t vertex) {
    const std::size_t at = place_[vertex];
    if (at == kNone) {
      place_[vertex] = walk_.size();
      walk_.push_back(vertex);
      return;
    }
    const auto begin = walk_.begin() + static_cast<std::ptrdiff_t>(at);
    loops_.emplace_back(begin, walk_.end());
    for (auto i = begin + 1; i != walk_.end(); ++i) place_[*i] = kNone;
    walk_.resize(at + 1);
  }

  std::optional<std::size_t> next() const {
    const std::uint32_t here = walk_.back();
    const Vec3 came = walk_.size() > 1 ? Vec3(vertices_[here] - vertices_[walk_[walk_.size() - 2]]) : Vec3::Zero();
    std::optional<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    const auto begin = std::lower_bound(open_.begin(), open_.end(), DirectedEdge(here, 0));
    for (auto edge = begin; edge != open_.end() && edge->first == here; ++edge) {
      const auto number = static_cast<std::size_t>(edge - open_.begin());
      const double ahead = came.dot((vertices_[edge->second] - vertices_[here]).normalized());
      if (used_[number] || !(ahead < least)) continue;
      least = ahead;
      best = number;
    }
    return best;
  }

  const std::vector<Vec3>& vertices_;
  std::vector<DirectedEdge> open_;
  std::vector<bool> used_;
  std::vector<std::size_t> place_;  // of a vertex in the walk
  EdgeLoop walk_;
  std::vector<EdgeLoop> loops_;
};

// Of its edges, however many parts they have.
Vec3 middleOf(const std::vector<Vec3>& vertices, const EdgeLoop& loop) {
  Vec3 sum = Vec3::Zero();
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 &from = vertices[loop[i]], &to = vertices[loop[(i + 1) % loop.size()]];
    sum += (to - from).norm() * (from + to) / 2;
    length += (to - from).norm();
  }
  return sum / length;
}

void addCap(const EdgeLoop& loop, CappedMesh& mesh) {
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(middleOf(mesh.vertices, loop));
  double area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], middle});
    area += areaOf(mesh.vertices, mesh.triangles.back());
  }
  mesh.caps_m2 += area;
  if (area > kCrack * mesh.mesh_m2) mesh.open_edges += loop.size();
}

}  // namespace

std::vector<DirectedEdge> openEdges(std::span<const Corners> triangles) {
  std::vector<DirectedEdge> there, back, open;
  for (const Corners& corners : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      there.emplace_back(corners[i], corners[(i + 1) % 3]);
      back.emplace_back(corners[(i + 1) % 3], corners[i]);
    }
  }
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  std::set_difference(there.begin(), there.end(), back.begin(), back.end(), std::back_inserter(open));
  return open;
}

CappedMesh capped(const PieceMesh& mesh) {
  CappedMesh closed{mesh.vertices, mesh.triangles};
  for (const Corners& corners : mesh.triangles) closed.mesh_m2 += areaOf(mesh.vertices, corners);
  if (openEdges(closed.triangles).empty()) return closed;
  joinSamePlaces(mesh, closed.triangles);
  for (const EdgeLoop& loop : LoopWalk(mesh.vertices, openEdges(closed.triangles)).loops()) addCap(loop, closed);
  return closed;
}

}  // namespace hl
