// The materials of a placed shape in a layout.
#pragma once

#include <hl.pb.h>

#include <cstddef>

#include "scene/snapshot.h"

namespace hl {

/// A shape with more materials is not described: a layout is sent whole.
inline constexpr std::size_t kMaxLayoutMaterials = 256;

/// Appends them by number; numbers that a texture modulates are left out.
void addMaterials(const Surfaces& surfaces, proto::PlacedMesh& placed);

}  // namespace hl
