#include "surfaces/iso_surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "surfaces/brick_index.h"
#include "surfaces/crossed_cells.h"
#include "surfaces/slope.h"

namespace hl {

namespace {

// Of the longest to the shortest height of a cell: then the flattest of its triangles is still one (kSliver).
constexpr double kMaxStretched = 50;

using Place = IsoCells::Place;

// Each second, third... sample, so that the surface has about 1 / step^2 of the triangles.
std::shared_ptr<const Volume> thinned(const VoxelGrid& grid, std::uint32_t step) {
  Place side{};
  for (std::size_t axis = 0; axis < 3; ++axis) side[axis] = std::max(2U, grid.cells(axis) / step + 1);
  auto samples = std::make_shared<std::vector<float>>();
  samples->reserve(std::size_t{side[0]} * side[1] * side[2]);
  const auto at = [&](std::size_t axis, std::uint32_t i) { return std::min(i * step, grid.cells(axis)); };
  for (std::uint32_t z = 0; z < side[2]; ++z) {
    for (std::uint32_t y = 0; y < side[1]; ++y) {
      for (std::uint32_t x = 0; x < side[0]; ++x)
        samples->push_back(static_cast<float>(grid.at(at(0, x), at(1, y), at(2, z))));
    }
  }
  const std::shared_ptr<const void> data(samples, samples->data());
  return std::make_shared<const Volume>(VoxelGrid(side, Samples(SampleKind::kFloat32, data)));
}

// Of corner c of the cell at `at`, for a place within it.
double trilinearWeight(const Vec3& place, const Place& at, unsigned c) {
  double weight = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double part = std::clamp(place[static_cast<Eigen::Index>(axis)] - at[axis], 0.0, 1.0);
    weight *= (c >> axis & 1U) != 0 ? part : 1 - part;
  }
  return weight;
}

}  // namespace

void requireValues(const Volume& volume) {
  const ValueRange& range = volume.pyramid.range();
  if (range.low <= range.high) return;
  std::ostringstream text;
  text << "no voxel of it has a finite value";
  if (const auto missing = volume.grid.samples().missing())
    text << " but " << *missing << ", which stands for a missing one";
  throw Error(text.str());
}

void requireSurface(const IsoSurface& surface) {
  requireValues(*surface.volume());
  if (surface.crossesAny()) return;
  const ValueRange& range = surface.volume()->pyramid.range();
  std::ostringstream text;
  text << "there is no surface at iso " << surface.iso().value << ": its values are from " << range.low << " to "
       << range.high;
  const bool above = surface.iso().solid == SolidSide::kAbove;
  if (surface.iso().value == (above ? range.low : range.high)) {
    text << ", as all is matter then";
  } else if (range.holds(surface.iso().value)) {
    text << ", and no two neighbours have it between them";
  }
  throw Error(text.str());
}

IsoSurface::IsoSurface(std::shared_ptr<const Volume> volume, const GridFrame& frame, const IsoValue& iso,
                       std::shared_ptr<const MatterTable> matter)
    : cells_(std::move(volume), frame, iso),
      across_(frame.axes.inverse()),
      mirrored_(frame.axes.determinant() < 0),
      matter_(std::move(matter)) {
  if (!std::isfinite(iso.value)) throw Error("the iso value of a volume must be a number");
  checkFrame();
  measure();
}

void IsoSurface::checkFrame() const {
  if (!frame().axes.allFinite() || !frame().origin.allFinite() || !across_.allFinite())
    throw Error("the axes of a volume's grid must be numbers, none of them 0, and not lie in one plane");
  double longest = 0, thinnest = std::numeric_limits<double>::infinity();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    longest = std::max(longest, frame().axes.col(axis).norm());
    thinnest = std::min(thinnest, 1 / across_.row(axis).norm());
  }
  if (!(longest <= kMaxStretched * thinnest))
    throw Error("the cells of a volume are more than 50 times as long as thin: resample it");
  const Vec3 last = frame().point(volume()->grid.cells(0), volume()->grid.cells(1), volume()->grid.cells(2));
  if (!withinReach(frame().origin) || !withinReach(last)) throw Error("a volume reaches beyond 1e9 m");
}

// By the bricks in which it is: rounding keeps the order of coordinates, so of the corners of a box the same one is
// always the farthest along an axis.
void IsoSurface::measure() {
  const auto reach_of = [&](Eigen::Index axis, double way) {
    return volume()->pyramid.farthestHolding(iso().value, [&, axis, way](const Place& first, const Place& end) {
      const auto at = [&](std::size_t i) {
        return way * frame().axes(axis, static_cast<Eigen::Index>(i)) > 0 ? end[i] : first[i];
      };
      return way * frame().point(at(0), at(1), at(2))[axis];
    });
  };
  Box box;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    box.max[axis] = reach_of(axis, 1);
    box.min[axis] = -reach_of(axis, -1);
  }
  if (box.empty()) return;
  constexpr std::uint64_t kPerBrick = std::uint64_t{2} * BrickPyramid::kCells * BrickPyramid::kCells;
  bounds_ = box;
  triangles_ = kPerBrick * std::max<std::uint64_t>(1, volume()->pyramid.countHolding(iso().value));
}

bool IsoSurface::crossesAny() const {
  bool any = false;
  const auto has_triangle = [&](const Place& at) {
    const IsoCell cell = cells_.at(at);
    for (unsigned n = 0; cell.triangles != nullptr && n < cell.triangles->count; ++n) {
      if (exists(cell, n)) return true;
    }
    return false;
  };
  volume()->pyramid.forEachHolding(iso().value, [&](const Place& first, const Place& end) {
    if (any) return;
    CrossedCells(volume()->grid, cells_.bound(), first, end).forEach([&](const Place& at) {
      any = any || has_triangle(at);
    });
  });
  return any;
}

std::array<Vec3, 3> IsoSurface::corners(ElementId id) const {
  const IsoCell cell = cells_.at(cells_.placeOf(id));
  std::array<Vec3, 3> corner;
  for (std::size_t i = 0; i < 3; ++i)
    corner[i] = cells_.point(crossing(cell, cell.triangles->edges[id % IsoCells::kPerCell][i]));
  if (mirrored_) std::swap(corner[1], corner[2]);
  return corner;
}

// Change of the value for each step along x, y and z.
Vec3 IsoSurface::gradientAt(const Place& at) const {
  const VoxelGrid& grid = volume()->grid;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double here = grid.at(at[0], at[1], at[2]);
  Vec3 gradient;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Place before = at, after = at;
    --before[axis];
    ++after[axis];
    const double low = at[axis] > 0 ? grid.at(before[0], before[1], before[2]) : kNone;
    const double high = at[axis] < grid.cells(axis) ? grid.at(after[0], after[1], after[2]) : kNone;
    gradient[static_cast<Eigen::Index>(axis)] = slopeOf(low, here, high);
  }
  return gradient;
}

Vec3 IsoSurface::trueNormal(ElementId id, const Vec3& point) const {
  constexpr double kNothing = 1e-9;  // a weight that rounding makes
  const Vec3 place = across_ * (point - frame().origin);
  const Place at = cells_.placeOf(id);
  Vec3 gradient = Vec3::Zero();
  for (unsigned c = 0; c < kCellCorners; ++c) {
    Place corner = at;
    for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] += c >> axis & 1U;
    const double weight = trilinearWeight(place, at, c);
    if (weight > kNothing) gradient += weight * gradientAt(corner);
  }
  const Vec3 outward = -cells_.inward() * (across_.transpose() * gradient);
  const double length = outward.norm();
  return length > 0 && std::isfinite(length) ? Vec3(outward / length) : primitiveOf(*this, id).normal;
}

// Of the cell at a place in samples; absent: it is outside of the volume.
std::optional<std::array<double, kCellCorners>> IsoSurface::valuesAround(const Vec3& place, Place& at) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double along = place[static_cast<Eigen::Index>(axis)];
    const std::uint32_t cells = volume()->grid.cells(axis);
    if (!(along >= 0 && along <= cells)) return {};
    at[axis] = std::min(static_cast<std::uint32_t>(along), cells - 1);
  }
  return volume()->grid.cornersOf(at[0], at[1], at[2]);
}

Site IsoSurface::siteOf(const Vec3& point) const {
  Place at{};
  const auto values = valuesAround(across_ * (point - frame().origin), at);
  if (!values || triangles_ == 0) return Site::kOpen;
  int inside = 0;
  for (const double value : *values) {
    if (std::isnan(value)) return Site::kOpen;
    inside += cells_.inward() * (value - iso().value) >= 0 ? 1 : 0;
  }
  if (inside == 0) return Site::kOpen;
  return inside == static_cast<int>(kCellCorners) ? Site::kMatter : Site::kBoundary;
}

MatterForce IsoSurface::matterAt(const Vec3& point) const {
  if (!matter_) return {};
  const Vec3 place = across_ * (point - frame().origin);
  Place at{};
  const auto values = valuesAround(place, at);
  if (!values) return {};
  double value = 0;
  for (unsigned c = 0; c < kCellCorners; ++c) value += trilinearWeight(place, at, c) * (*values)[c];
  return std::isnan(value) ? MatterForce{} : matter_->at(value).force;
}

std::unique_ptr<const SpatialIndex> IsoSurface::makeIndex() const {
  return std::make_unique<BrickIndex>(cells_, bounds_);
}

std::shared_ptr<const PrimitiveSource> IsoSurface::placed(const Mat3& linear, const Vec3& offset) const {
  return std::make_shared<const IsoSurface>(volume(), frame().placed(linear, offset), iso(), matter_);
}

double IsoSurface::error_m() const {
  // No gradient in metres is less than that in samples over the longest that a step becomes.
  const double longest =
      Eigen::SelfAdjointEigenSolver<Mat3>(frame().axes.transpose() * frame().axes, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .maxCoeff();
  double most = 0;
  cells_.forEach([&](const IsoCell& cell) { most = std::max(most, errorOf_m(cell, std::sqrt(longest))); });
  return most;
}

// Where linear interpolation on edges and triangles leaves out the mixed differences D of the values:
// ((|Dxy| + |Dyz| + |Dzx|) / 3 + |Dxyz| / 2) / least gradient.
double IsoSurface::errorOf_m(const IsoCell& cell, double longest_step_m) const {
  const auto& v = cell.value;
  double mixed = 0, square = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned step = 1U << axis, u = 1U << (axis + 1) % 3, w = 1U << (axis + 2) % 3;
    const std::array<double, 4> slope{v[step] - v[0], v[step | u] - v[u], v[step | w] - v[w],
                                      v[step | u | w] - v[u | w]};
    const auto [low, high] = std::minmax_element(slope.begin(), slope.end());
    const double least = std::max({*low, -*high, 0.0});
    square += least * least;
    mixed += std::max(std::abs(slope[1] - slope[0]), std::abs(slope[3] - slope[2])) / 3;
    if (axis == 0) mixed += std::abs(slope[3] - slope[2] - slope[1] + slope[0]) / 2;
  }
  double diagonal = 0;
  for (const double y : {-1.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) diagonal = std::max(diagonal, (frame().axes * Vec3(1, y, z)).norm());
  }
  return square > 0 ? std::min(diagonal, longest_step_m * mixed / std::sqrt(square)) : diagonal;
}

// Thinned until it has few enough triangles: a quarter of them for each doubling.
DrawnMesh IsoSurface::drawn(std::size_t most_triangles) const {
  DrawnMesh mesh;
  for (std::uint32_t step = 1;; ++step) {
    const bool coarsest = step >= std::max({volume()->grid.cells(0), volume()->grid.cells(1), volume()->grid.cells(2)});
    const std::size_t cells = volume()->grid.count() / (std::size_t{step} * step * step);
    if (!coarsest && cells / 64 > most_triangles) continue;
    GridFrame coarse = frame();
    coarse.axes *= step;
    mesh = step == 1 ? drawnInFull() : IsoSurface(thinned(volume()->grid, step), coarse, iso()).drawnInFull();
    if (coarsest || mesh.triangles.size() <= most_triangles) return mesh;
  }
}

// Cells share the vertices on their edges.
class IsoSurface::Drawing {
 public:
  explicit Drawing(const IsoSurface& surface) : surface_(surface) {}

  void add(const IsoCell& cell) {
    for (unsigned n = 0; n < cell.triangles->count; ++n) {
      if (!exists(cell, n)) continue;
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t i = 0; i < 3; ++i)
        triangle[i] = vertexOn(cell, cell.triangles->edges[n][i], surface_.cells_.idOf(cell, n));
      if (surface_.mirrored_) std::swap(triangle[1], triangle[2]);
      mesh_.triangles.push_back(triangle);
    }
  }
  DrawnMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertexOn(const IsoCell& cell, unsigned edge, ElementId id) {
    const VoxelGrid& grid = surface_.volume()->grid;
    std::uint64_t place = 0;
    for (std::size_t axis = 3; axis-- > 0;)
      place = place * grid.side(axis) + cell.at[axis] + (edge == kMiddle ? 0 : beginOfEdge(edge) >> axis & 1U);
    const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
    const auto [entry, added] = numbers_.try_emplace(4 * place + edge / 4, next);
    if (added) {
      mesh_.positions.push_back(surface_.cells_.point(crossing(cell, edge)));
      mesh_.normals.push_back(surface_.trueNormal(id, mesh_.positions.back()));
    }
    return entry->second;
  }

  const IsoSurface& surface_;
  DrawnMesh mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  // of the vertex on an edge, or in the middle of a cell
};

DrawnMesh IsoSurface::drawnInFull() const {
  Drawing drawing(*this);
  cells_.forEach([&](const IsoCell& cell) { drawing.add(cell); });
  return drawing.take();
}

}  // namespace hl
