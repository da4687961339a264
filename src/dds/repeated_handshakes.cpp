#include "dds/repeated_handshakes.h"

#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>

namespace {

// The writer of a handshake's messages (DDS Security 1.1, 7.4.5.1), which is in the head of each part of one. Elsewhere
// four such bytes are rare, and a datagram that comes several times does no harm.
constexpr std::string_view kStatelessWriter("\x00\x02\x01\xc3", 4);

bool repeats = false;

bool isOfHandshake(const msghdr& message) {
  return std::any_of(message.msg_iov, message.msg_iov + message.msg_iovlen, [](const iovec& part) {
    return std::string_view(static_cast<const char*>(part.iov_base), part.iov_len).find(kStatelessWriter) !=
           std::string_view::npos;
  });
}

}  // namespace

// In the place of the C library's, for all libraries of the program.
extern "C" [[gnu::visibility("default")]] ssize_t sendmsg(int descriptor, const msghdr* message, int flags) {
  const int copies = repeats && isOfHandshake(*message) ? hl::kHandshakeCopies : 1;
  for (int i = 1; i < copies; ++i) syscall(SYS_sendmsg, descriptor, message, flags);
  return syscall(SYS_sendmsg, descriptor, message, flags);
}

namespace hl {

void repeatHandshakes() { repeats = true; }

}  // namespace hl
