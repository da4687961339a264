#include "surfaces/patch_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "base/error.h"
#include "geometry/box.h"
#include "surfaces/bezier_piece.h"

namespace hl {

namespace {

constexpr auto kMaxCells = static_cast<std::uint32_t>(kMaxPatchTriangles);  // along a side: what needs more is refused
constexpr double kMinPatchError_m = 1e-12;

using SideKey = std::vector<double>;

SideKey keyOf(const std::vector<ControlPoint>& points) {
  SideKey key;
  for (const ControlPoint& point : points)
    key.insert(key.end(), {point.at.x(), point.at.y(), point.at.z(), point.weight});
  return key;
}

// The way in which all who have this side go along it.
bool goesBackward(const std::vector<ControlPoint>& points) {
  return keyOf({points.rbegin(), points.rend()}) < keyOf(points);
}

// Vertices of a side that is divided into `n`, from its first control point on.
std::vector<Vec3> dividedSide(std::vector<ControlPoint> points, std::uint32_t n) {
  const bool backward = goesBackward(points);
  if (backward) std::reverse(points.begin(), points.end());
  std::vector<Vec3> vertices;
  for (std::uint32_t i = 0; i <= n; ++i) vertices.push_back(curvePoint(points, static_cast<double>(i) / n));
  if (backward) std::reverse(vertices.begin(), vertices.end());
  return vertices;
}

// Sides that must be divided alike: opposite ones of a piece, and the same one of two pieces.
class SideClasses {
 public:
  /// A number for the side; the same for the same control points, in either order.
  std::size_t side(const std::vector<ControlPoint>& points) {
    const auto same = [&](const ControlPoint& point) { return point.at == points.front().at; };
    if (std::all_of(points.begin(), points.end(), same)) return fresh();  // without length: no neighbour cares
    const SideKey key = goesBackward(points) ? keyOf({points.rbegin(), points.rend()}) : keyOf(points);
    const auto [place, is_new] = sides_.try_emplace(key, parent_.size());
    return is_new ? fresh() : place->second;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t to = classOf(a), from = classOf(b);
    parent_[from] = to;
    cells_[to] = std::max(cells_[to], cells_[from]);
  }
  void need(std::size_t side, std::uint32_t cells) {
    std::uint32_t& there = cells_[classOf(side)];
    there = std::max(there, cells);
  }
  std::uint32_t cells(std::size_t side) { return cells_[classOf(side)]; }

 private:
  std::size_t fresh() {
    parent_.push_back(parent_.size());
    cells_.push_back(1);
    return parent_.size() - 1;
  }
  std::size_t classOf(std::size_t side) {
    while (parent_[side] != side) side = parent_[side] = parent_[parent_[side]];
    return side;
  }

  std::map<SideKey, std::size_t> sides_;
  std::vector<std::size_t> parent_;
  std::vector<std::uint32_t> cells_;
};

std::uint32_t cellsOf(double wanted) {
  return static_cast<std::uint32_t>(std::clamp(std::ceil(wanted), 1.0, static_cast<double>(kMaxCells)));
}

// How many cells along u and v keep a piece within `error_m`: in the ratio in which it is curved.
std::array<std::uint32_t, 2> cellsFor(const PatchCurvature& curvature, double error_m) {
  const double a = std::sqrt(curvature.uu + curvature.uv), b = std::sqrt(curvature.vv + curvature.uv);
  PatchCurvature scaled;
  if (a > 0) scaled.uu = curvature.uu / (a * a);
  if (b > 0) scaled.vv = curvature.vv / (b * b);
  if (a > 0 && b > 0) scaled.uv = curvature.uv / (a * b);
  const double times = std::sqrt(scaled.error(1, 1) / error_m);
  return {cellsOf(times * a), cellsOf(times * b)};
}

double sizeOf(const std::vector<NurbsPatch>& patches) {
  Box box;
  for (const NurbsPatch& patch : patches) {
    for (const ControlPoint& point : patch.points) box.extend(point.at);
  }
  return box.size().maxCoeff();
}

struct PieceSides {
  std::size_t along_u, along_v;
  PatchCurvature curvature;
};

// All pieces, with what they need; what each gets follows when all have said so.
void addPieces(PatchPlan& plan, std::size_t patch, double error_m, SideClasses& classes,
               std::vector<PieceSides>& sides) {
  const BezierNet& net = plan.nets[patch];
  for (std::size_t j = 0; j < net.piecesV(); ++j) {
    for (std::size_t i = 0; i < net.piecesU(); ++i) {
      const BezierPiece piece(net, i, j);
      std::array<std::size_t, 4> number{};
      for (std::size_t k = 0; k < 4; ++k) number[k] = classes.side(piece.side(k));
      classes.join(number[0], number[2]);
      classes.join(number[1], number[3]);
      const PatchCurvature curvature = piece.curvature();
      const auto [n_u, n_v] = cellsFor(curvature, error_m);
      classes.need(number[0], n_u);
      classes.need(number[1], n_v);
      sides.push_back({number[0], number[1], curvature});
      plan.pieces.push_back({patch, i, j, 1, 1});
    }
  }
}

// One piece on its way into a mesh.
class PieceMesh {
 public:
  PieceMesh(const BezierNet& net, const PatchPlan::Piece& plan, PatchMesh& mesh)
      : net_(net), plan_(plan), piece_(net, plan.i, plan.j), mesh_(mesh), base_(mesh.positions.size()) {}

  void append() {
    for (std::size_t k = 0; k < 4; ++k) sides_[k] = dividedSide(piece_.side(k), k % 2 == 0 ? plan_.n_u : plan_.n_v);
    for (std::uint32_t j = 0; j <= plan_.n_v; ++j) {
      for (std::uint32_t i = 0; i <= plan_.n_u; ++i) addVertex(i, j);
    }
    for (std::uint32_t j = 0; j < plan_.n_v; ++j) {
      for (std::uint32_t i = 0; i < plan_.n_u; ++i) {
        addTriangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        addTriangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }

 private:
  std::uint32_t at(std::uint32_t i, std::uint32_t j) const {
    return static_cast<std::uint32_t>(base_ + std::size_t{j} * (plan_.n_u + 1) + i);
  }
  Vec3 place(std::uint32_t i, std::uint32_t j, double u, double v) const {
    if (j == 0) return sides_[0][i];
    if (j == plan_.n_v) return sides_[2][i];
    if (i == 0) return sides_[3][j];
    return i == plan_.n_u ? sides_[1][j] : piece_.point(u, v);
  }
  void addVertex(std::uint32_t i, std::uint32_t j) {
    const double u = static_cast<double>(i) / plan_.n_u, v = static_cast<double>(j) / plan_.n_v;
    mesh_.positions.push_back(place(i, j, u, v));
    mesh_.normals.push_back(piece_.normal(u, v));
    const auto on_patch = [](const std::vector<double>& breaks, std::size_t number, double part) {
      return breaks[number] + part * (breaks[number + 1] - breaks[number]);
    };
    mesh_.texcoords.emplace_back(on_patch(net_.breaks_u, plan_.i, u), on_patch(net_.breaks_v, plan_.j, v));
  }
  // On a side without length triangles shrink to lines: the others close the surface.
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::vector<Vec3>& p = mesh_.positions;
    if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) mesh_.triangles.push_back({a, b, c});
  }

  const BezierNet& net_;
  const PatchPlan::Piece& plan_;
  const BezierPiece piece_;
  PatchMesh& mesh_;
  const std::size_t base_;
  std::array<std::vector<Vec3>, 4> sides_;
};

void checkPatches(const std::vector<NurbsPatch>& patches) {
  std::uint64_t pieces = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    try {
      checkPatch(patches[i]);
    } catch (const Error& error) {
      throw Error("patches[" + std::to_string(i) + "]: " + error.what());
    }
    pieces += mostPiecesOf(patches[i]);
    if (pieces > kMaxPatchPieces)
      throw Error("the patches have more than " + std::to_string(kMaxPatchPieces) + " Bezier pieces");
  }
}

}  // namespace

PatchPlan planPatches(const std::vector<NurbsPatch>& patches, double error_m, std::uint64_t most_triangles) {
  PatchPlan plan;
  checkPatches(patches);
  if (patches.empty()) return plan;
  if (error_m == 0) error_m = std::max(kMinPatchError_m, kPatchError * sizeOf(patches));
  SideClasses classes;
  std::vector<PieceSides> sides;
  for (const NurbsPatch& patch : patches) {
    plan.nets.push_back(bezierNetOf(patch));
    addPieces(plan, plan.nets.size() - 1, error_m, classes, sides);
  }
  for (std::size_t i = 0; i < plan.pieces.size(); ++i) {
    PatchPlan::Piece& piece = plan.pieces[i];
    piece.n_u = classes.cells(sides[i].along_u);
    piece.n_v = classes.cells(sides[i].along_v);
    plan.triangles += std::uint64_t{2} * piece.n_u * piece.n_v;
    plan.vertices += (std::uint64_t{1} + piece.n_u) * (std::uint64_t{1} + piece.n_v);
    plan.error_m = std::max(plan.error_m, sides[i].curvature.error(piece.n_u, piece.n_v));
  }
  if (plan.triangles > most_triangles)
    throw Error("the patches would make " + std::to_string(plan.triangles) + " triangles, and " +
                std::to_string(most_triangles) + " at most can be: say a larger patchError");
  return plan;
}

PatchMesh meshPatches(const PatchPlan& plan) {
  PatchMesh mesh;
  mesh.positions.reserve(plan.vertices);
  mesh.normals.reserve(plan.vertices);
  mesh.texcoords.reserve(plan.vertices);
  mesh.triangles.reserve(plan.triangles);
  for (const PatchPlan::Piece& piece : plan.pieces) PieceMesh(plan.nets[piece.patch], piece, mesh).append();
  mesh.error_m = plan.error_m;
  return mesh;
}

}  // namespace hl
