// Patch: the surface around a contact, read once for all passes of a sub-goal. In the plane of a triangle with edges
// e1, e2 from vertex 0, the barycentric weights are linear in the position, and so are the texture coordinates and the
// sum of the vertex normals:
//   w_i(x + d) = w_i(x) + g_i . d,   c = e1 x e2,   g_1 = e2 x c / |c|^2,   g_2 = c x e1 / |c|^2,   g_0 = -g_1 - g_2.
// World frame.
#pragma once

#include "base/vec.h"
#include "proxy/surface.h"

namespace hl {

/// The shading normal: the true normal turned by force shading and by a bump map. `shading` and `bump` say how far each
/// turns the normal: 1 - cos of the angle.
struct ShadingNormal {
  Vec3 normal = Vec3::UnitZ();
  double shading = 0;
  double bump = 0;
  bool differs() const { return shading > 0 || bump > 0; }
};

/// RT-safe. The scene must outlive it.
class Patch {
 public:
  Patch(const SceneAt& scene, const Surface& surface, const SurfacePoint& place);

  /// Change of the weights of vertices 1 and 2 for a step (m) in the plane of the triangle.
  Vec2 weightsOver(const Vec3& step) const { return {slope_[0].dot(step), slope_[1].dot(step)}; }

  // In the functions below `moved` is the change of the weights from the point for which the patch was made.

  /// Whether the patch was made on the face of a triangle, and the moved point is still on this face.
  bool covers(const Vec2& moved) const;
  /// Whether the patch is valid at the moved point: on the same face, or anywhere if the surface is uniform, as that of
  /// a point.
  bool holds(const Vec2& moved) const { return !triangle_ || (!smooth_ && !textured_) || covers(moved); }
  /// The moved point. The plane of the triangle counts as unbounded.
  SurfacePoint place(const Vec2& moved) const;
  /// Texture coordinates, for a textured triangle only. The plane of the triangle counts as unbounded.
  Vec2 texcoord(const Vec2& moved) const { return texcoord_ + texcoordOver(moved); }
  Vec2 texcoordOver(const Vec2& moved) const { return moved.x() * texcoord_edge_[0] + moved.y() * texcoord_edge_[1]; }

  /// Whether the surface has shading or a bump map; if not, shadingNormal() is the true normal everywhere.
  bool shaded() const { return smooth_ || height_.texture; }
  /// The interpolated vertex normals, at most accuracy::kShadingLimit_rad from the true normal, and then the slope of
  /// the bump map. A triangle with a vertex normal that is missing, zero or on the other side is not shaded; where
  /// nothing identifies the outside, normals are turned to the side of the proxy.
  ShadingNormal shadingNormal(const Vec2& moved = Vec2::Zero()) const;

 private:
  void readPlane(const SceneAt& scene, const Surface& surface);
  void readPointNormal(const SceneAt& scene, const Surface& surface);
  void readNormals(std::array<Vec3, 3> normal, bool has_outside);
  void readTexcoords(const Surface& surface);
  void shade(const Vec2& moved, ShadingNormal& felt) const;
  void bump(const Vec2& moved, ShadingNormal& felt) const;

  SurfacePoint place_;
  bool triangle_, smooth_, textured_;
  SurfaceValue height_;  // m; without a texture: no bump map
  // The members below are set only if they are needed. Edges 0 and 1 are e1 and e2.
  std::array<Vec3, 2> slope_{Vec3::Zero(), Vec3::Zero()};  // 1/m, g_1 and g_2
  Vec3 normal_sum_;                                        // weighted sum of the vertex normals at the point
  std::array<Vec3, 2> normal_edge_;                        // change of the sum along each edge
  Vec2 texcoord_;                                          // at the point
  std::array<Vec2, 2> texcoord_edge_;
};

}  // namespace hl
