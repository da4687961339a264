// What systemd wants to hear of a service of Type=notify: sd_notify(3)'s protocol, one datagram.
#pragma once

#include <string>

namespace hl {

/// Sends `state` ("READY=1", "STOPPING=1") to $NOTIFY_SOCKET; does nothing when nobody listens.
void notifySystemd(const std::string& state);

}  // namespace hl
