#include "bodies/mesh_parts.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "base/error.h"
#include "bodies/convex_hull.h"
#include "bodies/mesh_pieces.h"

namespace hl {

namespace {

// Of the size of a hull: rounding.
constexpr double kWithin = 1e-9;

Hull hullOfPiece(const std::vector<Vec3>& corners, std::size_t number) {
  try {
    return hullOf(corners);
  } catch (const Error& error) {
    throw Error("piece " + std::to_string(number + 1) + " of its mesh, of " + std::to_string(corners.size()) +
                " corners: " + error.what());
  }
}

bool holds(const Hull& hull, const Hull& other) {
  const std::vector<Vec3>& vertices = other.shape.vertices;
  return std::all_of(vertices.begin(), vertices.end(),
                     [&](const Vec3& vertex) { return heightAbove(hull.shape, vertex) <= kWithin * hull.shape.reach; });
}

// Of two that hold each other the first stays.
std::vector<Hull> withoutNested(std::vector<Hull> hulls) {
  std::vector<Hull> kept;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    bool held = false;
    for (std::size_t j = 0; j < hulls.size() && !held; ++j)
      held = j != i && holds(hulls[j], hulls[i]) && (j < i || !holds(hulls[i], hulls[j]));
    if (!held) kept.push_back(hulls[i]);
  }
  return kept;
}

}  // namespace

std::vector<std::vector<Vec3>> cornersOfPieces(const Model& model) {
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
  };
  std::vector<std::vector<Vec3>> pieces;
  for (const auto& piece : piecesOf(model.positions, model.triangles)) {
    std::vector<Vec3>& corners = pieces.emplace_back();
    for (const std::uint32_t triangle : piece) {
      for (const std::uint32_t corner : model.triangles[triangle]) corners.push_back(model.positions[corner]);
    }
    std::sort(corners.begin(), corners.end(), before);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  }
  return pieces;
}

MeshParts partsOfMesh(const Model& model) {
  const auto pieces = cornersOfPieces(model);
  if (pieces.empty()) throw Error("its mesh has no triangles, and so no parts: use its hull or a box");
  if (pieces.size() > kMostParts)
    throw Error("its mesh has " + std::to_string(pieces.size()) + " pieces, and a body at most " +
                std::to_string(kMostParts) + " parts: join them, or use its hull");
  std::vector<Hull> hulls;
  for (std::size_t i = 0; i < pieces.size(); ++i) hulls.push_back(hullOfPiece(pieces[i], i));
  hulls = withoutNested(std::move(hulls));
  MeshParts made;
  std::vector<Solid> solids;
  for (const Hull& hull : hulls) {
    solids.push_back(solidOf(hull.shape));
    made.error_m = std::max(made.error_m, hull.error_m);
  }
  made.solid = sumOf(solids);
  std::vector<Convex> parts;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    Convex part = moved(std::move(hulls[i].shape), -made.solid.centre_O);
    parts.push_back(withMiddle(std::move(part), solids[i].centre_O - made.solid.centre_O));
  }
  made.shape = Compound(std::move(parts));
  return made;
}

}  // namespace hl
