// RosMetrics: what a bridge to ROS 2 has published and taken, for /metrics.
#pragma once

#include "monitor/monitor_callbacks.h"
#include "ros/ros_bridge.h"

namespace hl {

void writeRosMetrics(MetricsText& out, const RosCounts& counts);

/// `monitor`, with the numbers of `bridge` where there is one; it must outlive the server.
MonitorCallbacks withRosMetrics(MonitorCallbacks monitor, const RosBridge* bridge);

}  // namespace hl
