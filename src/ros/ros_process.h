// RosProcess: hl-ros, started with a socket to it.
#pragma once

#include <sys/types.h>

#include <optional>

#include "ros/packets.h"
#include "ros/ros_task.h"

namespace hl {

/// One thread at a time. Ends with this object.
class RosProcess {
 public:
  /// Returns when others can find its topics. Throws hl::Error, with what to do, when hl-ros is not there or cannot
  /// serve this task.
  explicit RosProcess(const RosTask& task);
  ~RosProcess();
  RosProcess(const RosProcess&) = delete;
  RosProcess& operator=(const RosProcess&) = delete;

  /// To wait on: readable when there is a command, or hl-ros has ended.
  int socket() const { return socket_; }
  /// False: hl-ros is behind, and the state is left out.
  bool send(const HandState& state);
  /// The next one that has come, without waiting.
  std::optional<HandCommand> receive();
  /// Nothing comes any more.
  bool ended() const { return ended_; }

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
