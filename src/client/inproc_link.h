// InprocLink: a client's link to a server in the same process: messages go over as they are, without a network.
#pragma once

#include <memory>

#include "client/server_url.h"
#include "session/client_session.h"
#include "wire/link.h"

namespace hl::client {

/// All links of a process lead to one server with a simulated device; it lives as long as any of them.
std::unique_ptr<Link> openInproc(const ServerUrl& url);

/// A link to this very server. Throws hl::Error when it has no room.
std::unique_ptr<Link> linkTo(std::shared_ptr<SessionHost> host);

}  // namespace hl::client
