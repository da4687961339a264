#include "proxy/surface.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// cos and sin of kShadingLimit_rad.
constexpr double kLimitCos = 0.8660254037844386;
constexpr double kLimitSin = 0.5;

// Half the squared distance of two unit vectors: 1 - cos of the angle between them, without its cancellation.
double bendBetween(const Vec3& a, const Vec3& b) { return 0.5 * (a - b).squaredNorm(); }

// The vector a e1 + b e2 in a triangle's plane, e1 and e2 its edges from vertex 0, that has the given products with e1
// and e2: the normal equations.
struct InPlane {
  double a, b;
  Vec3 vector;
};

InPlane fromProducts(const Vec3& e1, const Vec3& e2, double with_e1, double with_e2) {
  const double g11 = e1.squaredNorm(), g12 = e1.dot(e2), g22 = e2.squaredNorm();
  const double det = g11 * g22 - g12 * g12;
  const double a = (g22 * with_e1 - g12 * with_e2) / det;
  const double b = (g11 * with_e2 - g12 * with_e1) / det;
  return {a, b, a * e1 + b * e2};
}

}  // namespace

const Vec3& SurfaceReader::vertexNormal(PrimitiveId id, std::size_t sorted) const {
  const Model& model = shape(id).model;
  const Primitive& primitive = scene_.primitive(id);
  return model.normals[model.triangles[primitive.source][primitive.order[sorted]]];
}

const Vec2& SurfaceReader::vertexTexcoord(PrimitiveId id, std::size_t sorted) const {
  const Model& model = shape(id).model;
  const Primitive& primitive = scene_.primitive(id);
  return model.texcoords[model.triangles[primitive.source][primitive.order[sorted]]];
}

Vec2 SurfaceReader::texcoord(const SurfacePlace& place) const {
  Vec2 uv = Vec2::Zero();
  for (std::size_t i = 0; i < 3; ++i) uv += place.weights[i] * vertexTexcoord(place.primitive, i);
  return uv;
}

void SurfaceReader::shade(const SurfacePlace& place, BentNormal& bent) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& normal = vertexNormal(place.primitive, i);
    if (!(normal.dot(place.normal) > 0)) return;
    sum += place.weights[i] * normal;
  }
  const Vec3 shaded = sum.normalized();
  if (!(shaded.dot(place.normal) > 0)) return;
  bent.shading = std::min(bendBetween(place.normal, shaded), 1 - kLimitCos);
  bent.normal = shaded;
  const double cosine = shaded.dot(place.normal);
  if (cosine < kLimitCos)
    bent.normal = kLimitCos * place.normal + kLimitSin * (shaded - cosine * place.normal).normalized();
}

// The surface of height h over the plane has the normal N - grad h, grad h in metres per metre along the triangle.
void SurfaceReader::bump(const SurfacePlace& place, BentNormal& bent) const {
  const TextureUse& use = material(place.primitive).textureOf(Quantity::kHeight);
  const Primitive& triangle = scene_.primitive(place.primitive);
  const Vec2 slope = (use.high - use.low) * textureOf(place.primitive, Quantity::kHeight).gradient(texcoord(place));
  // The change of height along an edge is its product with the gradient.
  const Vec2& origin = vertexTexcoord(place.primitive, 0);
  const Vec3 gradient = fromProducts(triangle.vertex[1] - triangle.vertex[0], triangle.vertex[2] - triangle.vertex[0],
                                     slope.dot(vertexTexcoord(place.primitive, 1) - origin),
                                     slope.dot(vertexTexcoord(place.primitive, 2) - origin))
                            .vector;
  const Vec3 normal = (bent.normal - (gradient - gradient.dot(bent.normal) * bent.normal)).normalized();
  if (!(normal.dot(place.normal) > 0)) return;
  bent.bump = bendBetween(bent.normal, normal);
  bent.normal = normal;
}

BentNormal SurfaceReader::bend(const SurfacePlace& place) const {
  const BentNormal flat{place.normal, 0, 0};
  if (scene_.primitive(place.primitive).kind != PrimitiveKind::kTriangle) return flat;
  SurfacePlace own = place;
  own.normal = scene_.turnToObject(place.primitive, place.normal);
  BentNormal bent{own.normal, 0, 0};
  if (smooth(place.primitive)) shade(own, bent);
  if (textured(place.primitive, Quantity::kHeight)) bump(own, bent);
  if (!bent.bent()) return flat;
  bent.normal = scene_.turnToWorld(place.primitive, bent.normal);
  return bent;
}

bool SurfaceReader::textured(PrimitiveId primitive, Quantity quantity) const {
  return set_.textures && !overridden(quantity) && material(primitive).textureOf(quantity).used() &&
         scene_.primitive(primitive).kind == PrimitiveKind::kTriangle && !shape(primitive).model.texcoords.empty();
}

bool SurfaceReader::dragTextured(PrimitiveId primitive) const {
  return textured(primitive, Quantity::kStaticFriction) || textured(primitive, Quantity::kDynamicFriction) ||
         textured(primitive, Quantity::kViscosity);
}

const std::optional<double>& SurfaceReader::overridden(Quantity quantity) const {
  static constexpr std::optional<double> kNever;
  switch (quantity) {
    case Quantity::kStiffness:
      return set_.stiffness;
    case Quantity::kStaticFriction:
      return set_.static_friction;
    case Quantity::kDynamicFriction:
      return set_.dynamic_friction;
    case Quantity::kViscosity:
      return set_.viscosity_Ns_m;
    case Quantity::kHeight:
      break;
  }
  return kNever;
}

SurfaceValue SurfaceReader::read(Quantity quantity, PrimitiveId primitive) const {
  if (const auto& set = overridden(quantity)) return {*set};
  const Material& m = material(primitive);
  if (textured(primitive, quantity)) {
    const TextureUse& use = m.textureOf(quantity);
    return {use.low, use.high - use.low, &textureOf(primitive, quantity)};
  }
  switch (quantity) {
    case Quantity::kStiffness:
      return {m.stiffness};
    case Quantity::kStaticFriction:
      return {m.static_friction};
    case Quantity::kDynamicFriction:
      return {m.dynamic_friction};
    case Quantity::kViscosity:
      return {m.viscosity_Ns_m};
    case Quantity::kHeight:
      break;
  }
  return {};
}

SurfacePlace SurfaceReader::moved(const SurfacePlace& place, const Vec3& step) const {
  const Primitive& triangle = scene_.primitive(place.primitive);
  const Vec3 e1 = triangle.vertex[1] - triangle.vertex[0], e2 = triangle.vertex[2] - triangle.vertex[0];
  const Vec3 step_O = scene_.turnToObject(place.primitive, step);
  const InPlane way = fromProducts(e1, e2, e1.dot(step_O), e2.dot(step_O));
  SurfacePlace result = place;
  result.weights[0] -= way.a + way.b;
  result.weights[1] += way.a;
  result.weights[2] += way.b;
  return result;
}

}  // namespace hl
