// Expressions for tests.
#pragma once

#include <cmath>
#include <utility>

#include "geometry/scenes.h"
#include "surfaces/implicit/implicit_surface.h"

namespace hl::test {

inline Expression sphere(double radius, const Vec3& place = Vec3::Zero()) {
  Expression result;
  result.kind = ExpressionKind::kSphere;
  result.radius = radius;
  result.place = place;
  return result;
}

inline Expression box(const Vec3& size, double radius = 0) {
  Expression result;
  result.kind = ExpressionKind::kBox;
  result.size = size;
  result.radius = radius;
  return result;
}

inline Expression rod(ExpressionKind kind, double radius, double length) {
  Expression result;
  result.kind = kind;
  result.radius = radius;
  result.length = length;
  return result;
}

inline Expression torus(double ring, double tube) {
  Expression result;
  result.kind = ExpressionKind::kTorus;
  result.ring = ring;
  result.radius = tube;
  return result;
}

inline Expression gyroid(double period, double thickness) {
  Expression result;
  result.kind = ExpressionKind::kGyroid;
  result.period = period;
  result.thickness = thickness;
  return result;
}

inline Expression halfSpace(const Vec3& normal, double distance = 0) {
  Expression result;
  result.kind = ExpressionKind::kHalfSpace;
  result.normal = normal;
  result.distance = distance;
  return result;
}

inline Expression of(ExpressionKind kind, std::vector<Expression> parts, double smooth = 0) {
  Expression result;
  result.kind = kind;
  result.parts = std::move(parts);
  result.smooth = smooth;
  return result;
}

inline Expression changed(ExpressionKind kind, Expression part, double by) {
  Expression result = of(kind, {std::move(part)});
  (kind == ExpressionKind::kShell ? result.thickness : result.distance) = by;
  return result;
}

inline Expression turned(Expression of, Random& random) {
  of.axis = random.direction();
  of.degrees = random.uniform(0, 360);
  return of;
}

inline Box cube(double half) { return {Vec3::Constant(-half), Vec3::Constant(half)}; }

inline std::shared_ptr<const ImplicitSurface> surfaceOf(Expression expression, double error_m = 1e-6,
                                                        std::optional<Box> bounds = {}) {
  return std::make_shared<const ImplicitSurface>(ImplicitSpec{std::move(expression), bounds, error_m});
}

/// A body of random kind and size, about 10 mm.
inline Expression randomBody(Random& random) {
  Expression body;
  const double size = random.uniform(0.004, 0.01);
  switch (random.below(7)) {
    case 0:
      body = sphere(size);
      break;
    case 1:
      body = box(2 * size * Vec3(1, random.uniform(0.5, 1), random.uniform(0.5, 1)));
      break;
    case 2:
      body = box(2 * size * Vec3(1, random.uniform(0.5, 1), random.uniform(0.5, 1)), 0.3 * size);
      break;
    case 3:
      body = rod(ExpressionKind::kCylinder, size, random.uniform(1, 3) * size);
      break;
    case 4:
      body = rod(ExpressionKind::kCapsule, 0.6 * size, random.uniform(0, 2) * size);
      break;
    case 5:
      body = torus(size, 0.4 * size);
      break;
    default:
      body = of(ExpressionKind::kIntersection, {sphere(size), gyroid(1.5 * size, random.below(2) * 0.2 * size)});
  }
  body = turned(std::move(body), random);
  body.place = random.inCube(0.006);
  return body;
}

/// Two or three bodies together, with or without blends.
inline Expression randomSolid(Random& random) {
  const ExpressionKind kinds[] = {ExpressionKind::kUnion, ExpressionKind::kIntersection, ExpressionKind::kDifference};
  Expression solid = randomBody(random);
  for (int i = random.below(3); i > 0; --i) {
    const double smooth = random.below(4) == 0 ? random.uniform(0.002, 0.004) : 0;
    Expression other = randomBody(random);
    const bool small = smooth == 0 || (solid.parts.empty() && other.parts.empty() && other.kind != solid.kind);
    solid = of(kinds[random.below(3)], {std::move(solid), std::move(other)}, small ? smooth : 0);
  }
  if (random.below(3) == 0) solid = turned(std::move(solid), random);
  return solid;
}

}  // namespace hl::test
