#include "bodies/nearly_convex.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/remembered.h"
#include "bodies/convex_cuts.h"
#include "bodies/mass.h"
#include "bodies/mesh_holes.h"

namespace hl {

namespace {

constexpr std::size_t kMaxProbes = 20'000;
constexpr std::size_t kRememberedBytes = std::size_t{64} << 20;  // of meshes

using Places = std::vector<Vec3>;

// Points of the surface, evenly among its triangles.
Places probesOf(const PieceMesh& mesh) {
  Places probes;
  const std::size_t step = 1 + mesh.triangles.size() * 7 / kMaxProbes;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += step) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    for (const Vec3& probe : {p, q, r, Vec3((p + q) / 2), Vec3((q + r) / 2), Vec3((r + p) / 2), Vec3((p + q + r) / 3)})
      probes.push_back(probe);
  }
  return probes;
}

double outsideOf(const Places& probes, const std::vector<Hull>& hulls) {
  double outside = 0;
  for (const Vec3& probe : probes) {
    double above = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hulls.size() && above > outside; ++i)
      above = std::min(above, heightAbove(hulls[i].shape, probe));
    outside = std::max(outside, above);
  }
  return outside;
}

CutSurface surfaceOf(const PieceMesh& mesh) {
  CutSurface surface;
  for (const auto& [a, b, c] : mesh.triangles)
    surface.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  return surface;
}

// None, of a sliver: what it held is measured as outside.
std::optional<Hull> hullWithVolume(const Places& corners) {
  try {
    Hull hull = hullOf(corners);
    solidOf(hull.shape);
    return hull;
  } catch (const Error&) {
    return std::nullopt;
  }
}

// Each vertex that the cuts of a coarse mesh have left outside goes to the hull that it is least above.
void takeAll(const Places& vertices, std::vector<Places>& corners, std::vector<Hull>& hulls) {
  if (hulls.empty()) return;
  std::vector<bool> grown(hulls.size());
  for (const Vec3& vertex : vertices) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hulls.size() && least > 0; ++i) {
      const double above = heightAbove(hulls[i].shape, vertex);
      if (above < least) {
        least = above;
        nearest = i;
      }
    }
    if (least <= 0) continue;
    corners[nearest].push_back(vertex);
    grown[nearest] = true;
  }
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    std::optional<Hull> hull = grown[i] ? hullWithVolume(corners[i]) : std::nullopt;
    if (hull) hulls[i] = *std::move(hull);
  }
}

NearlyConvex asPieces(const PieceMesh& mesh, const CutPiece& coarse, const CutRules& rules, double thickness_m) {
  NearlyConvex parts;
  std::vector<Places> corners;
  for (const NearPiece& near : cutPieces(coarse, rules)) {
    parts.excess_m = std::max(parts.excess_m, near.error_m);
    Places some = near.piece.thickCorners(thickness_m);
    std::optional<Hull> hull = hullWithVolume(some);
    if (!hull) continue;
    parts.hulls.push_back(*std::move(hull));
    corners.push_back(std::move(some));
  }
  takeAll(mesh.vertices, corners, parts.hulls);
  return parts;
}

NearlyConvex madeAnew(const PieceMesh& mesh, const CutRules& rules) {
  const Places probes = probesOf(mesh);
  const CutPiece coarse(surfaceOf(coarseMesh(mesh, kCoarseTriangles)));
  std::optional<Hull> hull = hullWithVolume(mesh.vertices);
  const PieceMeasure measure(coarse.surface(), rules.is_shell, rules.allowed_m);
  if (!hull) hull = hullWithVolume(coarse.thickCorners(measure.thickness()));
  if (!hull) throw Error("hull: the points lie in a plane or on a line: give the shape a thickness, or use a box");
  NearlyConvex whole{{*std::move(hull)}};
  whole.excess_m = measure.exactly(coarse).error_m;
  whole.outside_m = outsideOf(probes, whole.hulls);
  if (rules.most == 1 || whole.excess_m <= rules.allowed_m) return whole;
  NearlyConvex parts = asPieces(mesh, coarse, rules, measure.thickness());
  parts.outside_m = outsideOf(probes, parts.hulls);
  return parts.hulls.empty() ? whole : parts;
}

struct Question {
  PieceMesh mesh;
  double allowed_m = 0;
  std::size_t most = 0;
  bool operator==(const Question&) const = default;
};

std::size_t bytesOf(const PieceMesh& mesh) {
  return mesh.vertices.size() * sizeof(Vec3) + mesh.triangles.size() * sizeof(Corners);
}

}  // namespace

NearlyConvex nearlyConvex(const PieceMesh& mesh, double allowed_m, std::size_t most) {
  static Remembered<Question, NearlyConvex> remembered(kRememberedBytes);
  const Question question{mesh, allowed_m, most};
  if (std::optional<NearlyConvex> known = remembered.find(question)) return *std::move(known);
  NearlyConvex made = madeAnew(mesh, {capped(mesh).isShell(), allowed_m, most});
  remembered.keep(question, made, bytesOf(mesh));
  return made;
}

}  // namespace hl
