#include "surfaces/implicit/expression.h"

#include <cmath>
#include <string>

#include "base/direction.h"
#include "base/error.h"

namespace hl {

namespace {

constexpr double kShortest_m = 1e-9, kLongest_m = 1e6;

class ExpressionCheck {
 public:
  void check(const Expression& in, const std::string& before, std::size_t depth) {
    const std::string where = before + nameOf(in.kind);
    if (++nodes_ > kMaxNodes) throw Error(where + ": there are more than 1000 parts in it");
    if (depth > kMaxDepth) throw Error(where + ": there are more than 24 parts in each other");
    placement(in, where);
    sizes(in, where);
    parts(in, where);
    const bool one = in.parts.size() == 1;
    for (std::size_t i = 0; i < in.parts.size(); ++i)
      check(in.parts[i], where + (one ? ".of." : ".of[" + std::to_string(i) + "]."), depth + 1);
  }

 private:
  static void length(double value, const std::string& where, const char* name, bool may_be_0 = false) {
    if (may_be_0 && value == 0) return;
    if (!(value >= kShortest_m && value <= kLongest_m))
      throw Error(where + "." + name + " must be from 1e-9 to 1e6" + (may_be_0 ? ", or 0" : ""));
  }

  static void placement(const Expression& in, const std::string& where) {
    if (!in.place.allFinite() || in.place.cwiseAbs().maxCoeff() > kLongest_m)
      throw Error(where + ".translate must be within 1e6");
    if (!(in.scale >= 1e-6 && in.scale <= 1e6)) throw Error(where + ".scale must be from 1e-6 to 1e6");
    if (!std::isfinite(in.degrees)) throw Error(where + ".degrees must be a finite number");
    if (in.degrees != 0 && !unitOf(in.axis)) throw Error(where + ".axis must be a direction that is not 0");
  }

  static void sizes(const Expression& in, const std::string& where) {
    switch (in.kind) {
      case ExpressionKind::kSphere:
        return length(in.radius, where, "radius");
      case ExpressionKind::kBox:
        for (const double side : in.size) length(side, where, "size");
        length(in.radius, where, "radius", true);
        if (2 * in.radius > in.size.minCoeff())
          throw Error(where + ".radius must be at most half of its shortest side");
        return;
      case ExpressionKind::kCapsule:
      case ExpressionKind::kCylinder:
        length(in.radius, where, "radius");
        return length(in.length, where, "length", in.kind == ExpressionKind::kCapsule);
      case ExpressionKind::kTorus:
        length(in.radius, where, "tube");
        length(in.ring, where, "radius");
        if (in.radius >= in.ring) throw Error(where + ".tube must be less than its radius");
        return;
      case ExpressionKind::kHalfSpace:
        if (!unitOf(in.normal)) throw Error(where + ".normal must be a direction that is not 0");
        if (!(std::abs(in.distance) <= kLongest_m)) throw Error(where + ".distance must be within 1e6");
        return;
      case ExpressionKind::kGyroid:
        length(in.period, where, "period");
        return length(in.thickness, where, "thickness", true);
      case ExpressionKind::kUnion:
      case ExpressionKind::kIntersection:
      case ExpressionKind::kDifference:
        return length(in.smooth, where, "smooth", true);
      case ExpressionKind::kShell:
        return length(in.thickness, where, "thickness");
      case ExpressionKind::kOffset:
        return length(std::abs(in.distance), where, "distance");
    }
  }

  static void parts(const Expression& in, const std::string& where) {
    const bool whole = in.kind < ExpressionKind::kUnion, one = in.kind >= ExpressionKind::kShell;
    if (whole) return;
    if (one && in.parts.size() != 1) throw Error(where + ".of must be one expression");
    if (in.parts.empty()) throw Error(where + ".of must be a list of expressions");
  }

  std::size_t nodes_ = 0;
};

Box around(const Vec3& half) { return {-half, half}; }

Box grown(const Box& box, double by) { return {box.min - Vec3::Constant(by), box.max + Vec3::Constant(by)}; }

std::optional<Box> boundsOfParts(const Expression& in) {
  std::optional<Box> result;
  for (const Expression& part : in.parts) {
    const std::optional<Box> one = boundsOf(part);
    if (in.kind == ExpressionKind::kIntersection) {
      if (one && result) *result = {result->min.cwiseMax(one->min), result->max.cwiseMin(one->max)};
      if (!result) result = one;
      continue;
    }
    if (!one) return {};
    if (result) result->extend(*one);
    if (!result) result = one;
    if (in.kind != ExpressionKind::kUnion) break;
  }
  return result;
}

std::optional<Box> boundsWithoutPlacement(const Expression& in) {
  std::optional<Box> box;
  switch (in.kind) {
    case ExpressionKind::kSphere:
      return around(Vec3::Constant(in.radius));
    case ExpressionKind::kBox:
      return around(0.5 * in.size);
    case ExpressionKind::kCylinder:
      return around({in.radius, in.radius, 0.5 * in.length});
    case ExpressionKind::kCapsule:
      return around({in.radius, in.radius, 0.5 * in.length + in.radius});
    case ExpressionKind::kTorus:
      return around({in.ring + in.radius, in.ring + in.radius, in.radius});
    case ExpressionKind::kHalfSpace:
    case ExpressionKind::kGyroid:
      return {};
    default:
      break;
  }
  box = boundsOfParts(in);
  if (!box || box->empty()) return box;
  // Corners of turned boxes move farther than faces do.
  if (in.kind == ExpressionKind::kShell) box = grown(*box, in.thickness);
  if (in.kind == ExpressionKind::kOffset && in.distance > 0) box = grown(*box, 2 * in.distance);
  if (in.kind == ExpressionKind::kUnion && in.smooth > 0)
    box = grown(*box, in.smooth * static_cast<double>(in.parts.size()));
  return box;
}

}  // namespace

void checkExpression(const Expression& expression) { ExpressionCheck().check(expression, "", 1); }

Mat3 turnOf(const Expression& expression) {
  if (expression.degrees == 0) return Mat3::Identity();
  return Eigen::AngleAxisd(expression.degrees * M_PI / 180, *unitOf(expression.axis)).toRotationMatrix();
}

std::optional<Box> boundsOf(const Expression& expression) {
  const std::optional<Box> own = boundsWithoutPlacement(expression);
  if (!own || own->empty()) return own;
  const Mat3 turn = turnOf(expression);
  Box box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at((corner & 1) != 0 ? own->max.x() : own->min.x(), (corner & 2) != 0 ? own->max.y() : own->min.y(),
                  (corner & 4) != 0 ? own->max.z() : own->min.z());
    box.extend(expression.scale * (turn * at) + expression.place);
  }
  return box;
}

const char* nameOf(ExpressionKind kind) {
  constexpr const char* kNames[] = {"sphere", "box",   "cylinder",     "capsule",    "torus", "halfSpace",
                                    "gyroid", "union", "intersection", "difference", "shell", "offset"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace hl
