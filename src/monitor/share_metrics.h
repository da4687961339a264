// ShareMetrics: how a server shares a world with others, for /metrics.
#pragma once

#include "monitor/monitor_callbacks.h"
#include "share/share_view.h"

namespace hl {

void writeShareMetrics(MetricsText& out, const ShareView& view);

/// `monitor`, with the numbers of the shared world where there is one; what `read` reads must outlive the server.
MonitorCallbacks withShareMetrics(MonitorCallbacks monitor, ReadShare read);

}  // namespace hl
