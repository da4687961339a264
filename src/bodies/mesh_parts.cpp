#include "bodies/mesh_parts.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.h"
#include "bodies/mesh_pieces.h"
#include "bodies/nearly_convex.h"
#include "bodies/piece_mesh.h"

namespace hl {

namespace {

// Of the size of a hull: rounding.
constexpr double kWithin = 1e-9;

struct Part {
  Hull hull;
  Solid solid;  // of the hull
  std::size_t piece = 0;
};

std::vector<PieceMesh> meshesOfPieces(const Model& model) {
  auto pieces = piecesOf(model.positions, model.triangles);
  if (pieces.size() > kMostParts) {  // all together are cut
    for (std::size_t i = 1; i < pieces.size(); ++i)
      pieces[0].insert(pieces[0].end(), pieces[i].begin(), pieces[i].end());
    pieces.resize(1);
  }
  std::vector<PieceMesh> meshes;
  for (const auto& piece : pieces) meshes.push_back(pieceMesh(model, piece));
  return meshes;
}

NearlyConvex partsOfPiece(const PieceMesh& mesh, std::size_t number, double allowed_m, std::size_t most) {
  try {
    return nearlyConvex(mesh, allowed_m, most);
  } catch (const Error& error) {
    throw Error("piece " + std::to_string(number + 1) + " of its mesh, of " + std::to_string(mesh.vertices.size()) +
                " corners: " + error.what());
  }
}

bool holds(const Hull& hull, const Hull& other) {
  const std::vector<Vec3>& vertices = other.shape.vertices;
  return std::all_of(vertices.begin(), vertices.end(),
                     [&](const Vec3& vertex) { return heightAbove(hull.shape, vertex) <= kWithin * hull.shape.reach; });
}

// Of two that hold each other the first stays.
std::vector<Part> withoutNested(std::vector<Part> parts) {
  std::vector<Part> kept;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    bool held = false;
    for (std::size_t j = 0; j < parts.size() && !held; ++j)
      held = j != i && holds(parts[j].hull, parts[i].hull) && (j < i || !holds(parts[i].hull, parts[j].hull));
    if (!held) kept.push_back(parts[i]);
  }
  return kept;
}

Solid solidOfPiece(const PieceMesh& mesh, const std::vector<Solid>& parts) {
  if (parts.size() == 1) return parts.front();
  try {
    return solidOf(mesh.vertices, mesh.triangles);
  } catch (const Error&) {  // it is open
    return sumOf(parts);
  }
}

// Pieces of which no part is left do not count.
Solid solidOfAll(const std::vector<PieceMesh>& meshes, const std::vector<Part>& parts) {
  std::vector<std::vector<Solid>> of_piece(meshes.size());
  for (const Part& part : parts) of_piece[part.piece].push_back(part.solid);
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (!of_piece[i].empty()) solids.push_back(solidOfPiece(meshes[i], of_piece[i]));
  }
  return sumOf(solids);
}

// Each piece gets one part at least; what is left of kMostParts goes to those that come first.
std::vector<Part> partsOf(const std::vector<PieceMesh>& meshes, double allowed_m, MeshParts& made) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::size_t most = kMostParts - parts.size() - (meshes.size() - 1 - i);
    NearlyConvex some = partsOfPiece(meshes[i], i, allowed_m, most);
    made.error_m = std::max(made.error_m, some.outside_m);
    made.excess_m = std::max(made.excess_m, some.excess_m);
    for (Hull& hull : some.hulls) {
      const Solid solid = solidOf(hull.shape);
      parts.push_back({std::move(hull), solid, i});
    }
  }
  return withoutNested(std::move(parts));
}

}  // namespace

std::vector<std::vector<Vec3>> cornersOfPieces(const Model& model) {
  std::vector<std::vector<Vec3>> corners;
  for (PieceMesh& mesh : meshesOfPieces(model)) corners.push_back(std::move(mesh.vertices));
  return corners;
}

MeshParts partsOfMesh(const Model& model) {
  const std::vector<PieceMesh> meshes = meshesOfPieces(model);
  if (meshes.empty()) throw Error("its mesh has no triangles, and so no parts: use its hull or a box");
  MeshParts made;
  std::vector<Part> parts = partsOf(meshes, kNearlyConvex * model.bounds().size().norm() / 2, made);
  made.solid = solidOfAll(meshes, parts);
  std::vector<Convex> shapes;
  for (Part& part : parts) {
    Convex shape = moved(std::move(part.hull.shape), -made.solid.centre_O);
    shapes.push_back(withMiddle(std::move(shape), part.solid.centre_O - made.solid.centre_O));
  }
  made.shape = Compound(std::move(shapes));
  return made;
}

}  // namespace hl
