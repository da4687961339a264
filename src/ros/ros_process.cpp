#include "ros/ros_process.h"

#include <array>

namespace hl {

std::optional<HandCommand> RosProcess::receive() {
  std::array<char, sizeof(HandCommand) + 1> buffer;
  while (const auto packet = process_.receive(buffer)) {
    if (const auto command = packetOf<HandCommand>(*packet)) return command;
  }
  return std::nullopt;
}

}  // namespace hl
