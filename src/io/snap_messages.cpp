#include "io/snap_messages.h"

#include "base/error.h"
#include "geometry/primitive.h"
#include "io/value_messages.h"

namespace hl {

namespace {

constexpr const char* kSnap = "a snap";

// What a SnapSpec is made of, without its name and points.
struct SnapParts {
  bool plane = false;
  Vec3 normal = Vec3::Zero();
  double capture_m = 0, release_N = 0;
};

void checkParts(const SnapParts& parts, std::size_t points) {
  constexpr double kLeast = 1e-30, kMost = 1e30, kUnit = 1e-6;
  checkRanges(kSnap, {{"its number of points", static_cast<double>(points), 1, static_cast<double>(kMostCorners)},
                      {"capture_m", parts.capture_m, kLeast, kMost},
                      {"release_N", parts.release_N, kLeast, kMost}});
  if (!parts.plane) return;
  checkRanges(kSnap, {{"its normal's length", parts.normal.norm(), 1 - kUnit, 1 + kUnit},
                      {"its number of points", static_cast<double>(points), 1, 1}});
}

}  // namespace

void toProto(const SnapSpec& snap, proto::RecordedSnap& out) {
  out.set_name(snap.name);
  for (const Vec3& point : snap.points) add(*out.mutable_points(), point);
  toProto(
      valuesOf(SnapParts{snap.normal.has_value(), snap.normal.value_or(Vec3::Zero()), snap.capture_m, snap.release_N}),
      *out.mutable_values());
}

SnapSpec snapOf(const proto::RecordedSnap& in) {
  SnapParts parts;
  readValues(in.values(), kSnap, parts);
  const auto count = static_cast<std::size_t>(in.points_size()) / 3;
  checkParts(parts, count);
  SnapSpec snap{in.name(), {}, {}, parts.capture_m, parts.release_N};
  if (parts.plane) snap.normal = parts.normal;
  if (in.points_size() % 3 != 0) throw Error("a snap makes no sense: its points have three numbers each");
  for (std::size_t i = 0; i < count; ++i) {
    snap.points.push_back(at(in.points(), static_cast<int>(i)));
    if (!withinReach(snap.points.back())) throw Error("a snap makes no sense: a point is out of reach");
  }
  return snap;
}

}  // namespace hl
