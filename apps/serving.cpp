#include "serving.h"

#include <time.h>

#include <algorithm>
#include <filesystem>

namespace hl {

sigset_t blockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
  return signals;
}

int waitForSignal(const sigset_t& signals, double longest_s) {
  if (longest_s <= 0) {
    int received = 0;
    sigwait(&signals, &received);
    return received;
  }
  const auto whole = static_cast<time_t>(longest_s);
  const timespec limit{whole, static_cast<long>(1e9 * (longest_s - static_cast<double>(whole)))};
  return std::max(0, sigtimedwait(&signals, nullptr, &limit));
}

std::string defaultPageFolder() {
  constexpr const char* kBuilt = "viewer/dist";
  constexpr const char* kInstalled = "share/hl/viewer";
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return kBuilt;
  for (auto folder = program.parent_path(); folder != folder.root_path(); folder = folder.parent_path()) {
    for (const char* page : {kBuilt, kInstalled}) {
      if (std::filesystem::exists(folder / page / "index.html", error)) return (folder / page).string();
    }
  }
  return kBuilt;
}

}  // namespace hl
