// hl-ros: hands as topics of ROS 2, for hld and hl touch, in a process of its own: what comes from a network ends it at
// the worst, and not the loops that hold somebody's hand. Its standard input is the socket to them; it ends with it.
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>

#include "base/program_main.h"
#include "dds/ros_participant.h"
#include "ros/dds_serving.h"
#include "ros/packets.h"
#include "ros/ros_task.h"

namespace {

// A server that is held up finds the newest commands gone: those that wait are older than they may be anyway.
template <typename Packet>
void sendToServer(const Packet& packet) {
  const auto bytes = hl::bytesOf(packet);
  send(STDIN_FILENO, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

void serve(const hl::RosTask& task) {
  hl::beginServing(HL_VERSION, task.version);
  hl::RosParticipant participant(task, [](const hl::HandCommand& command) { sendToServer(command); });
  sendToServer(hl::DdsReady{});
  std::array<char, sizeof(hl::RosHandState)> buffer;
  for (;;) {
    const auto size = recv(STDIN_FILENO, buffer.data(), buffer.size(), 0);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return;
    if (const auto state = hl::packetOf<hl::RosHandState>({buffer.data(), static_cast<std::size_t>(size)}))
      participant.publish(*state);
  }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only when not even stderr can be written
int main(int argc, char** argv) {
  return hl::programMain("hl-ros", HL_VERSION, {argv, static_cast<std::size_t>(argc)},
                         [](const auto& words) { serve(hl::rosTaskOf(words)); });
}
