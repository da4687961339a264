// hl-share: a server's part of a shared world, for hld and hl touch, in a process of its own: what comes from a network
// ends it at the worst, and not the loops that hold somebody's hand. Its standard input is the socket to them; it ends
// with it.
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <utility>

#include "base/clock.h"
#include "base/program_main.h"
#include "dds/share_participant.h"
#include "ros/dds_serving.h"
#include "share/share_task.h"

namespace {

// Waits while the server is behind. It ends the process when the server has ended, through the main thread.
void sendToServer(const hl::SharePacket& packet) {
  const std::string bytes = hl::bytesOf(packet);
  while (send(STDIN_FILENO, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

// What waits is tried again after so long.
constexpr int kAgain_ms = 5;

/// What the server has sent to others, and how much of it waits here.
class Sending {
 public:
  explicit Sending(hl::ShareOutbox& out) : out_(out) {}

  // False: the server has ended.
  bool takeOne() {
    const auto size = recv(STDIN_FILENO, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (size < 0 && (errno == EINTR || errno == EAGAIN)) return true;
    if (size <= 0) return false;
    auto packet = hl::sharePacketOf({buffer_.data(), static_cast<std::size_t>(size)});
    if (!packet) return true;
    if (packet->lane != hl::Lane::kStream) known_bytes_ += packet->bytes.size();
    out_.send(std::move(*packet), hl::monotonicNow_ns());
    return true;
  }
  // Tries again what waits, and reports to the server what does so no more: now, or when it reads.
  void flush() {
    out_.flush(hl::monotonicNow_ns());
    const hl::ShareTaken taken{known_bytes_ - out_.waiting_bytes()};
    if (taken.bytes > 0 && send(STDIN_FILENO, &taken, sizeof taken, MSG_DONTWAIT | MSG_NOSIGNAL) > 0)
      known_bytes_ -= taken.bytes;
  }
  bool waits() const { return known_bytes_ > 0; }

 private:
  hl::ShareOutbox& out_;
  std::uint64_t known_bytes_ = 0;  // that wait, as the server knows it
  std::string buffer_ = std::string(hl::kMaxShareMessage_bytes + 1, '\0');
};

void serve(const hl::ShareTask& task) {
  hl::beginServing(HL_VERSION, task.version);
  hl::ShareParticipant participant(task, sendToServer);
  const hl::DdsReady ready;
  send(STDIN_FILENO, &ready, sizeof ready, MSG_NOSIGNAL);
  participant.start();
  Sending sending(participant.out());
  for (;;) {
    pollfd waiting{STDIN_FILENO, POLLIN, 0};
    poll(&waiting, 1, sending.waits() ? kAgain_ms : 1000);
    if (waiting.revents != 0 && !sending.takeOne()) return;
    sending.flush();
  }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only when not even stderr can be written
int main(int argc, char** argv) {
  return hl::programMain("hl-share", HL_VERSION, {argv, static_cast<std::size_t>(argc)},
                         [](const auto& words) { serve(hl::shareTaskOf(words)); });
}
