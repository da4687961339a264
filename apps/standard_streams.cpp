#include "standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace hl {

void prepareStreams() {
  // For reading: what is written to it is still an error.
  while (true) {
    const int next = open("/dev/null", O_RDONLY);
    if (next > STDERR_FILENO) close(next);
    if (next < 0 || next > STDERR_FILENO) break;
  }
  static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
}

int codeWithOutput(int code, const char* program) {
  errno = 0;
  const bool lost = std::ferror(stdout) != 0 || std::fflush(stdout) != 0;
  if (!lost || code != 0) return code;
  tell("{}: what it printed is lost: {}\n", program, errno != 0 ? std::strerror(errno) : "stdout took nothing");
  return 1;
}

}  // namespace hl
