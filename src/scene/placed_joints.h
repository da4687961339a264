// Placed joints: the joints of a client's world, from the calls that they name to the bodies that these place.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/placed_shape.h"

namespace hl {

/// A body, as the world calls it.
struct CalledBody {
  std::uint32_t object = 0;
  std::optional<std::uint32_t> name;  ///< of the call; absent: the object is called once
};

/// A joint as a client says it. `spec` has its id, and neither bodies nor key.
struct CalledJoint {
  JointSpec spec;
  CalledBody a;
  std::optional<CalledBody> b;  ///< absent: the world
};

/// Its memory in the list of its client.
std::size_t bytesOf(const CalledJoint& joint);
/// Memory of a joint in the world beside its force table: in the worlds of three scenes, what the solve of a step keeps
/// of it.
inline constexpr std::size_t kJoint_bytes = 30'000;
std::size_t bytesOfJoint(const JointSpec& joint);

/// Of `session`. One that was in `before` between the same bodies is reported at the same place (JointSpec::shown).
/// Throws hl::Error, one line with the joint's id, for a body that is not placed, or not clear. Allocates.
std::vector<JointSpec> placedJoints(const std::vector<CalledJoint>& joints, std::span<const PlacedShape> placed,
                                    std::uint32_t session, const std::vector<JointSpec>& before);

}  // namespace hl
