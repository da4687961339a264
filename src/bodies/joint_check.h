// Joint check: what joints must hold to be stepped.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "bodies/joint.h"

namespace hl {

/// A force table has no more rows: the work of a step is bounded.
inline constexpr std::size_t kMaxTableRows = 256;

/// What is wrong with it, in one line without its number; empty: nothing. `is_body`: whether a body has this key.
std::string faultOfJoint(const Joint& joint, const std::function<bool(std::uint64_t key)>& is_body);
/// Throws Error with a line that says which joint, and what is wrong with it.
void checkJoint(const Joint& joint, const std::function<bool(std::uint64_t key)>& is_body);
/// All of a world; their keys increase.
void checkJoints(std::span<const Joint> joints, const std::function<bool(std::uint64_t key)>& is_body);

}  // namespace hl
