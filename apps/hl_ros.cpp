// hl-ros: hands as topics of ROS 2, for hld and hl touch, in a process of its own: what comes from a network ends it at
// the worst, and not the loops that hold somebody's hand. Its standard input is the socket to them; it ends with it.
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <string>
#include <vector>

#include "base/error.h"
#include "dds/ros_participant.h"
#include "ros/dds_process.h"
#include "ros/packets.h"
#include "ros/ros_task.h"

namespace {

// A server that is held up finds the newest commands gone: those that wait are older than they may be anyway.
template <typename Packet>
void tellServer(const Packet& packet) {
  const auto bytes = hl::bytesOf(packet);
  send(STDIN_FILENO, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

void serve(const hl::RosTask& task) {
  if (task.version != HL_VERSION)
    throw hl::Error("is of version " HL_VERSION " and was started by one of " + task.version +
                    ": install both of one version");
  close_range(STDERR_FILENO + 1, ~0U, 0);  // sockets of the server that came along
  hl::RosParticipant participant(task, [](const hl::HandCommand& command) { tellServer(command); });
  tellServer(hl::DdsReady{});
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
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 1 && words[0] == "--version") {
    std::printf("hl-ros %s\n", HL_VERSION);
    return 0;
  }
  try {
    serve(hl::rosTaskOf(words));
    return 0;
  } catch (const hl::Error& error) {
    std::fprintf(stderr, "hl-ros: %s\n", error.what());
    return 2;
  }
}
