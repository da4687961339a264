// ViewerFeed: between a touch session and the page, in the messages of proto/hl.proto.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/memory_budget.h"
#include "page/feed_callbacks.h"
#include "record/page_recordings.h"
#include "surfaces/iso_cells.h"
#include "touch/touch_session.h"

namespace hl {

/// Takes another iso value for a surface of a volume, by its key; throws hl::Error if that cannot be.
using SetIso = std::function<void(std::uint64_t surface, const IsoChoice& iso)>;

/// The callbacks of an HttpServer for this session, which must outlive the server. What pages are shown is counted
/// against `memory`. `recordings`: those of the session's recorder; null: pages cannot record. `upload_bytes`: the
/// largest file that they may send, 0: none. `set_iso`: for the iso values that pages choose; empty: they cannot.
/// `others`: the server's other devices, by number from 1; pages see their hands, and may move and arm them.
FeedCallbacks makeViewerFeed(TouchSession& session, const std::string& version, MemoryBudget memory = {},
                             std::shared_ptr<PageRecordings> recordings = nullptr, std::uint64_t upload_bytes = 0,
                             SetIso set_iso = {}, std::vector<TouchSession*> others = {});

}  // namespace hl
