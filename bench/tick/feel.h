// What a surface does beside holding the proxy off, in four steps from nothing to everything at once.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "scene/snapshot.h"

namespace hl::bench {

/// Everything: shading, both frictions, viscosity, and textures of stiffness, static friction and height.
enum class Feel : std::uint8_t { kPlain, kShading, kFriction, kEverything };
inline constexpr std::array kFeels{Feel::kPlain, Feel::kShading, Feel::kFriction, Feel::kEverything};
/// "plain", "shading", "friction" or "everything".
const char* nameOf(Feel feel);

/// The shape alone, where its model says; all its materials feel like that.
std::shared_ptr<const Snapshot> makeSnapshotOf(std::shared_ptr<const Shape> shape, Feel feel);

}  // namespace hl::bench
