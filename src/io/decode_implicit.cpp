#include "io/decode_implicit.h"

#include <algorithm>

#include "base/error.h"
#include "io/vec_messages.h"

namespace hl {

namespace {

using What = proto::Expression::WhatCase;

Expression expressionOf(const proto::Expression& in, std::size_t depth);

void readParts(const proto::Expression::Parts& in, std::size_t depth, Expression& out) {
  out.smooth = in.smooth();
  for (const proto::Expression& part : in.of()) out.parts.push_back(expressionOf(part, depth + 1));
}

template <typename Message>
void readPart(const Message& in, std::size_t depth, Expression& out) {
  if (in.has_of()) out.parts.push_back(expressionOf(in.of(), depth + 1));
}

template <typename Message>
void readRod(const Message& in, Expression& out) {
  out.radius = in.radius();
  out.length = in.length();
}

void readWhat(const proto::Expression& in, std::size_t depth, Expression& out) {
  switch (in.what_case()) {
    case What::kSphere:
      out.radius = in.sphere().radius();
      return;
    case What::kBox:
      out.size = vecOf(in.box().size());
      out.radius = in.box().radius();
      return;
    case What::kCylinder:
      return readRod(in.cylinder(), out);
    case What::kCapsule:
      return readRod(in.capsule(), out);
    case What::kTorus:
      out.ring = in.torus().radius();
      out.radius = in.torus().tube();
      return;
    case What::kHalfSpace:
      out.normal = vecOf(in.half_space().normal());
      out.distance = in.half_space().distance();
      return;
    case What::kGyroid:
      out.period = in.gyroid().period();
      out.thickness = in.gyroid().thickness();
      return;
    case What::kUnion:
      return readParts(in.union_(), depth, out);
    case What::kIntersection:
      return readParts(in.intersection(), depth, out);
    case What::kDifference:
      return readParts(in.difference(), depth, out);
    case What::kShell:
      out.thickness = in.shell().thickness();
      return readPart(in.shell(), depth, out);
    case What::kOffset:
      out.distance = in.offset().distance();
      return readPart(in.offset(), depth, out);
    case What::WHAT_NOT_SET:
      break;
  }
  throw Error(
      "an expression needs a sphere, box, cylinder, capsule, torus, halfSpace, gyroid, union, intersection, "
      "difference, shell or offset");
}

// The cases of the message have the order of the kinds.
ExpressionKind kindOf(What what) {
  constexpr ExpressionKind kKinds[] = {
      ExpressionKind::kSphere,       ExpressionKind::kBox,        ExpressionKind::kCylinder, ExpressionKind::kCapsule,
      ExpressionKind::kTorus,        ExpressionKind::kHalfSpace,  ExpressionKind::kGyroid,   ExpressionKind::kUnion,
      ExpressionKind::kIntersection, ExpressionKind::kDifference, ExpressionKind::kShell,    ExpressionKind::kOffset};
  return kKinds[static_cast<std::size_t>(what) - 1];
}

Expression expressionOf(const proto::Expression& in, std::size_t depth) {
  if (depth > kMaxDepth) throw Error("there are more than 24 parts in each other");
  Expression out;
  readWhat(in, depth, out);
  out.kind = kindOf(in.what_case());
  out.place = vecOf(in.translate());
  out.axis = in.has_axis() ? vecOf(in.axis()) : Vec3(0, 0, 0);
  out.degrees = in.degrees();
  out.scale = in.scale() == 0 ? 1 : in.scale();
  return out;
}

void fill(const Expression& in, proto::Expression& out);

void writeParts(const Expression& in, proto::Expression::Parts& out) {
  out.set_smooth(in.smooth);
  for (const Expression& part : in.parts) fill(part, *out.add_of());
}

template <typename Message>
void writeRod(const Expression& in, Message& out) {
  out.set_radius(in.radius);
  out.set_length(in.length);
}

void writeWhat(const Expression& in, proto::Expression& out) {
  switch (in.kind) {
    case ExpressionKind::kSphere:
      return out.mutable_sphere()->set_radius(in.radius);
    case ExpressionKind::kBox:
      toProto(in.size, *out.mutable_box()->mutable_size());
      return out.mutable_box()->set_radius(in.radius);
    case ExpressionKind::kCylinder:
      return writeRod(in, *out.mutable_cylinder());
    case ExpressionKind::kCapsule:
      return writeRod(in, *out.mutable_capsule());
    case ExpressionKind::kTorus:
      out.mutable_torus()->set_radius(in.ring);
      return out.mutable_torus()->set_tube(in.radius);
    case ExpressionKind::kHalfSpace:
      toProto(in.normal, *out.mutable_half_space()->mutable_normal());
      return out.mutable_half_space()->set_distance(in.distance);
    case ExpressionKind::kGyroid:
      out.mutable_gyroid()->set_period(in.period);
      return out.mutable_gyroid()->set_thickness(in.thickness);
    case ExpressionKind::kUnion:
      return writeParts(in, *out.mutable_union_());
    case ExpressionKind::kIntersection:
      return writeParts(in, *out.mutable_intersection());
    case ExpressionKind::kDifference:
      return writeParts(in, *out.mutable_difference());
    case ExpressionKind::kShell:
      out.mutable_shell()->set_thickness(in.thickness);
      return fill(in.parts.front(), *out.mutable_shell()->mutable_of());
    case ExpressionKind::kOffset:
      out.mutable_offset()->set_distance(in.distance);
      return fill(in.parts.front(), *out.mutable_offset()->mutable_of());
  }
}

void fill(const Expression& in, proto::Expression& out) {
  writeWhat(in, out);
  toProto(in.place, *out.mutable_translate());
  toProto(in.axis, *out.mutable_axis());
  out.set_degrees(in.degrees);
  out.set_scale(in.scale);
}

}  // namespace

std::uint64_t bytesToMakeImplicit(const proto::Implicit& in) {
  constexpr std::uint64_t kFixed = 4096, kEachByte = 512;  // a body of a few bytes may be in 64 sheets
  return kFixed + kEachByte * in.ByteSizeLong();
}

std::shared_ptr<const ImplicitSurface> decodeImplicit(const proto::Implicit& in) {
  if (!in.has_expression()) throw Error("it needs an expression");
  ImplicitSpec spec;
  spec.expression = expressionOf(in.expression(), 1);
  if (in.has_bounds()) spec.bounds = Box{vecOf(in.bounds().min()), vecOf(in.bounds().max())};
  if (in.has_error()) spec.error_m = in.error();
  return std::make_shared<const ImplicitSurface>(spec);
}

void toProto(const ImplicitSurface& surface, proto::RecordedImplicit& out) {
  const ImplicitSpec& spec = surface.spec();
  fill(spec.expression, *out.mutable_surface()->mutable_expression());
  if (spec.bounds) {
    toProto(spec.bounds->min, *out.mutable_surface()->mutable_bounds()->mutable_min());
    toProto(spec.bounds->max, *out.mutable_surface()->mutable_bounds()->mutable_max());
  }
  out.mutable_surface()->set_error(spec.error_m);
  for (const double value : surface.frame().axes.reshaped()) out.add_axes(value);
  for (const double value : surface.frame().origin) out.add_origin(value);
}

std::shared_ptr<const PrimitiveSource> implicitOf(const proto::RecordedImplicit& in) {
  if (in.axes_size() != 9 || in.origin_size() != 3) throw Error("an implicit surface in it makes no sense");
  Mat3 axes;
  Vec3 origin;
  std::copy(in.axes().begin(), in.axes().end(), axes.data());
  std::copy(in.origin().begin(), in.origin().end(), origin.data());
  return decodeImplicit(in.surface())->placed(axes, origin);
}

}  // namespace hl
