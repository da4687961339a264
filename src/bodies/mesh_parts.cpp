#include "bodies/mesh_parts.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "bodies/mesh_holes.h"
#include "bodies/mesh_pieces.h"
#include "bodies/nearly_convex.h"

namespace hl {

namespace {

// Of the size of a hull: rounding.
constexpr double kWithin = 1e-9;

struct Part {
  Hull hull;
  Solid solid;  // of the hull
  std::size_t piece = 0;
};

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

// What a piece is made of.
struct Matter {
  std::optional<Solid> solid;  // none of a mesh that crosses itself so that it holds less than nothing somewhere
  bool is_shell = false;
  std::size_t open_edges = 0;
};

Matter matterOf(const PieceMesh& mesh, double thickness_m) {
  const CappedMesh closed = capped(mesh);
  Matter matter{std::nullopt, closed.isShell(), closed.open_edges};
  try {
    const Solid solid = matter.is_shell ? solidOfSheet(mesh.vertices, mesh.triangles, thickness_m)
                                        : solidOf(closed.vertices, closed.triangles);
    if (matter.is_shell || isMatterWithin(boundsOf(mesh), solid)) matter.solid = solid;
  } catch (const Error&) {  // it holds nothing
  }
  return matter;
}

// A part of how far the mesh reaches from the middle of its surface: of a mesh that is turned it stays the same, which
// that of its bounds would not.
double thicknessOfShells(const std::vector<PieceMesh>& meshes) {
  constexpr double kThickness = 0.01;
  Vec3 sum = Vec3::Zero();
  double area = 0, reach = 0;
  for (const PieceMesh& mesh : meshes) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
      const double part = (q - p).cross(r - p).norm();
      sum += part / 3 * (p + q + r);
      area += part;
    }
  }
  for (const PieceMesh& mesh : meshes) {
    for (const Vec3& vertex : mesh.vertices) reach = std::max(reach, (vertex - sum / area).norm());
  }
  return kThickness * reach;
}

// The mesh that reaches farthest is a body, whichever way it faces.
bool facesInward(const std::vector<PieceMesh>& meshes) {
  return std::max_element(meshes.begin(), meshes.end(),
                          [](const PieceMesh& a, const PieceMesh& b) { return sizeOf(a) < sizeOf(b); })
      ->is_turned;
}

// A piece of which no part is left, as it lies within others, does not count, but for a hollow, which is taken off.
Solid solidOfAll(const std::vector<PieceMesh>& meshes, const std::vector<Part>& parts, MeshParts& made) {
  std::vector<std::vector<Solid>> of_piece(meshes.size());
  for (const Part& part : parts) of_piece[part.piece].push_back(part.solid);
  const bool inward = facesInward(meshes);
  const double thickness_m = thicknessOfShells(meshes);
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Matter matter = matterOf(meshes[i], thickness_m);
    const std::optional<Solid>& held = matter.solid;
    if (!of_piece[i].empty()) {
      solids.push_back(held ? *held : sumOf(of_piece[i]));
      made.open_edges += matter.open_edges;
      if (matter.is_shell) made.shell_m = thickness_m;
    } else if (held && !matter.is_shell && meshes[i].is_turned != inward) {
      solids.push_back({-held->volume_m3, held->centre_O, -held->inertia_m5});
    }
  }
  return sumOf(solids);
}

// Of hollows that are larger than what is around them, the parts alone count.
Solid solidOf(const std::vector<PieceMesh>& meshes, const std::vector<Part>& parts, MeshParts& made) {
  Box bounds;
  for (const PieceMesh& mesh : meshes) bounds.extend(boundsOf(mesh));
  const Solid solid = solidOfAll(meshes, parts, made);
  bounds.min.array() -= made.shell_m / 2;
  bounds.max.array() += made.shell_m / 2;
  if (isMatterWithin(bounds, solid)) return solid;
  std::vector<Solid> solids;
  solids.reserve(parts.size());
  for (const Part& part : parts) solids.push_back(part.solid);
  return sumOf(solids);
}

void addParts(NearlyConvex some, std::size_t piece, std::vector<Part>& parts) {
  for (Hull& hull : some.hulls) {
    const Solid solid = solidOf(hull.shape);
    parts.push_back({std::move(hull), solid, piece});
  }
}

struct PartsOfPiece {
  NearlyConvex parts;
  std::exception_ptr why;  // there are none
};

PartsOfPiece tryPiece(const PieceMesh& mesh, std::size_t number, double allowed_m, std::size_t most) {
  try {
    return {partsOfPiece(mesh, number, allowed_m, most), nullptr};
  } catch (const Error&) {
    return {{}, std::current_exception()};
  }
}

// A piece that is nearly convex is one part; what is left of kMaxParts is shared among the others. A sliver that has
// no hull is left out, unless it is all that there is.
std::vector<Part> partsOf(const std::vector<PieceMesh>& meshes, double allowed_m, MeshParts& made) {
  std::vector<PartsOfPiece> pieces;
  for (std::size_t i = 0; i < meshes.size(); ++i) pieces.push_back(tryPiece(meshes[i], i, allowed_m, 1));
  const auto is_cut = [&](const PartsOfPiece& one) { return one.parts.excess_m > allowed_m; };
  auto cut = static_cast<std::size_t>(std::count_if(pieces.begin(), pieces.end(), is_cut));
  std::size_t left = kMaxParts - (meshes.size() - cut);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (!is_cut(pieces[i])) continue;
    pieces[i] = tryPiece(meshes[i], i, allowed_m, left / cut--);
    left -= pieces[i].parts.hulls.size();
  }
  std::vector<Part> parts;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    made.error_m = std::max(made.error_m, pieces[i].parts.outside_m);
    made.excess_m = std::max(made.excess_m, pieces[i].parts.excess_m);
    addParts(std::move(pieces[i].parts), i, parts);
  }
  if (parts.empty()) std::rethrow_exception(pieces.front().why);
  return withoutNested(std::move(parts));
}

}  // namespace

std::vector<PieceMesh> meshesOfPieces(const Model& model) {
  auto pieces = piecesOf(model.positions, model.triangles);
  if (pieces.size() > kMaxParts) {  // all together are cut
    for (std::size_t i = 1; i < pieces.size(); ++i)
      pieces[0].insert(pieces[0].end(), pieces[i].begin(), pieces[i].end());
    pieces.resize(1);
  }
  std::vector<PieceMesh> meshes;
  for (const auto& piece : pieces) {
    PieceMesh mesh = pieceMesh(model, piece);
    const bool is_there = std::any_of(meshes.begin(), meshes.end(), [&](const PieceMesh& other) {
      return other.vertices == mesh.vertices && other.triangles == mesh.triangles;
    });
    if (!is_there) meshes.push_back(std::move(mesh));
  }
  return meshes;
}

MeshParts partsOfMesh(const Model& model) {
  const std::vector<PieceMesh> meshes = meshesOfPieces(model);
  if (meshes.empty()) throw Error("its mesh has no triangles, and so no parts: use its hull or a box");
  MeshParts made;
  std::vector<Part> parts = partsOf(meshes, kNearlyConvex * model.bounds().size().norm() / 2, made);
  made.solid = solidOf(meshes, parts, made);
  std::vector<Convex> shapes;
  for (Part& part : parts) {
    Convex shape = moved(std::move(part.hull.shape), -made.solid.centre_O);
    shapes.push_back(withMiddle(std::move(shape), part.solid.centre_O - made.solid.centre_O));
  }
  made.shape = Compound(std::move(shapes));
  return made;
}

}  // namespace hl
