#include "surfaces/implicit/implicit_function.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/direction.h"
#include "base/error.h"

namespace hl {

namespace {

using NodeKind = ImplicitFunction::Node::Kind;

/// A normal form while it is made: a smooth function, or the least or greatest of two.
struct Form {
  NodeKind kind = NodeKind::kSmooth;
  SmoothFunction smooth;
  std::vector<Form> parts;

  std::size_t sheets() const { return kind == NodeKind::kSmooth ? 1 : parts[0].sheets() + parts[1].sheets(); }
  std::size_t bodies() const {
    return kind == NodeKind::kSmooth ? smooth.bodies() : parts[0].bodies() + parts[1].bodies();
  }
};

Form formOf(const SmoothBody& body) { return {NodeKind::kSmooth, SmoothFunction(body), {}}; }

Form joined(NodeKind kind, Form a, Form b) {
  Form form{kind, {}, {}};
  form.parts.push_back(std::move(a));
  form.parts.push_back(std::move(b));
  if (form.sheets() > kMaxSheets)
    throw Error(
        "it has more than 64 smooth surfaces: a box counts as 6, a cylinder as 3, a blend as the product of "
        "those of its parts");
  return form;
}

Form negated(Form form) {
  form.smooth.negate();
  if (form.kind != NodeKind::kSmooth) form.kind = form.kind == NodeKind::kMin ? NodeKind::kGreatest : NodeKind::kMin;
  for (Form& part : form.parts) part = negated(std::move(part));
  return form;
}

Form shifted(Form form, double by) {
  form.smooth.shift(by);
  for (Form& part : form.parts) part = shifted(std::move(part), by);
  return form;
}

Form blended(const Form& a, const Form& b, double reach) {
  for (const bool first : {true, false}) {
    const Form& split = first ? a : b;
    if (split.kind == NodeKind::kSmooth) continue;
    const auto with = [&](const Form& part) { return first ? blended(part, b, reach) : blended(a, part, reach); };
    return joined(split.kind, with(split.parts[0]), with(split.parts[1]));
  }
  Form form{NodeKind::kSmooth, SmoothFunction(a.smooth, b.smooth, reach), {}};
  if (!form.smooth.fits()) throw Error("there are more than 12 blends in each other");
  return form;
}

/// Where the parts of an expression lie: p = scale turn local + place.
struct Frame {
  Mat3 turn = Mat3::Identity();
  double scale = 1;
  Vec3 place = Vec3::Zero();

  Frame within(const Expression& in) const {
    return {turn * turnOf(in), scale * in.scale, place + scale * (turn * in.place)};
  }
};

SmoothBody bodyIn(const Frame& frame, BodyKind kind, double radius, const Vec3& half = Vec3::Zero()) {
  SmoothBody body;
  body.kind = kind;
  body.axes = frame.turn.transpose() / frame.scale;
  body.offset = -(body.axes * frame.place);
  body.gain = frame.scale;
  body.radius = radius;
  body.half = half;
  return body;
}

// Of the half-space n . local < distance.
Form halfSpaceIn(const Frame& frame, const Vec3& normal, double distance) {
  Frame turned = frame;
  turned.turn = frame.turn * Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), normal).toRotationMatrix();
  SmoothBody body = bodyIn(turned, BodyKind::kHalfSpace, 0);
  body.axes.row(2) = (frame.turn * normal).transpose() / frame.scale;
  body.offset.z() = -body.axes.row(2).dot(frame.place);
  body.shift = -frame.scale * distance;
  return formOf(body);
}

Form boxIn(const Frame& frame, const Expression& in) {
  if (in.radius > 0)
    return formOf(bodyIn(frame, BodyKind::kRoundBox, in.radius, 0.5 * in.size - Vec3::Constant(in.radius)));
  Form form;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Form face = halfSpaceIn(frame, side * Vec3::Unit(axis), 0.5 * in.size[axis]);
      form = axis == 0 && side < 0 ? std::move(face) : joined(NodeKind::kGreatest, std::move(form), std::move(face));
    }
  }
  return form;
}

Form cylinderIn(const Frame& frame, const Expression& in) {
  Form ends = joined(NodeKind::kGreatest, halfSpaceIn(frame, Vec3::UnitZ(), 0.5 * in.length),
                     halfSpaceIn(frame, -Vec3::UnitZ(), 0.5 * in.length));
  return joined(NodeKind::kGreatest, formOf(bodyIn(frame, BodyKind::kRod, in.radius)), std::move(ends));
}

Form shellOf(const Form& of, double half) {
  return joined(NodeKind::kGreatest, shifted(of, -half), shifted(negated(of), -half));
}

// Its gradient is of length 1 where its surface is flat.
Form gyroidIn(const Frame& frame, const Expression& in) {
  const double wave = 2 * M_PI / in.period;
  SmoothBody body = bodyIn(frame, BodyKind::kGyroid, 0);
  body.axes *= wave;
  body.offset *= wave;
  body.gain /= wave * std::sqrt(3.0);
  const Form form = formOf(body);
  return in.thickness > 0 ? shellOf(form, 0.5 * frame.scale * in.thickness) : form;
}

Form formOf(const Expression& in, const Frame& before);

Form partsOf(const Expression& in, const Frame& frame) {
  const double reach = frame.scale * in.smooth;
  Form form = formOf(in.parts.front(), frame);
  for (std::size_t i = 1; i < in.parts.size(); ++i) {
    Form part = formOf(in.parts[i], frame);
    const bool least = in.kind == ExpressionKind::kUnion;
    if (in.kind == ExpressionKind::kDifference) part = negated(std::move(part));
    if (reach == 0) {
      form = joined(least ? NodeKind::kMin : NodeKind::kGreatest, std::move(form), std::move(part));
      continue;
    }
    if (form.sheets() * part.sheets() > kMaxSheets) throw Error("it blends more smooth surfaces than 64");
    form = least ? blended(form, part, reach)
                 : negated(blended(negated(std::move(form)), negated(std::move(part)), reach));
  }
  return form;
}

Form formOf(const Expression& in, const Frame& before) {
  const Frame frame = before.within(in);
  switch (in.kind) {
    case ExpressionKind::kSphere:
      return formOf(bodyIn(frame, BodyKind::kSphere, in.radius));
    case ExpressionKind::kBox:
      return boxIn(frame, in);
    case ExpressionKind::kCylinder:
      return cylinderIn(frame, in);
    case ExpressionKind::kCapsule:
      return formOf(bodyIn(frame, BodyKind::kCapsule, in.radius, Vec3(0, 0, 0.5 * in.length)));
    case ExpressionKind::kTorus: {
      SmoothBody body = bodyIn(frame, BodyKind::kTorus, in.radius);
      body.ring = in.ring;
      return formOf(body);
    }
    case ExpressionKind::kHalfSpace:
      return halfSpaceIn(frame, *unitOf(in.normal), in.distance);
    case ExpressionKind::kGyroid:
      return gyroidIn(frame, in);
    case ExpressionKind::kShell:
      return shellOf(formOf(in.parts.front(), frame), 0.5 * frame.scale * in.thickness);
    case ExpressionKind::kOffset:
      return shifted(formOf(in.parts.front(), frame), -frame.scale * in.distance);
    default:
      return partsOf(in, frame);
  }
}

std::uint16_t flatten(Form& form, std::vector<SmoothFunction>& sheets, std::vector<ImplicitFunction::Node>& nodes) {
  ImplicitFunction::Node node{form.kind, 0, 0};
  if (form.kind == NodeKind::kSmooth) {
    node.first = static_cast<std::uint16_t>(sheets.size());
    sheets.push_back(std::move(form.smooth));
  } else {
    node.first = flatten(form.parts[0], sheets, nodes);
    node.second = flatten(form.parts[1], sheets, nodes);
  }
  nodes.push_back(node);
  return static_cast<std::uint16_t>(nodes.size() - 1);
}

}  // namespace

ImplicitFunction::ImplicitFunction(const Expression& expression) {
  checkExpression(expression);
  Form form = formOf(expression, Frame());
  if (form.bodies() > kMaxBodiesOfSheets)
    throw Error("it has more than 256 bodies, counted once for each smooth surface");
  root_ = flatten(form, sheets_, nodes_);
  conditions_.resize(sheets_.size());
  std::vector<Condition> above;
  addConditions(root_, above);
}

// Where one of two is 0 it is their least if the other is not below 0, their greatest if it is not above.
void ImplicitFunction::addConditions(std::uint16_t number, std::vector<Condition>& above) {
  const Node& node = nodes_[number];
  if (node.kind == NodeKind::kSmooth) {
    conditions_[node.first] = above;
    return;
  }
  const double sign = node.kind == NodeKind::kMin ? 1 : -1;
  for (const auto& [one, other] : {std::pair(node.first, node.second), std::pair(node.second, node.first)}) {
    above.push_back({other, sign});
    addConditions(one, above);
    above.pop_back();
  }
}

double ImplicitFunction::at(std::size_t number, const Vec3& p) const {
  const Node& node = nodes_[number];
  if (node.kind == NodeKind::kSmooth) return sheets_[node.first].at(p);
  const double a = at(node.first, p), b = at(node.second, p);
  return node.kind == NodeKind::kMin ? std::min(a, b) : std::max(a, b);
}

std::size_t ImplicitFunction::bytes() const {
  std::size_t bytes = sizeof(*this) + nodes_.size() * sizeof(Node);
  for (const SmoothFunction& sheet : sheets_) bytes += sizeof(sheet) + 2 * sheet.bodies() * sizeof(SmoothBody);
  for (const auto& list : conditions_) bytes += sizeof(std::vector<Condition>) + list.size() * sizeof(Condition);
  return bytes;
}

}  // namespace hl
