// What the rigid bodies remember when a recording begins while a session runs, so that their steps can be made again
// from there.
#pragma once

#include <recording.pb.h>

#include "touch/bodies_memory.h"

namespace hl {

void toProto(const BodiesMemory& memory, proto::RecordedBodies& out);
/// Throws hl::Error for a memory that no session has.
BodiesMemory fromProto(const proto::RecordedBodies& in);

}  // namespace hl
