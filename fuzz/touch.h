// What every fuzzer asks of a scene that was taken: it can be touched.
#pragma once

#include "scene/snapshot.h"

namespace hl::fuzz {

/// Aborts, which is what a fuzzer notices, unless it holds.
void require(bool holds);

/// A finger goes through the middle of the scene while it moves. Aborts when the proxy is lost.
void touch(const Snapshot& snapshot);

}  // namespace hl::fuzz
