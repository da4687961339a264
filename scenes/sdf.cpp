#include "sdf.h"

#include <memory>
#include <utility>
#include <vector>

#include "base/error.h"
#include "surfaces/implicit/implicit_surface.h"

namespace hl {

namespace {

Expression bodyOf(ExpressionKind kind, double radius, double length = 0, const Vec3& place = Vec3::Zero()) {
  Expression body;
  body.kind = kind;
  body.radius = radius;
  body.length = length;
  body.place = place;
  return body;
}

Expression boxOf(const Vec3& size, double radius, const Vec3& place) {
  Expression box = bodyOf(ExpressionKind::kBox, radius, 0, place);
  box.size = size;
  return box;
}

Expression torusOf(double ring, double tube) {
  Expression torus = bodyOf(ExpressionKind::kTorus, tube);
  torus.ring = ring;
  torus.axis = Vec3::UnitX();
  torus.degrees = 90;
  return torus;
}

Expression together(ExpressionKind kind, std::vector<Expression> parts, double smooth = 0) {
  Expression whole;
  whole.kind = kind;
  whole.parts = std::move(parts);
  whole.smooth = smooth;
  return whole;
}

Expression gyroidBall() {
  Expression gyroid;
  gyroid.kind = ExpressionKind::kGyroid;
  gyroid.period = 0.03;
  gyroid.thickness = 0.002;
  return together(ExpressionKind::kIntersection, {bodyOf(ExpressionKind::kSphere, 0.035), gyroid});
}

Expression blend() {
  return together(ExpressionKind::kUnion,
                  {torusOf(0.028, 0.008), bodyOf(ExpressionKind::kSphere, 0.014, 0, Vec3(0, 0.012, 0)),
                   bodyOf(ExpressionKind::kCapsule, 0.007, 0.05)},
                  0.012);
}

Expression twoSpheres() {
  constexpr double kRadius = 0.02, kHalfGap = 0.05e-3;
  return together(ExpressionKind::kUnion,
                  {bodyOf(ExpressionKind::kSphere, kRadius, 0, Vec3(-kRadius - kHalfGap, 0, 0)),
                   bodyOf(ExpressionKind::kSphere, kRadius, 0, Vec3(kRadius + kHalfGap, 0, 0))});
}

Expression bracket() {
  const Vec3 hole(0.025, 0, 0);
  Expression left = bodyOf(ExpressionKind::kCylinder, 0.006, 0.02, -hole),
             right = bodyOf(ExpressionKind::kCylinder, 0.006, 0.02, hole);
  for (Expression* one : {&left, &right}) {
    one->axis = Vec3::UnitX();
    one->degrees = 90;
  }
  const Expression plate = boxOf(Vec3(0.08, 0.008, 0.03), 0, Vec3::Zero()),
                   rib = boxOf(Vec3(0.012, 0.03, 0.03), 0, Vec3(0, 0.015, 0));
  return together(ExpressionKind::kDifference, {together(ExpressionKind::kUnion, {plate, rib}), left, right});
}

}  // namespace

SceneModel makeSdf(const std::string& spec) {
  ImplicitSpec surface;
  if (spec == "sdf:torus" || spec == "sdf") {
    surface.expression = torusOf(0.03, 0.01);
  } else if (spec == "sdf:gyroid") {
    surface.expression = gyroidBall();
  } else if (spec == "sdf:blend") {
    surface.expression = blend();
  } else if (spec == "sdf:spheres") {
    surface.expression = twoSpheres();
  } else if (spec == "sdf:bracket") {
    surface.expression = bracket();
  } else {
    throw Error("'" + spec + "': there are " + kSdfNames);
  }
  SceneModel scene;
  scene.model.name = spec;
  scene.surfaces.push_back({spec, std::make_shared<const ImplicitSurface>(surface)});
  return scene;
}

}  // namespace hl
