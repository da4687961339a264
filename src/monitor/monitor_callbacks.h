// MonitorCallbacks: health and numbers, for the code that serves them.
#pragma once

#include <functional>
#include <string>

#include "monitor/metrics_text.h"

namespace hl {

/// What the server publishes about what it serves, without knowing it. Called in the thread of FeedCallbacks; each may
/// be empty.
struct MonitorCallbacks {
  std::function<void()> observe;              ///< at the feed's rate, whether anyone asks or not
  std::function<std::string()> fault;         ///< why it is not healthy, in one line; empty when it is
  std::function<void(MetricsText&)> metrics;  ///< appends its own families
};

}  // namespace hl
