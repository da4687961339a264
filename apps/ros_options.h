// Options of topics of ROS 2, the same for hl and hld, and the bridge that they ask for.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "ros/ros_bridge.h"
#include "ros/ros_task.h"
#include "session/touch_server.h"

namespace hl {

struct RosOptions {
  std::string name_space;  ///< empty: no topics
  double rate_Hz = 250;
  DdsReach reach;
  std::string teleop_hand;  ///< as in its topics; empty: none leads a robot
  TeleopSettings teleop;
};

/// `options` must outlive `app`.
void addRosOptions(CLI::App& app, RosOptions& options);

/// With hl-ros started, for the devices of `server`, which must outlive it; null when nobody asks for topics. Throws
/// hl::Error when hl-ros cannot be had. Before other threads are started.
std::unique_ptr<RosBridge> makeRosBridge(const RosOptions& options, TouchServer& server, RosBridge::ReportLine report);

/// Of what a person may expect of --ros here, in one line: for hl doctor.
std::string rosPresence();

}  // namespace hl
