// TouchMonitor: the health and the numbers of a touch session, for /healthz and /metrics.
#pragma once

#include <memory>

#include "monitor/monitor_callbacks.h"
#include "record/page_recordings.h"
#include "session/touch_server.h"

namespace hl {

/// For the HttpServer whose pages show this session (both use its views in the server's thread); the session must
/// outlive the server. With `clients`: of all its devices, by name where they have one. Not healthy: a loop that has
/// made no step for a quarter of a second, or a servo in fault. With the clients' numbers where there is a server for
/// them; it must outlive the other too. `recordings`: those that pages ask for; null: they cannot.
MonitorCallbacks makeTouchMonitor(TouchSession& session, TouchServer* clients = nullptr,
                                  std::shared_ptr<const PageRecordings> recordings = nullptr);

}  // namespace hl
