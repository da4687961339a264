// hl-share: a server's part of a shared world, for hld and hl touch, in a process of its own: what comes from a network
// ends it at the worst, and not the loops that hold somebody's hand. Its standard input is the socket to them; it ends
// with it.
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/error.h"
#include "dds/share_participant.h"
#include "ros/dds_process.h"
#include "ros/packets.h"
#include "share/share_task.h"

namespace {

// Waits while the server is behind. It ends the process when the server has ended, through the main thread.
void tellServer(const hl::SharePacket& packet) {
  const std::string bytes = hl::bytesOf(packet);
  while (send(STDIN_FILENO, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

// What waits is tried again after so long.
constexpr int kAgain_ms = 5;

// False: the server has ended.
bool takeOne(hl::ShareParticipant& participant, std::string& buffer) {
  const auto size = recv(STDIN_FILENO, buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (size < 0 && (errno == EINTR || errno == EAGAIN)) return true;
  if (size <= 0) return false;
  if (auto packet = hl::sharePacketOf({buffer.data(), static_cast<std::size_t>(size)}))
    participant.out().send(std::move(*packet), hl::monotonicNow_ns());
  return true;
}

void serve(const hl::ShareTask& task) {
  if (task.version != HL_VERSION)
    throw hl::Error("is of version " HL_VERSION " and was started by one of " + task.version +
                    ": install both of one version");
  close_range(STDERR_FILENO + 1, ~0U, 0);  // sockets of the server that came along
  hl::ShareParticipant participant(task, tellServer);
  const hl::DdsReady ready;
  send(STDIN_FILENO, &ready, sizeof ready, MSG_NOSIGNAL);
  participant.start();
  std::string buffer(hl::kMostShareMessage_bytes + 1, '\0');
  for (;;) {
    pollfd waiting{STDIN_FILENO, static_cast<short>(participant.out().full() ? 0 : POLLIN), 0};
    poll(&waiting, 1, participant.out().waits() ? kAgain_ms : 1000);
    if ((waiting.revents & (POLLHUP | POLLERR)) != 0 && (waiting.revents & POLLIN) == 0) return;
    if ((waiting.revents & POLLIN) != 0 && !takeOne(participant, buffer)) return;
    participant.out().flush(hl::monotonicNow_ns());
  }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only when not even stderr can be written
int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 1 && words[0] == "--version") {
    std::printf("hl-share %s\n", HL_VERSION);
    return 0;
  }
  try {
    serve(hl::shareTaskOf(words));
    return 0;
  } catch (const hl::Error& error) {
    std::fprintf(stderr, "hl-share: %s\n", error.what());
    return 2;
  }
}
