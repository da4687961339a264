// Patch: the surface around a contact, read once for all the passes of a sub-goal. In the plane of a triangle with
// edges e1, e2 from vertex 0 the weights are linear in the place, and with them the texture coordinates and the sum of
// the vertex normals:
//   w_i(x + d) = w_i(x) + g_i . d,   c = e1 x e2,   g_1 = e2 x c / |c|^2,   g_2 = c x e1 / |c|^2,   g_0 = -g_1 - g_2.
// World frame.
#pragma once

#include "base/vec.h"
#include "proxy/surface.h"

namespace hl {

/// The normal that is felt: turned away from the true one by force shading and by a bump map, and how far each turns
/// it: 1 - cos of the angle.
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

  /// What a step (m) in the plane of the triangle changes in the weights of its vertices 1 and 2.
  Vec2 weightsOver(const Vec3& step) const { return {slope_[0].dot(step), slope_[1].dot(step)}; }

  // From here on `moved` is what the weights have changed since the place that the patch was made for.

  /// Whether the contact, made on the face of a triangle, is still there.
  bool covers(const Vec2& moved) const;
  /// Whether the patch still says what the surface is: on the face, and always where the surface is the same
  /// everywhere.
  bool holds(const Vec2& moved) const { return (!smooth_ && !textured_) || covers(moved); }
  /// As if the plane of the triangle had no edges.
  SurfacePoint place(const Vec2& moved) const;
  /// Of a textured triangle only; without an edge too.
  Vec2 texcoord(const Vec2& moved) const { return texcoord_ + texcoordOver(moved); }
  Vec2 texcoordOver(const Vec2& moved) const { return moved.x() * texcoord_edge_[0] + moved.y() * texcoord_edge_[1]; }

  /// Whether the surface may be shaded or bumped; when false, shadingNormal() is the true normal everywhere.
  bool shaded() const { return smooth_ || height_.texture; }
  /// The normal as it feels: the vertex normals interpolated, no farther from the true normal than
  /// accuracy::kShadingLimit_rad, and the slope of the bump map. A triangle with a vertex normal that is missing, zero
  /// or points to the other side has its true normal everywhere.
  ShadingNormal shadingNormal(const Vec2& moved = Vec2::Zero()) const;

 private:
  void readPlane(const SceneAt& scene, const Surface& surface);
  void readNormals(const std::array<Vec3, 3>& normal);
  void readTexcoords(const Surface& surface);
  void shade(const Vec2& moved, ShadingNormal& felt) const;
  void bump(const Vec2& moved, ShadingNormal& felt) const;

  SurfacePoint place_;
  bool triangle_, smooth_, textured_;
  SurfaceValue height_;  // m; without a texture there is no bump map
  // What follows is read only where it is needed; edge 0 and 1 are e1 and e2.
  std::array<Vec3, 2> slope_{Vec3::Zero(), Vec3::Zero()};  // 1/m, g_1 and g_2
  Vec3 normal_sum_;                                        // of the vertex normals, at the place
  std::array<Vec3, 2> normal_edge_;                        // its change along an edge
  Vec2 texcoord_;                                          // at the place
  std::array<Vec2, 2> texcoord_edge_;
};

}  // namespace hl
