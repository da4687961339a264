#include "serving.h"

#include <malloc.h>
#include <time.h>

#include <cstdlib>
#include <filesystem>
#include <utility>

namespace hl {

// Large pieces go back one by one, at a size that does not grow with what was freed before. Small ones share one arena:
// each arena keeps what it once was given, and a locked page cannot be given back from its middle.
void giveFreedMemoryBack() {
  constexpr int kLarge_bytes = 128 * 1024;
  mallopt(M_MMAP_THRESHOLD, kLarge_bytes);
  mallopt(M_TRIM_THRESHOLD, kLarge_bytes);
  mallopt(M_MMAP_MAX, 1 << 20);
  mallopt(M_ARENA_MAX, 1);
}

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

std::optional<int> waitForSignal(const sigset_t& signals, std::optional<double> longest_s) {
  if (!longest_s) {
    int received = 0;
    sigwait(&signals, &received);
    return received;
  }
  const auto whole = static_cast<time_t>(*longest_s);
  const timespec limit{whole, static_cast<long>(1e9 * (*longest_s - static_cast<double>(whole)))};
  const int received = sigtimedwait(&signals, nullptr, &limit);
  return received > 0 ? std::optional(received) : std::nullopt;
}

ViewerFeedSettings pageOf(TouchServer& server, ReadShare share) {
  ViewerFeedSettings page;
  page.memory = server.memory().member();
  page.set_iso = [&server](std::uint64_t surface, const IsoChoice& iso) { server.setIso(surface, iso); };
  page.others = server.otherDevices();
  page.share = std::move(share);
  return page;
}

// systemd's word for a service, XDG's for a person.
std::string defaultBlackBoxFolder() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string(value != nullptr ? value : "");
  };
  if (const std::string folder = variable("STATE_DIRECTORY"); !folder.empty()) return folder;
  if (const std::string folder = variable("XDG_STATE_HOME"); !folder.empty()) return folder + "/hl";
  if (const std::string home = variable("HOME"); !home.empty()) return home + "/.local/state/hl";
  return {};
}

// A fault is no time to find that its folder cannot be made.
std::string madeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw CLI::ValidationError("--black-box", folder + " cannot be made: " + error.message());
  return folder;
}

void addBlackBoxOption(CLI::App& command, RecorderSettings& recorder) {
  recorder.black_box_folder = defaultBlackBoxFolder();
  command
      .add_option_function<std::string>(
          "--black-box",
          [&recorder](const std::string& folder) {
            recorder.black_box_folder = folder == "off" ? "" : madeFolder(folder);
          },
          "where the last 5 s before a fault are written; the newest 20 files stay")
      ->option_text("DIR|off (default: " + (recorder.black_box_folder.empty() ? "off" : recorder.black_box_folder) +
                    ")")
      ->group("Force");
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
