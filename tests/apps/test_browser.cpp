// The browser that hl touch starts has nothing of hl's: no descriptor, no blocked or ignored signal, no terminal.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "temp_folder.h"
#include "wait_for.h"

namespace hl::test_browser {
namespace {

using hl::test::tempFile;
using hl::test::waitFor;

std::string contentOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// What stands behind `key` in /proc/PID/status.
std::string valueOf(const std::string& status, const std::string& key) {
  std::istringstream lines(status);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(key + ":")) return line.substr(line.find_first_not_of(" \t", key.size() + 1));
  }
  return "none";
}

std::size_t zombiesOf(pid_t parent) {
  std::size_t zombies = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string status = contentOf(entry.path() / "status");
    zombies += valueOf(status, "PPid") == std::to_string(parent) && valueOf(status, "State").starts_with("Z") ? 1 : 0;
  }
  return zombies;
}

// An xdg-open that notes what it has been given, as one file when it is whole.
std::string fakeDesktop() {
  const std::string folder = tempFile("desktop");
  std::filesystem::create_directory(folder);
  std::ofstream(folder + "/xdg-open") << "#!/bin/sh\n"
                                         "cat /proc/self/status > " +
                                             folder +
                                             "/status\n"
                                             "ls -l /proc/$$/fd > " +
                                             folder +
                                             "/descriptors\n"
                                             "echo \"$@\" > " +
                                             folder +
                                             "/words.part\n"
                                             "mv " +
                                             folder + "/words.part " + folder + "/words\n";
  chmod((folder + "/xdg-open").c_str(), 0755);
  return folder;
}

pid_t startTouch(const std::string& desktop) {
  const pid_t child = fork();
  if (child != 0) return child;
  setenv("DISPLAY", ":0", 1);
  setenv("PATH", (desktop + ":" + std::getenv("PATH")).c_str(), 1);
  execl(HL_PROGRAM, HL_PROGRAM, "touch", "plane:2", "--port", "0", static_cast<char*>(nullptr));
  _exit(127);
}

TEST(Browser, InheritsNothingAndLeavesNoZombie) {
  const std::string desktop = fakeDesktop();
  const pid_t touch = startTouch(desktop);
  waitFor([&] { return std::filesystem::exists(desktop + "/words"); });
  EXPECT_TRUE(contentOf(desktop + "/words").starts_with("http://127.0.0.1:"));
  const std::string status = contentOf(desktop + "/status");
  EXPECT_EQ(valueOf(status, "SigBlk"), "0000000000000000");
  // Of the signals that have names: posix_spawn ignores two of the C library's own.
  constexpr unsigned long kNamed = 0x7fffffff;
  EXPECT_EQ(std::stoul(valueOf(status, "SigIgn"), nullptr, 16) & kNamed, 0U);
  const std::string descriptors = contentOf(desktop + "/descriptors");
  EXPECT_EQ(descriptors.find("socket:"), std::string::npos) << descriptors;
  EXPECT_EQ(descriptors.find("eventpoll"), std::string::npos) << descriptors;
  EXPECT_EQ(descriptors.find("pipe:"), std::string::npos) << descriptors;
  waitFor([&] { return zombiesOf(touch) == 0; });
  kill(touch, SIGTERM);
  int ended = 0;
  waitpid(touch, &ended, 0);
  EXPECT_TRUE(WIFEXITED(ended) && WEXITSTATUS(ended) == 0);
}

}  // namespace
}  // namespace hl::test_browser
