// ShareMetrics: how a server shares a world with others, for /metrics and /healthz.
#pragma once

#include "monitor/monitor_callbacks.h"
#include "share/share_view.h"

namespace hl {

void writeShareMetrics(MetricsText& out, const ShareView& view);

/// `monitor`, which has all of its functions but maybe `observe`, with the numbers of the shared world where there is
/// one. Not healthy: also a server that has ended sharing, as it does not begin again until it is started again; its
/// hands go on. What `read` reads must outlive the server.
MonitorCallbacks withShareMetrics(MonitorCallbacks monitor, ReadShare read);

}  // namespace hl
