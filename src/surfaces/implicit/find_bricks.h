// Finds the large bricks of a sheet.
#pragma once

#include <cstddef>

#include "surfaces/implicit/known_bricks.h"
#include "surfaces/implicit/sheet.h"

namespace hl {

/// From the largest brick down to level 1, or to the level at which there would be more than `most` in all. Some
/// microseconds for each of them. Setup only.
KnownBricks findBricks(const Sheet& sheet, std::size_t most);

}  // namespace hl
