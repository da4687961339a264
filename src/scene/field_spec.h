// Field spec: a force on the hand from a place of an object (proxy/field_forces.h), as a file or client says it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/model.h"
#include "scene/snap_spec.h"

namespace hl {

/// No scene has more that count, and none has more corners together, as of snaps.
inline constexpr std::size_t kMaxFields = 64;

enum class FieldKind : std::uint8_t {
  kMagnet,    ///< pulls to the place: 0 on it and at its reach, most at a third of it
  kSpring,    ///< pulls to the place with stiffness times distance, at most with its force
  kConstant,  ///< pushes in one direction, less and less toward its reach
  kDrag,      ///< brakes the hand
};
/// By number: "magnet", "spring", ...
inline constexpr std::array<const char*, 4> kFieldKindNames{"magnet", "spring", "constant", "drag"};

/// Frame of the object. What a kind does not need is 0.
struct FieldSpec {
  std::string name;
  FieldKind kind = FieldKind::kMagnet;
  std::vector<Vec3> points;       ///< m, at least one, as SnapSpec::points
  std::optional<Vec3> normal;     ///< as SnapSpec::normal
  double reach_m = 0;             ///< > 0, m of the world: farther away there is no force
  double force_N = 0;             ///< the greatest, at the hand; not of a drag
  double stiffness_N_m = 0;       ///< of a spring: N at the hand for a metre of the world
  double damping_Ns_m = 0;        ///< of a drag, at the hand
  Vec3 direction = Vec3::Zero();  ///< unit, of a constant force
  bool operator==(const FieldSpec&) const = default;
};
using FieldList = std::vector<FieldSpec>;

/// N, along the way to the place, at the distance `distance_m` from it; 0 of a constant force or a drag. RT-safe.
double pullOf_N(const FieldSpec& field, double distance_m);
/// N of a constant force at that distance; 0 of the others. RT-safe.
double pushOf_N(const FieldSpec& field, double distance_m);

/// The fields in another frame, of which `placement` makes it. Reach, forces and stiffness stay as they are. Allocates.
FieldList placed(const FieldList& fields, const Placement& placement);
std::size_t pointsIn(const FieldList& fields);
/// Memory that they take.
std::size_t bytesOf(const FieldList& fields);

}  // namespace hl
