// ViewerFeed: between a touch session and the page, in the messages of proto/hl.proto.
#pragma once

#include <memory>
#include <string>

#include "server/http_server.h"
#include "server/touch_session.h"

namespace hl {

/// The callbacks of an HttpServer for this session, which must outlive the server.
FeedCallbacks makeViewerFeed(TouchSession& session, const std::string& version);

}  // namespace hl
