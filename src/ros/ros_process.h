// RosProcess: hl-ros, started with a socket to it.
#pragma once

#include <sys/types.h>

#include "ros/ros_link.h"
#include "ros/ros_task.h"

namespace hl {

/// Ends with this object.
class RosProcess final : public RosLink {
 public:
  /// Returns when others can find its topics. Throws hl::Error, with what to do, when hl-ros is not there or cannot
  /// serve this task.
  explicit RosProcess(const RosTask& task);
  ~RosProcess() override;
  RosProcess(const RosProcess&) = delete;
  RosProcess& operator=(const RosProcess&) = delete;

  void wait(std::int64_t most_ns) override;
  bool send(const RosHandState& state) override;
  std::optional<HandCommand> receive() override;
  bool ended() const override { return ended_; }

 private:
  void waitUntilReady();
  void end();

  int socket_ = -1;
  pid_t id_ = 0;
  bool ended_ = false;
};

/// Where hl-ros is; empty: nowhere.
std::string rosProgram();
/// What to do then.
inline constexpr const char* kNoRosProgram =
    "topics of ROS 2 are served by hl-ros, which is not here: install the package hl-ros, or run scripts/deps --ros "
    "and "
    "scripts/build";

}  // namespace hl
