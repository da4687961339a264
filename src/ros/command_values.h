// What is in a command for a hand, as the judges take it.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "ros/packets.h"

namespace hl {

inline Vec3 vectorOf(const HandCommand& command) { return {command.value[0], command.value[1], command.value[2]}; }

/// A vector of any finite components, shortened: their squares may be none.
Vec3 cutTo(const Vec3& force_N, double most_N);

/// Since it arrived. `most_ns`, as if it were that old, for one from later or from longer ago.
std::int64_t waited_ns(const HandCommand& command, std::int64_t now_ns, std::int64_t most_ns);

}  // namespace hl
