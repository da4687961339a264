// What the proxy remembers when a recording begins while a session runs, so that its ticks can be made again from
// there.
#pragma once

#include <recording.pb.h>

#include "touch/proxy_loop.h"

namespace hl {

/// All but what only saves time.
void toProto(const ProxyMemory& memory, proto::RecordedProxy& out);
/// Throws hl::Error for a memory that no session has.
ProxyMemory fromProto(const proto::RecordedProxy& in);

}  // namespace hl
