#include "surfaces/implicit/implicit_surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "surfaces/implicit/implicit_index.h"
#include "surfaces/implicit/sheet_bricks.h"
#include "surfaces/implicit/sheet_list.h"

namespace hl {

namespace {

// Of the longest to the shortest height of a cell: then the flattest of its triangles is still one (kSliver).
constexpr double kMaxStretchedCell = 50;

/// Calls visit(id, triangle) for each triangle of a brick and what is beneath it.
template <typename Visit>
void visitBrick(SheetBricks& bricks, int level, const Sheet::Place& at, const Visit& visit) {
  if (!bricks.holds(level, at)) return;
  const std::uint32_t per_brick = level == 0 ? BrickPyramid::kCells : BrickPyramid::kBricks;
  Sheet::Place first{}, end{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = at[axis] * per_brick;
    end[axis] = std::min(first[axis] + per_brick, level == 0 ? bricks.cells(axis) : bricks.side(level - 1, axis));
  }
  for (std::uint32_t z = first[2]; z < end[2]; ++z) {
    for (std::uint32_t y = first[1]; y < end[1]; ++y) {
      for (std::uint32_t x = first[0]; x < end[0]; ++x) {
        if (level > 0) {
          visitBrick(bricks, level - 1, {x, y, z}, visit);
        } else if (bricks.mayCross(bricks.origin() + bricks.step() * Vec3(x + 0.5, y + 0.5, z + 0.5))) {
          bricks.visitTriangles({x, y, z}, visit);
        }
      }
    }
  }
}

struct BitsOfPoint {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::size_t bits = 0;
    for (const double one : p) bits = bits * 1'000'003 ^ std::hash<double>()(one);
    return bits;
  }
};

/// Sheets have vertices of their own, so that edges between them stay sharp.
class SheetDrawing {
 public:
  SheetDrawing(const Mat3& across, const Vec3& origin, bool mirrored)
      : across_(across), origin_(origin), mirrored_(mirrored) {}

  void add(const Sheet& sheet, const GridFrame& frame) {
    numbers_.clear();
    SheetBricks bricks(sheet, frame, nullptr);
    visitBrick(bricks, bricks.levels() - 1, {0, 0, 0}, [&](ElementId, const std::array<Vec3, 3>& corners) {
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t i = 0; i < 3; ++i) triangle[i] = vertexAt(sheet, corners[i]);
      if (mirrored_) std::swap(triangle[1], triangle[2]);
      mesh_.triangles.push_back(triangle);
    });
  }
  DrawnMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertexAt(const Sheet& sheet, const Vec3& p) {
    const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
    const auto [entry, added] = numbers_.try_emplace({p.x(), p.y(), p.z()}, next);
    if (added) {
      mesh_.positions.push_back(p);
      mesh_.normals.push_back((across_.transpose() * sheet.smooth().gradient(across_ * (p - origin_))).normalized());
    }
    return entry->second;
  }

  const Mat3& across_;
  const Vec3& origin_;
  bool mirrored_;
  DrawnMesh mesh_;
  std::unordered_map<std::array<double, 3>, std::uint32_t, BitsOfPoint> numbers_;
};

double longestOf(const Mat3& axes) {
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Mat3>(axes.transpose() * axes, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
}

}  // namespace

ImplicitSurface::ImplicitSurface(const ImplicitSpec& spec)
    : ImplicitSurface(std::make_shared<const SheetList>(spec), GridFrame()) {}

ImplicitSurface::ImplicitSurface(std::shared_ptr<const SheetList> list, const GridFrame& frame)
    : list_(std::move(list)), frame_(frame), across_(frame.axes.inverse()), mirrored_(frame.axes.determinant() < 0) {
  place();
}

void ImplicitSurface::place() {
  if (!frame_.axes.allFinite() || !frame_.origin.allFinite() || !across_.allFinite())
    throw Error("the placement of a surface must be numbers, and not flatten it");
  double longest = 0, thinnest = Interval::kNoEnd;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    longest = std::max(longest, frame_.axes.col(axis).norm());
    thinnest = std::min(thinnest, 1 / across_.row(axis).norm());
  }
  if (!(longest <= kMaxStretchedCell * thinnest))
    throw Error("an implicit surface is stretched to more than 50 times as long as thin");
  for (int corner = 0; corner < 8; ++corner) {
    const Box& box = list_->bounds;
    const Vec3 at((corner & 1) != 0 ? box.max.x() : box.min.x(), (corner & 2) != 0 ? box.max.y() : box.min.y(),
                  (corner & 4) != 0 ? box.max.z() : box.min.z());
    bounds_.extend(frame_.point(at.x(), at.y(), at.z()));
  }
  if (!withinReach(bounds_.min) || !withinReach(bounds_.max)) throw Error("an implicit surface lies beyond 1e9 m");
  triangles_ = static_cast<std::uint64_t>(std::max(1.0, list_->triangles));
}

ElementId ImplicitSurface::count() const { return ElementId{list_->function.sheets().size()} << 57; }

std::array<Vec3, 3> ImplicitSurface::corners(ElementId id) const {
  const SheetTriangle which = SheetTriangle::of(id);
  const auto& sheets = list_->sheets;
  const auto sheet = std::lower_bound(sheets.begin(), sheets.end(), which.sheet,
                                      [](const Sheet& one, std::size_t number) { return one.number() < number; });
  SheetPieces pieces;
  sheet->pieces(sheet->corners(sheet->cellAt(which.cell), which.triangle), pieces);
  std::array<Vec3, 3> corners = pieces.triangles[which.piece];
  for (Vec3& corner : corners) corner = frame_.point(corner.x(), corner.y(), corner.z());
  if (mirrored_) std::swap(corners[1], corners[2]);
  return corners;
}

Vec3 ImplicitSurface::trueNormal(ElementId id, const Vec3& point) const {
  const SmoothFunction& smooth = list_->function.sheets()[SheetTriangle::of(id).sheet];
  return (across_.transpose() * smooth.gradient(across_ * (point - frame_.origin))).normalized();
}

std::unique_ptr<const SpatialIndex> ImplicitSurface::makeIndex() const {
  return std::make_unique<ImplicitIndex>(list_->sheets, frame_, bounds_, steps()[0]);
}

SharedMemory ImplicitSurface::shared() const { return {list_.get(), list_->bytes()}; }

double ImplicitSurface::error_m() const { return longestOf(frame_.axes) * list_->error_m; }

Site ImplicitSurface::siteOf(const Vec3& point) const {
  const Vec3 at = across_ * (point - frame_.origin);
  const Box& within = list_->within;
  if (!(at.array() >= within.min.array()).all() || !(at.array() <= within.max.array()).all()) return Site::kOpen;
  const double value = list_->function.at(at);
  if (std::abs(value) <= list_->off) return Site::kBoundary;
  return value < 0 ? Site::kMatter : Site::kOpen;
}

std::shared_ptr<const PrimitiveSource> ImplicitSurface::placed(const Mat3& linear, const Vec3& offset) const {
  return std::shared_ptr<const ImplicitSurface>(new ImplicitSurface(list_, frame_.placed(linear, offset)));
}

// A quarter of the triangles for cells twice as large.
DrawnMesh ImplicitSurface::drawn(std::size_t most_triangles) const {
  const double many = list_->triangles / std::max<double>(1, static_cast<double>(most_triangles));
  for (double factor = std::max(1.0, std::sqrt(many));; factor *= 1.4) {
    DrawnMesh mesh = drawnCoarser(factor);
    const bool coarsest = factor > SheetGrid::kMaxCells;
    if (coarsest || mesh.triangles.size() <= most_triangles) return mesh;
  }
}

DrawnMesh ImplicitSurface::drawnCoarser(double factor) const {
  SheetDrawing drawing(across_, frame_.origin, mirrored_);
  for (const Sheet& sheet : factor > 1 ? list_->coarser(factor) : list_->sheets) drawing.add(sheet, frame_);
  return drawing.take();
}

const ImplicitSpec& ImplicitSurface::spec() const { return list_->spec; }
std::size_t ImplicitSurface::sheets() const { return list_->sheets.size(); }

std::array<double, 2> ImplicitSurface::steps() const {
  std::array<double, 2> steps{Interval::kNoEnd, 0};
  const double longest = longestOf(frame_.axes);
  for (const Sheet& sheet : list_->sheets)
    steps = {std::min(steps[0], longest * sheet.grid().step), std::max(steps[1], longest * sheet.grid().step)};
  return steps;
}

}  // namespace hl
