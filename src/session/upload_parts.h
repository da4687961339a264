// Uploads that came in parts.
#pragma once

#include <hl.pb.h>

#include <list>

#include "base/memory_budget.h"

namespace hl {

/// Leaves one part with the lists of all, in their order. Its memory is taken while they are joined, and stays taken.
void joinParts(std::list<proto::Primitives>& parts, MemoryShare& memory);

}  // namespace hl
