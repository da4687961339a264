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
#include "share/share_view.h"
#include "surfaces/iso_cells.h"
#include "touch/touch_session.h"

namespace hl {

/// Takes another iso value for a surface of a volume, by its key; throws hl::Error if that cannot be.
using SetIso = std::function<void(std::uint64_t surface, const IsoChoice& iso)>;

struct ViewerFeedSettings {
  MemoryBudget memory{};  ///< what pages are shown is counted there
  /// Those of the session's recorder; null: pages cannot record.
  std::shared_ptr<PageRecordings> recordings{};
  std::uint64_t upload_bytes = 0;  ///< the largest file that pages may send; 0: none
  SetIso set_iso{};                ///< for the iso values that pages choose; empty: they cannot
  /// The server's other devices, by number from 1; pages see their hands, and may move and arm them.
  std::vector<TouchSession*> others{};
  ReadShare share{};  ///< the world that the server shares; empty: none
};

/// The callbacks of an HttpServer for this session, which must outlive the server, as what the settings name.
FeedCallbacks makeViewerFeed(TouchSession& session, const std::string& version, ViewerFeedSettings settings = {});

}  // namespace hl
