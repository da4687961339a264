#include "surfaces/iso_surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "surfaces/brick_index.h"
#include "surfaces/slope.h"

namespace hl {

namespace {

// Of an edge of a cell: a surface that crosses it as near to its end goes through that end, so that no triangle is a
// sliver. Of a cell of 1 mm, a picometre.
constexpr double kAtEnd = 0x1p-30;
// Of the longest to the shortest height of a cell: then the flattest of its triangles is still one (kSliver).
constexpr double kMostStretched = 50;

using Place = std::array<std::uint32_t, 3>;

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

}  // namespace

IsoSurface::IsoSurface(std::shared_ptr<const Volume> volume, const GridFrame& frame, const IsoValue& iso)
    : volume_(std::move(volume)),
      frame_(frame),
      iso_(iso),
      outward_(iso.solid == SolidSide::kAbove ? -1 : 1),
      across_(frame.axes.inverse()),
      mirrored_(frame.axes.determinant() < 0) {
  if (!std::isfinite(iso.value)) throw Error("the iso value of a volume must be a number");
  checkFrame();
  measure();
}

void IsoSurface::checkFrame() const {
  if (!frame_.axes.allFinite() || !frame_.origin.allFinite() || !across_.allFinite())
    throw Error("the axes of a volume's grid must be numbers, none of them 0, and not lie in one plane");
  double longest = 0, thinnest = std::numeric_limits<double>::infinity();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    longest = std::max(longest, frame_.axes.col(axis).norm());
    thinnest = std::min(thinnest, 1 / across_.row(axis).norm());
  }
  if (!(longest <= kMostStretched * thinnest))
    throw Error("the cells of a volume are more than 50 times as long as thin: resample it");
  const Vec3 last = frame_.point(volume_->grid.cells(0), volume_->grid.cells(1), volume_->grid.cells(2));
  if (!withinReach(frame_.origin) || !withinReach(last)) throw Error("a volume reaches beyond 1e9 m");
}

// By the bricks in which it is.
void IsoSurface::measure() {
  constexpr std::uint64_t kPerBrick = 2 * BrickPyramid::kCells * BrickPyramid::kCells;
  volume_->pyramid.forEachHolding(iso_.value, [&](const Place& first, const Place& end) {
    triangles_ += kPerBrick;
    for (unsigned c = 0; c < kCellCorners; ++c) {
      const auto at = [&](std::size_t axis) { return (c >> axis & 1U) != 0 ? end[axis] : first[axis]; };
      bounds_.extend(frame_.point(at(0), at(1), at(2)));
    }
  });
}

ElementId IsoSurface::count() const {
  const VoxelGrid& grid = volume_->grid;
  return kPerCell * grid.cells(0) * grid.cells(1) * grid.cells(2);
}

Place IsoSurface::cellOf(ElementId id) const {
  const VoxelGrid& grid = volume_->grid;
  const ElementId cell = id / kPerCell, row = cell / grid.cells(0);
  return {static_cast<std::uint32_t>(cell % grid.cells(0)), static_cast<std::uint32_t>(row % grid.cells(1)),
          static_cast<std::uint32_t>(row / grid.cells(1))};
}

ElementId IsoSurface::idOf(const IsoCell& cell, unsigned triangle) const {
  const VoxelGrid& grid = volume_->grid;
  return kPerCell * ((ElementId{cell.at[2]} * grid.cells(1) + cell.at[1]) * grid.cells(0) + cell.at[0]) + triangle;
}

IsoCell IsoSurface::cell(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
  IsoCell cell{{x, y, z}, volume_->grid.cornersOf(x, y, z), nullptr};
  double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
  for (double& value : cell.value) {
    value = -outward_ * (value - iso_.value);
    sum += value;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low < 0 && high >= 0 && !std::isnan(sum)) cell.triangles = &trianglesOfCell(cell.value);
  return cell;
}

// In samples. The same bits in all cells that share the edge: its two values, from its begin to its end.
Vec3 IsoSurface::placeOn(const IsoCell& cell, unsigned edge) const {
  if (edge == kMiddle) return middleOf(cell);
  const unsigned begin = beginOfEdge(edge);
  const double first = cell.value[begin], last = cell.value[endOfEdge(edge)];
  double part = first / (first - last);
  if (part < kAtEnd) part = 0;
  if (part > 1 - kAtEnd) part = 1;
  Vec3 place(cell.at[0] + (begin & 1U), cell.at[1] + (begin >> 1U & 1U), cell.at[2] + (begin >> 2U & 1U));
  place[static_cast<Eigen::Index>(edge / 4)] += part;
  return place;
}

Vec3 IsoSurface::middleOf(const IsoCell& cell) const {
  Vec3 sum = Vec3::Zero();
  int corners = 0;
  for (unsigned n = 0; n < cell.triangles->count; ++n) {
    const auto& edges = cell.triangles->edges[n];
    if (edges[2] != kMiddle) continue;
    sum += placeOn(cell, edges[0]);
    ++corners;
  }
  return sum / corners;
}

bool IsoSurface::exists(const IsoCell& cell, unsigned triangle) const {
  const auto& edges = cell.triangles->edges[triangle];
  const Vec3 a = placeOn(cell, edges[0]), b = placeOn(cell, edges[1]), c = placeOn(cell, edges[2]);
  return a != b && b != c && c != a;
}

std::array<Vec3, 3> IsoSurface::corners(ElementId id) const {
  const Place at = cellOf(id);
  const IsoCell of = cell(at[0], at[1], at[2]);
  std::array<Vec3, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) {
    corner[i] = point(placeOn(of, of.triangles->edges[id % kPerCell][i]));
  }
  if (mirrored_) std::swap(corner[1], corner[2]);
  return corner;
}

// Change of the value for each step along x, y and z.
Vec3 IsoSurface::gradientAt(const Place& at) const {
  const VoxelGrid& grid = volume_->grid;
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
  const Vec3 place = across_ * (point - frame_.origin);
  const Place at = cellOf(id);
  Vec3 gradient = Vec3::Zero();
  for (unsigned c = 0; c < kCellCorners; ++c) {
    double weight = 1;
    Place corner = at;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double part = std::clamp(place[static_cast<Eigen::Index>(axis)] - at[axis], 0.0, 1.0);
      const bool second = (c >> axis & 1U) != 0;
      weight *= second ? part : 1 - part;
      corner[axis] += second ? 1 : 0;
    }
    if (weight > kNothing) gradient += weight * gradientAt(corner);
  }
  const Vec3 outward = outward_ * (across_.transpose() * gradient);
  const double length = outward.norm();
  return length > 0 && std::isfinite(length) ? Vec3(outward / length) : primitiveOf(*this, id).normal;
}

Site IsoSurface::siteOf(const Vec3& point) const {
  const Vec3 place = across_ * (point - frame_.origin);
  Place at{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double along = place[static_cast<Eigen::Index>(axis)];
    const std::uint32_t cells = volume_->grid.cells(axis);
    if (!(along >= 0 && along <= cells)) return Site::kOpen;
    at[axis] = std::min(static_cast<std::uint32_t>(along), cells - 1);
  }
  const std::array<double, kCellCorners> values = volume_->grid.cornersOf(at[0], at[1], at[2]);
  int inside = 0;
  for (const double value : values) {
    if (std::isnan(value)) return Site::kOpen;
    inside += -outward_ * (value - iso_.value) >= 0 ? 1 : 0;
  }
  if (inside == 0) return Site::kOpen;
  return inside == static_cast<int>(kCellCorners) ? Site::kMatter : Site::kBoundary;
}

std::unique_ptr<const SpatialIndex> IsoSurface::makeIndex() const { return std::make_unique<BrickIndex>(*this); }

std::shared_ptr<const PrimitiveSource> IsoSurface::placed(const Mat3& linear, const Vec3& offset) const {
  return std::make_shared<const IsoSurface>(volume_, frame_.placed(linear, offset), iso_);
}

template <typename Visit>
void IsoSurface::forEachCell(const Visit& visit) const {
  volume_->pyramid.forEachHolding(iso_.value, [&](const Place& first, const Place& end) {
    for (std::uint32_t z = first[2]; z < end[2]; ++z) {
      for (std::uint32_t y = first[1]; y < end[1]; ++y) {
        for (std::uint32_t x = first[0]; x < end[0]; ++x) {
          if (const IsoCell one = cell(x, y, z); one.triangles != nullptr) visit(one);
        }
      }
    }
  });
}

double IsoSurface::error_m() const {
  // No gradient in metres is less than that in samples over the longest that a step becomes.
  const double longest =
      Eigen::SelfAdjointEigenSolver<Mat3>(frame_.axes.transpose() * frame_.axes, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .maxCoeff();
  double most = 0;
  forEachCell([&](const IsoCell& cell) { most = std::max(most, errorOf_m(cell, std::sqrt(longest))); });
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
    for (const double z : {-1.0, 1.0}) diagonal = std::max(diagonal, (frame_.axes * Vec3(1, y, z)).norm());
  }
  return square > 0 ? std::min(diagonal, longest_step_m * mixed / std::sqrt(square)) : diagonal;
}

// Thinned until it has few enough triangles: a quarter of them for each doubling.
DrawnMesh IsoSurface::drawn(std::size_t most_triangles) const {
  DrawnMesh mesh;
  for (std::uint32_t step = 1;; ++step) {
    const bool coarsest = step >= std::max({volume_->grid.cells(0), volume_->grid.cells(1), volume_->grid.cells(2)});
    const std::size_t cells = volume_->grid.count() / (std::size_t{step} * step * step);
    if (!coarsest && cells / 64 > most_triangles) continue;
    GridFrame frame = frame_;
    frame.axes *= step;
    mesh = step == 1 ? drawnInFull() : IsoSurface(thinned(volume_->grid, step), frame, iso_).drawnInFull();
    if (coarsest || mesh.triangles.size() <= most_triangles) return mesh;
  }
}

// Cells share the vertices on their edges.
class IsoSurface::Drawing {
 public:
  explicit Drawing(const IsoSurface& surface) : surface_(surface) {}

  void add(const IsoCell& cell) {
    for (unsigned n = 0; n < cell.triangles->count; ++n) {
      if (!surface_.exists(cell, n)) continue;
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t i = 0; i < 3; ++i)
        triangle[i] = vertexOn(cell, cell.triangles->edges[n][i], surface_.idOf(cell, n));
      if (surface_.mirrored_) std::swap(triangle[1], triangle[2]);
      mesh_.triangles.push_back(triangle);
    }
  }
  DrawnMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertexOn(const IsoCell& cell, unsigned edge, ElementId id) {
    const VoxelGrid& grid = surface_.volume_->grid;
    std::uint64_t place = 0;
    for (std::size_t axis = 3; axis-- > 0;)
      place = place * grid.side(axis) + cell.at[axis] + (edge == kMiddle ? 0 : beginOfEdge(edge) >> axis & 1U);
    const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
    const auto [entry, added] = numbers_.try_emplace(4 * place + edge / 4, next);
    if (added) {
      mesh_.positions.push_back(surface_.point(surface_.placeOn(cell, edge)));
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
  forEachCell([&](const IsoCell& cell) { drawing.add(cell); });
  return drawing.take();
}

}  // namespace hl
