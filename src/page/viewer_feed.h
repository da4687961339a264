// ViewerFeed: between a touch session and the page, in the messages of proto/hl.proto.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/memory_budget.h"
#include "page/feed_callbacks.h"
#include "touch/touch_session.h"

namespace hl {

/// The callbacks of an HttpServer for this session, which must outlive the server. What pages are shown is counted
/// against `memory`. `upload_bytes`: the largest file that they may send, 0: none.
FeedCallbacks makeViewerFeed(TouchSession& session, const std::string& version, MemoryBudget memory = {},
                             std::uint64_t upload_bytes = 0);

}  // namespace hl
