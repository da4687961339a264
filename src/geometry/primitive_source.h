// PrimitiveSource: a surface that is not a mesh. Its triangles are computed on request, so there may be more of them
// than fit into memory: a height field, a volume, a formula. Or its points are: a cloud.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/rgb.h"
#include "base/vec.h"
#include "geometry/box.h"
#include "geometry/element_id.h"
#include "geometry/matter_force.h"
#include "geometry/primitive.h"
#include "geometry/spatial_index.h"

namespace hl {

/// Triangles to draw, with one normal a vertex. Metres, object frame.
struct DrawnMesh {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> texcoords;  ///< one a vertex, of a surface that has them; else none
  std::vector<Rgb> colours;     ///< the same
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// What is at a point.
enum class Site : std::uint8_t {
  kUnknown,  ///< the surface has no matter on one side: of no point it is known
  kOpen,     ///< no matter
  kMatter,
  kBoundary,  ///< so near to the surface that only its triangles could decide
};

/// Memory that several sources use, such as the samples of a volume.
struct SharedMemory {
  const void* of = nullptr;  ///< the same for all that share it; null: nothing is shared
  std::size_t bytes = 0;
};

/// Immutable; metres, object frame. Functions marked RT-safe may be called by any thread and return the same bits for
/// the same arguments.
class PrimitiveSource {
 public:
  virtual ~PrimitiveSource() = default;
  /// Of all its primitives: triangles, or points. RT-safe.
  virtual PrimitiveKind kind() const { return PrimitiveKind::kTriangle; }
  /// Primitives are numbered below it; its index proposes only those that exist. RT-safe.
  virtual ElementId count() const = 0;
  /// About how many triangles there are; of points: how many.
  virtual std::uint64_t triangles() const { return count(); }
  /// The three vertices, which form a valid triangle (isTriangle), counterclockwise seen from outside; or three times a
  /// point. RT-safe.
  virtual std::array<Vec3, 3> corners(ElementId id) const = 0;
  /// Outward unit normal of the exact surface that the primitive approximates, near `point` on it. RT-safe.
  virtual Vec3 trueNormal(ElementId id, const Vec3& point) const = 0;
  /// False if nothing identifies the outside: then the opposite of each normal is as good. RT-safe.
  virtual bool hasOutside() const { return true; }
  /// Whether its triangles have texture coordinates. RT-safe.
  virtual bool hasTexcoords() const { return false; }
  /// Those of vertex `corner` of corners(id), if it has them. RT-safe.
  virtual Vec2 texcoord(ElementId /*id*/, std::size_t /*corner*/) const { return Vec2::Zero(); }
  /// Whether what is drawn of it has colours of its own.
  virtual bool hasColours() const { return false; }
  /// Bounds of all vertices; may be larger.
  virtual Box bounds() const = 0;
  /// Makes the index of its triangles; the source must outlive it. Setup only.
  virtual std::unique_ptr<const SpatialIndex> makeIndex() const = 0;
  /// Memory of the source, bytes; without the index and what it shares.
  virtual std::size_t bytes() const = 0;
  /// What it shares with others.
  virtual SharedMemory shared() const { return {}; }
  /// RT-safe.
  virtual Site siteOf(const Vec3& /*point*/) const { return Site::kUnknown; }
  /// Whether there may be a point whose matter hinders a motion.
  virtual bool resists() const { return false; }
  /// RT-safe.
  virtual MatterForce matterAt(const Vec3& /*point*/) const { return {}; }
  /// Bound of the distance between the primitives and the surface that they stand for, m. May look at all of them.
  virtual double error_m() const = 0;
  /// The same surface moved by x -> linear x + offset; `linear` is invertible. Throws hl::Error if it cannot be.
  virtual std::shared_ptr<const PrimitiveSource> placed(const Mat3& linear, const Vec3& offset) const;
  /// What is drawn of it: about `most_triangles` or fewer. By default all of them, whatever their number,
  /// each with vertices of its own.
  virtual DrawnMesh drawn(std::size_t most_triangles) const;
};

/// RT-safe.
Primitive primitiveOf(const PrimitiveSource& source, ElementId id);

}  // namespace hl
