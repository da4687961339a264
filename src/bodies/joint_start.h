// Joint start: the joint that a file or client describes, where its bodies start.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "bodies/joint.h"

namespace hl {

/// Where a body that moves starts; empty: the body does not move, or no body has this key.
using StartOfBody = std::function<std::optional<Pose>(std::uint64_t key)>;

/// The joint of two bodies that start there; `start_b` is the identity for the world.
Joint jointOf(const JointSpec& spec, const Pose& start_a, const Pose& start_b);

/// As it is stepped: a joint to what does not move is one to the world. Empty: it joins nothing that moves. It may have
/// a fault (joint_check.h).
std::optional<Joint> steppedJoint(JointSpec spec, const StartOfBody& start);

/// Why its world would not be stepped, in one line; empty: nothing is wrong. Keys that are 0 are no fault.
std::string startFault(JointSpec spec, const StartOfBody& start);
/// What its author can hardly have meant, in one line; empty: nothing.
std::string startWarning(const JointSpec& spec, const StartOfBody& start);

}  // namespace hl
