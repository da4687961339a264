// What a server does with a client's message, on one thread and with small limits.
#pragma once

#include <hl.pb.h>

namespace hl::fuzz {

/// Aborts when a message that is refused has changed the scene, or one that is taken has left it broken.
void readFrame(const proto::ClientMessage& message);

}  // namespace hl::fuzz
