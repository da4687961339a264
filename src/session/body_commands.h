// Body commands: from a client's message to what the loop does to a body.
#pragma once

#include <hl.pb.h>

#include "touch/body_command.h"

namespace hl {

/// Without the body's key. Throws hl::Error, one line that names the value, for what cannot be done.
BodyCommand toBodyCommand(const proto::BodyCommand& in);

}  // namespace hl
