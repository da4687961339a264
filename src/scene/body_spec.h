// Body spec: how an object of the scene moves as a rigid body, as its file or client says it. What the step of the
// bodies makes of it is in src/bodies.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/vec.h"

namespace hl {

/// How a surface meets another body. Of two that touch, the geometric mean of each counts.
struct BodySurface {
  double static_friction = 0.5;   ///< >= dynamic_friction
  double dynamic_friction = 0.5;  ///< >= 0
  double restitution = 0;         ///< 0..1
  bool operator==(const BodySurface&) const = default;
};

/// The shape by which a body meets other bodies and the scene; the hand always feels the mesh. Each is made from the
/// mesh in its object frame.
enum class BodyShape : std::uint8_t {
  kHull,      ///< the convex hull of the vertices
  kBox,       ///< the bounds
  kBall,      ///< centred in the bounds; its diameter is their largest side
  kCapsule,   ///< along the longest side of the bounds; its diameter is the larger of the other two
  kCylinder,  ///< flat ends; along the side of the bounds whose two others are equal to 1 %, as of a disc; else the
              ///< longest
  kParts,     ///< the convex hull of each piece of the mesh (bodies/mesh_pieces.h), all of them as one
};
/// By number: "hull", "box", ...
inline constexpr std::array<const char*, 6> kBodyShapeNames{"hull", "box", "ball", "capsule", "cylinder", "parts"};

/// No scene has more that move, each counted by its parts: what a step costs is bounded.
inline constexpr std::size_t kMaxBodies = 1000;

/// What a file or a client may say of bodies and do to them.
namespace body_limits {
inline constexpr double kMinMass_kg = 1e-9, kMaxMass_kg = 1e9;
inline constexpr double kMinDensity_kg_m3 = 1e-6, kMaxDensity_kg_m3 = 1e6;
inline constexpr double kMaxFriction = 1e3;
inline constexpr double kMaxImpulse_N_s = 1e6, kMaxPush_s = 10;
/// Each coordinate.
inline constexpr double kMaxSpeed_m_s = 100, kMaxSpin_rad_s = 1000, kMaxGravity_m_s2 = 1000;
}  // namespace body_limits

struct BodySpec {
  bool fixed = false;             ///< it does not move, and only its surface counts
  std::optional<double> mass_kg;  ///< > 0; absent: of the volume of its shape and the density
  double density_kg_m3 = 1000;    ///< > 0
  BodyShape shape = BodyShape::kHull;
  BodySurface surface{};
  Vec3 velocity_m_s = Vec3::Zero();  ///< at the begin, world frame
  Vec3 spin_rad_s = Vec3::Zero();    ///< at the begin, world frame
  bool operator==(const BodySpec&) const = default;
};

}  // namespace hl
