#include "io/snap_messages.h"

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/utf8.h"
#include "geometry/primitive.h"
#include "io/value_messages.h"

namespace hl {

namespace {

constexpr const char* kSnap = "a snap";
constexpr const char* kField = "a field";
constexpr double kMinSaved = 1e-30, kMaxSaved = 1e30;
constexpr double kUnitVector = 1e-6;  // of a vector that was made a unit

// What a SnapSpec is made of, without its name and points.
struct SnapParts {
  bool plane = false;
  Vec3 normal = Vec3::Zero();
  double capture_m = 0, release_N = 0;
};

// The same of a FieldSpec.
struct FieldParts {
  FieldKind kind{};
  bool plane = false;
  Vec3 normal = Vec3::Zero();
  double reach_m = 0, force_N = 0, stiffness_N_m = 0, damping_Ns_m = 0;
  Vec3 direction = Vec3::Zero();
};

// Of a place: its points, and the normal if it is a plane.
template <typename Message>
std::vector<Vec3> pointsOf(const Message& in, const char* what, const std::optional<Vec3>& normal) {
  const auto count = static_cast<std::size_t>(in.points_size()) / 3;
  checkRanges(
      what, {{"its number of points", static_cast<double>(count), 1, normal ? 1.0 : static_cast<double>(kMaxCorners)}});
  if (in.points_size() % 3 != 0) throw Error(std::string(what) + " makes no sense: its points have three numbers each");
  if (normal) checkRanges(what, {{"its normal's length", normal->norm(), 1 - kUnitVector, 1 + kUnitVector}});
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(at(in.points(), static_cast<int>(i)));
    if (!withinReach(points.back())) throw Error(std::string(what) + " makes no sense: a point is out of reach");
  }
  return points;
}

template <typename Parts>
std::optional<Vec3> normalOf(const Parts& parts) {
  return parts.plane ? std::optional<Vec3>(parts.normal) : std::nullopt;
}

}  // namespace

void toProto(const SnapSpec& snap, proto::RecordedSnap& out) {
  out.set_name(validUtf8(snap.name));
  for (const Vec3& point : snap.points) add(*out.mutable_points(), point);
  const Vec3 normal = snap.normal.value_or(Vec3::Zero());
  toProto(valuesOf(SnapParts{snap.normal.has_value(), normal, snap.capture_m, snap.release_N}), *out.mutable_values());
}

SnapSpec snapOf(const proto::RecordedSnap& in) {
  SnapParts parts;
  readValues(in.values(), kSnap, parts);
  checkRanges(kSnap, {{"capture_m", parts.capture_m, kMinSaved, kMaxSaved},
                      {"release_N", parts.release_N, kMinSaved, kMaxSaved}});
  const std::optional<Vec3> normal = normalOf(parts);
  return {in.name(), pointsOf(in, kSnap, normal), normal, parts.capture_m, parts.release_N};
}

void toProto(const FieldSpec& field, proto::RecordedField& out) {
  out.set_name(validUtf8(field.name));
  for (const Vec3& point : field.points) add(*out.mutable_points(), point);
  const Vec3 normal = field.normal.value_or(Vec3::Zero());
  const FieldParts parts{field.kind,          field.normal.has_value(), normal,         field.reach_m, field.force_N,
                         field.stiffness_N_m, field.damping_Ns_m,       field.direction};
  toProto(valuesOf(parts), *out.mutable_values());
}

FieldSpec fieldOf(const proto::RecordedField& in) {
  FieldParts parts;
  readValues(in.values(), kField, parts);
  const bool constant = parts.kind == FieldKind::kConstant;
  const double length = parts.direction.norm();
  checkRanges(kField, {{"reach_m", parts.reach_m, kMinSaved, kMaxSaved},
                       {"force_N", parts.force_N, 0, kMaxSaved},
                       {"stiffness_N_m", parts.stiffness_N_m, 0, kMaxSaved},
                       {"damping_Ns_m", parts.damping_Ns_m, 0, kMaxSaved},
                       {"its direction's length", length, constant ? 1 - kUnitVector : 0, 1 + kUnitVector}});
  const std::optional<Vec3> normal = normalOf(parts);
  return {in.name(),     parts.kind,          pointsOf(in, kField, normal), normal,         parts.reach_m,
          parts.force_N, parts.stiffness_N_m, parts.damping_Ns_m,           parts.direction};
}

}  // namespace hl
