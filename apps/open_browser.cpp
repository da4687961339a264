#include "open_browser.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include "base/guarded_thread.h"

namespace hl {

namespace {

// What a child starts with instead of what it would inherit. Without memory for it there is no browser.
class Inheritance {
 public:
  Inheritance() {
    posix_spawn_file_actions_init(&files_);
    good_ = posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDWR, 0) == 0 &&
            posix_spawn_file_actions_adddup2(&files_, STDIN_FILENO, STDOUT_FILENO) == 0 &&
            posix_spawn_file_actions_adddup2(&files_, STDIN_FILENO, STDERR_FILENO) == 0 &&
            posix_spawn_file_actions_addclosefrom_np(&files_, STDERR_FILENO + 1) == 0;
    posix_spawnattr_init(&attributes_);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSID);
  }
  ~Inheritance() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  Inheritance(const Inheritance&) = delete;
  Inheritance& operator=(const Inheritance&) = delete;

  bool good() const { return good_; }
  const posix_spawn_file_actions_t* files() const { return &files_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
  bool good_ = false;
};

}  // namespace

void openBrowser(const std::string& address) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  const Inheritance inheritance;
  std::string program = "xdg-open", page = address;
  const std::array<char*, 3> words{program.data(), page.data(), nullptr};
  pid_t child = 0;
  if (!inheritance.good() ||
      posix_spawnp(&child, program.c_str(), inheritance.files(), inheritance.attributes(), words.data(), environ) != 0)
    return;
  // Somebody has to take note of its end. It may be the browser itself, so nobody waits for this thread.
  startThread("browser", [child] { waitpid(child, nullptr, 0); }).detach();
}

}  // namespace hl
