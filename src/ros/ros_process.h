// RosProcess: hl-ros, started with a socket to it.
#pragma once

#include "ros/dds_process.h"
#include "ros/ros_link.h"
#include "ros/ros_task.h"

namespace hl {

inline constexpr DdsProgram kRosProgram{
    "hl-ros",
    "topics of ROS 2 are served by hl-ros, which is not here: install the package hl-ros, or run scripts/deps --ros "
    "and scripts/build"};

/// Ends with this object.
class RosProcess final : public RosLink {
 public:
  /// As DdsProcess.
  explicit RosProcess(const RosTask& task) : process_(kRosProgram, wordsOf(task)) {}

  void wait(std::int64_t most_ns) override { process_.wait(most_ns); }
  bool send(const RosHandState& state) override { return process_.send(bytesOf(state)); }
  std::optional<HandCommand> receive() override;
  bool ended() const override { return process_.ended(); }
  bool startAgain() override { return process_.startAgain(); }

 private:
  DdsProcess process_;
};

}  // namespace hl
