// Options of what goes by DDS, alike for topics of ROS 2 and shared worlds.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "ros/dds_process.h"
#include "ros/dds_reach.h"

namespace hl {

/// What a person reads of them.
struct ReachHelp {
  const char* group;
  const char* security;        ///< what the keys are for
  const char* interface_name;  ///< what the network interface is to
};
/// `use`.option and -security, -interface, -peer, which need that option. `reach` must outlive `app`.
void addReachOptions(CLI::App& app, DdsReach& reach, const DdsUse& use, const ReachHelp& help);

/// Of what a person may expect here, in one line: that `program` is here, `for_what`, and in which domain `what` would
/// be; or what to do. For hl doctor.
std::string presenceOf(const DdsProgram& program, const char* for_what, const char* what);

}  // namespace hl
