#include "proxy/patch.h"

#include <algorithm>

#include "proxy/tolerances.h"

namespace hl {

namespace {

// Half the squared distance of two unit vectors. This is 1 - cos of their angle, without the cancellation.
double angleMeasure(const Vec3& a, const Vec3& b) { return 0.5 * (a - b).squaredNorm(); }

}  // namespace

Patch::Patch(const SceneAt& scene, const Surface& surface, const SurfacePoint& place)
    : place_(place), triangle_(surface.isTriangle()), smooth_(surface.smooth()), textured_(surface.textured()) {
  if (triangle_) readPlane(scene, surface);
  if (!triangle_ && smooth_) readPointNormal(scene, surface);
  if (textured_) readTexcoords(surface);
}

void Patch::readPlane(const SceneAt& scene, const Surface& surface) {
  const Primitive& triangle = scene.primitive(place_.primitive);
  Vec3 e1 = triangle.vertex[1] - triangle.vertex[0], e2 = triangle.vertex[2] - triangle.vertex[0];
  std::array<Vec3, 3> normal;
  if (smooth_) normal = {surface.normal(triangle, 0), surface.normal(triangle, 1), surface.normal(triangle, 2)};
  const Instance& instance = scene.instance(place_.primitive);
  if (!instance.atWorld()) {
    const Mat3 turn = instance.poses().at(scene.time_ns()).rotation;
    e1 = turn * e1;
    e2 = turn * e2;
    if (smooth_) normal = {turn * normal[0], turn * normal[1], turn * normal[2]};
  }
  const Vec3 c = e1.cross(e2);
  const double scale = 1 / c.squaredNorm();
  slope_ = {scale * e2.cross(c), scale * c.cross(e1)};
  if (smooth_) readNormals(normal, surface.hasOutside());
}

void Patch::readPointNormal(const SceneAt& scene, const Surface& surface) {
  Vec3 normal = surface.normal(scene.primitive(place_.primitive), 0);
  const Instance& instance = scene.instance(place_.primitive);
  if (!instance.atWorld()) normal = instance.poses().at(scene.time_ns()).rotation * normal;
  readNormals({normal, normal, normal}, surface.hasOutside());
}

void Patch::readNormals(std::array<Vec3, 3> normal, bool has_outside) {
  if (!has_outside && (normal[0] + normal[1] + normal[2]).dot(place_.normal) < 0) {
    for (Vec3& n : normal) n = -n;
  }
  const auto usable = [&](const Vec3& n) { return n.dot(place_.normal) > 0; };
  smooth_ = usable(normal[0]) && usable(normal[1]) && usable(normal[2]);
  normal_sum_ = place_.weights[0] * normal[0] + place_.weights[1] * normal[1] + place_.weights[2] * normal[2];
  normal_edge_ = {normal[1] - normal[0], normal[2] - normal[0]};
}

void Patch::readTexcoords(const Surface& surface) {
  texcoord_ = surface.texcoord(place_.weights);
  texcoord_edge_ = {surface.texcoord(1) - surface.texcoord(0), surface.texcoord(2) - surface.texcoord(0)};
  if (surface.textured(Quantity::kHeight)) height_ = surface.read(Quantity::kHeight);
}

bool Patch::covers(const Vec2& moved) const {
  const auto& made = place_.weights;
  const bool on_face = triangle_ && made[0] > 0 && made[1] > 0 && made[2] > 0;
  return on_face && made[0] - moved.x() - moved.y() >= 0 && made[1] + moved.x() >= 0 && made[2] + moved.y() >= 0;
}

SurfacePoint Patch::place(const Vec2& moved) const {
  SurfacePoint place = place_;
  place.weights[0] -= moved.x() + moved.y();
  place.weights[1] += moved.x();
  place.weights[2] += moved.y();
  return place;
}

void Patch::shade(const Vec2& moved, ShadingNormal& felt) const {
  using namespace accuracy;
  const Vec3 sum = normal_sum_ + moved.x() * normal_edge_[0] + moved.y() * normal_edge_[1];
  const Vec3 shaded = sum.normalized();
  const double cosine = shaded.dot(place_.normal);
  if (!(cosine > 0)) return;
  felt.shading = std::min(angleMeasure(place_.normal, shaded), 1 - kShadingLimitCos);
  felt.normal = shaded;
  if (cosine < kShadingLimitCos)
    felt.normal = kShadingLimitCos * place_.normal + kShadingLimitSin * (shaded - cosine * place_.normal).normalized();
}

// A surface of height h above the plane has the normal N - grad h, with grad h in metres per metre along the triangle.
void Patch::bump(const Vec2& moved, ShadingNormal& felt) const {
  const Vec2 slope = height_.range * height_.texture->gradient(texcoord(moved));
  const Vec3 gradient = slope.dot(texcoord_edge_[0]) * slope_[0] + slope.dot(texcoord_edge_[1]) * slope_[1];
  const Vec3 normal = (felt.normal - (gradient - gradient.dot(felt.normal) * felt.normal)).normalized();
  if (!(normal.dot(place_.normal) > 0)) return;
  felt.bump = angleMeasure(felt.normal, normal);
  felt.normal = normal;
}

ShadingNormal Patch::shadingNormal(const Vec2& moved) const {
  ShadingNormal felt{place_.normal, 0, 0};
  if (smooth_) shade(moved, felt);
  if (height_.texture) bump(moved, felt);
  return felt;
}

}  // namespace hl
