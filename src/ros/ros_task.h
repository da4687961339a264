// RosTask: what hl-ros is started with, and the names that hands have in ROS 2.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ros/dds_reach.h"

namespace hl {

struct RosTask {
  std::string version;             ///< of the program that starts it
  std::uint32_t domain = 0;        ///< of DDS
  std::vector<std::string> hands;  ///< the name of each, with its namespace: "hl/left"
  DdsReach reach{};
};

/// The words after the name of hl-ros; the task of them, read again. Throws hl::Error for words that are no such.
std::vector<std::string> wordsOf(const RosTask& task);
RosTask rosTaskOf(const std::vector<std::string>& words);

/// A namespace as ROS 2 allows it: names of letters, digits and _, that no digit begins, with / between them. Gives it
/// without the / before it. Throws hl::Error.
std::string rosNamespace(const std::string& name);
/// The topic of DDS that is /`hand`/`name` in ROS 2.
std::string ddsTopic(const std::string& hand, const std::string& name);
/// The frame of the device of a hand: x to the user's right, y up, z toward the user.
std::string rosFrame(const std::string& hand);

}  // namespace hl
