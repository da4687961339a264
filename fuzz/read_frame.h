// What a server does with a client's message, on one thread and with small limits.
#pragma once

#include <string_view>

#include "session/message_forms.h"

namespace hl::fuzz {

/// Aborts when a message that is refused has changed the scene, or one that is taken has left it broken.
void readMessage(MessageForm form, std::string_view bytes);

}  // namespace hl::fuzz
