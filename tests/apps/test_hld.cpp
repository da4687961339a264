// hld as an operator meets it: its log, its signals, its configuration file, and what it reports to systemd.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plain_client.h"
#include "temp_folder.h"

namespace hl::test_hld {
namespace {

using hl::test::fileWith;
using hl::test::request;
constexpr const char* kToken = "correct-horse-battery";

// In the address of the line that says it is ready.
std::uint16_t portOf(const std::string& ready) {
  const std::size_t slash = ready.find('/', ready.find("://") + 3);
  const std::size_t colon = ready.rfind(':', slash);
  return static_cast<std::uint16_t>(std::stoi(ready.substr(colon + 1, slash - colon - 1)));
}

// A running hld, whose stderr is read line by line.
class Daemon {
 public:
  explicit Daemon(std::vector<std::string> arguments, const std::string& notify_socket = "") {
    arguments.insert(arguments.begin(), HLD_PROGRAM);
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], STDERR_FILENO);
      close(ends[0]);
      close(ends[1]);
      if (!notify_socket.empty()) setenv("NOTIFY_SOCKET", notify_socket.c_str(), 1);
      std::vector<char*> words;
      for (std::string& argument : arguments) words.push_back(argument.data());
      words.push_back(nullptr);
      execv(HLD_PROGRAM, words.data());
      _exit(127);
    }
    close(ends[1]);
    log_ = fdopen(ends[0], "r");
  }
  ~Daemon() {
    if (pid_ > 0) end(SIGKILL);
    std::fclose(log_);
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  /// The next line that has `word` in it; empty when hld ends without one.
  std::string line(const std::string& word) {
    char buffer[4096];
    while (std::fgets(buffer, sizeof buffer, log_) != nullptr) {
      if (std::strstr(buffer, word.c_str()) != nullptr) return buffer;
    }
    return "";
  }
  std::uint16_t port() { return portOf(line("event=ready")); }
  void signal(int number) const { kill(pid_, number); }
  int end(int number) {
    signal(number);
    return wait();
  }
  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_ = -1;
  std::FILE* log_ = nullptr;
};

unsigned metricsWith(std::uint16_t port, const std::string& token) {
  return request(port, "/metrics", {{hl::test::http::field::authorization, "Bearer " + token}}).result_int();
}

TEST(Hld, ServesUntilItIsStopped) {
  for (const int number : {SIGTERM, SIGINT}) {
    Daemon daemon({"--port", "0"});
    const std::uint16_t port = daemon.port();
    EXPECT_EQ(request(port, "/healthz").result_int(), 200u);
    const std::string metrics = request(port, "/metrics").body();
    EXPECT_NE(metrics.find("\nhl_scene_primitives 0\n"), std::string::npos);
    EXPECT_EQ(daemon.end(number), 0);
  }
}

TEST(Hld, ServesAGivenScene) {
  Daemon daemon({"--port", "0", "--scene", "plane:200", "--hand", "firm", "--servo-rate", "2000"});
  const std::string metrics = request(daemon.port(), "/metrics").body();
  EXPECT_NE(metrics.find("\nhl_scene_primitives 200\n"), std::string::npos) << metrics;
  EXPECT_EQ(daemon.end(SIGTERM), 0);
}

TEST(Hld, TheFileSaysItAndTheCommandLineHasTheLastWord) {
  const std::string token = fileWith("token", std::string(kToken) + "\n");
  const std::string config =
      fileWith("hld.conf", "# a comment\nport = 1\ntoken-file = \"" + token +
                               "\"\nlimit-pages = 3\nlog-format = \"keyvalue\"\nscene = \"plane:200\"\n");
  Daemon daemon({"--config", config, "--port", "0"});
  const std::uint16_t port = daemon.port();
  EXPECT_EQ(request(port, "/metrics").result_int(), 401u);
  EXPECT_EQ(metricsWith(port, kToken), 200u);
  EXPECT_EQ(daemon.end(SIGTERM), 0);
}

TEST(Hld, TheTokenIsReadAgainOnHangup) {
  const std::string token = fileWith("token", kToken);
  Daemon daemon({"--port", "0", "--token-file", token});
  const std::uint16_t port = daemon.port();
  EXPECT_EQ(metricsWith(port, kToken), 200u);
  fileWith("token", "  another-horse-battery \n");
  daemon.signal(SIGHUP);
  EXPECT_NE(daemon.line("event=token_read_again"), "");
  EXPECT_EQ(metricsWith(port, kToken), 401u);
  EXPECT_EQ(metricsWith(port, "another-horse-battery"), 200u);
  // A file that is no good changes nothing.
  fileWith("token", "short");
  daemon.signal(SIGHUP);
  EXPECT_NE(daemon.line("event=token_kept"), "");
  EXPECT_EQ(metricsWith(port, "another-horse-battery"), 200u);
  EXPECT_EQ(daemon.end(SIGTERM), 0);
}

TEST(Hld, ATokenThatOthersMayReadIsMentioned) {
  const std::string token = fileWith("token", kToken);
  std::filesystem::permissions(token, std::filesystem::perms(0644));
  Daemon daemon({"--port", "0", "--token-file", token});
  EXPECT_NE(daemon.line("event=token_is_no_secret"), "");
  EXPECT_NE(daemon.line("event=ready"), "");
  EXPECT_EQ(daemon.end(SIGTERM), 0);
}

TEST(Hld, LogsInJson) {
  Daemon daemon({"--port", "0", "--log-format", "json"});
  const auto expectJson = [](const std::string& line) {
    EXPECT_TRUE(line.starts_with("{\"time\":\"")) << line;
    EXPECT_TRUE(line.ends_with("\"}\n")) << line;
  };
  std::string line = daemon.line("\"event\":\"ready\"");
  expectJson(line);
  // An Open whose token is no text: nothing but the log's own line reports it.
  hl::test::PlainClient client(portOf(line));
  client.sendBinary("\x0a\x03\x1a\x01\xff");
  EXPECT_NE(client.readToEnd(), "");
  while (line.find("\"event\":\"refused\"") == std::string::npos) {
    line = daemon.line("");
    expectJson(line);
    ASSERT_FALSE(line.empty());
  }
  EXPECT_EQ(daemon.end(SIGTERM), 0);
}

TEST(Hld, NotifiesSystemdWhenItIsReadyAndWhenItStops) {
  const std::string path = hl::test::tempFile("notify");
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const auto heard = [socket] {
    char buffer[100];
    const ssize_t size = recv(socket, buffer, sizeof buffer, 0);
    return std::string(buffer, size < 0 ? 0 : static_cast<std::size_t>(size));
  };
  Daemon daemon({"--port", "0"}, path);
  EXPECT_EQ(heard(), "READY=1");
  daemon.signal(SIGTERM);
  EXPECT_EQ(heard(), "STOPPING=1");
  EXPECT_EQ(daemon.wait(), 0);
  close(socket);
}

// Where neither it nor the shell finds hl-ros.
TEST(Hld, WithoutHlRosItSaysWhatToInstall) {
  const std::string alone = hl::test::tempFile("hld");
  std::filesystem::copy_file(HLD_PROGRAM, alone);
  std::FILE* const hld = popen(("PATH= " + alone + " --port 0 --ros lab 2>&1").c_str(), "r");
  char line[1000] = "";
  EXPECT_NE(std::fgets(line, sizeof line, hld), nullptr);
  EXPECT_EQ(WEXITSTATUS(pclose(hld)), 2);
  EXPECT_NE(std::strstr(line, "install the package hl-ros, or run scripts/deps --ros and scripts/build"), nullptr)
      << line;
}

TEST(Hld, BadInputIsOneLineAndExitCodeTwo) {
  const std::string misspelt = fileWith("misspelt.conf", "lissten = \"127.0.0.1\"\n");
  const std::string binary = fileWith("binary.conf", "na\x01me\xff = 3\n");
  const std::string bad_token = fileWith("bad_token", "short\n");
  const std::vector<std::vector<std::string>> cases = {{"--listen", "0.0.0.0"},
                                                       {"--listen", "nowhere"},
                                                       {"--port", "70000"},
                                                       {"--config", "/nonexistent"},
                                                       {"--config", "/dev/zero"},
                                                       {"--config", misspelt},
                                                       {"--config", binary},
                                                       {"--share", ""},
                                                       {"--share", "lab", "--share-name", "a b"},
                                                       {"--share", "lab", "--share-name", ""},
                                                       {"--token-file", ""},
                                                       {"--token-file", "/dev/zero"},
                                                       {"--token-file", "/nonexistent"},
                                                       {"--token-file", bad_token},
                                                       {"--scene", "nosuch"},
                                                       {"--device", "theremin"},
                                                       {"--explore", "maybe"},
                                                       {"--limit-pages", "0"},
                                                       {"--limit-pages", "4294967296"},
                                                       {"--limit-workers", "257"},
                                                       {"--limit-message-bytes", "16383"},
                                                       {"--limit-memory-bytes", "99999999999999999999999"},
                                                       {"--iso", "1"},
                                                       {"--grid", "x"},
                                                       {"--below"},
                                                       {"--surfels"},
                                                       {"--vertical-scale", "2"},
                                                       {"--deflection", "1e-5"},
                                                       {"--scene", "teapot", "--deflection", "1e-5"},
                                                       {"--black-box", ""},
                                                       {"--tls-key", "/nonexistent"},
                                                       {"--log-level", "loud"},
                                                       {"--limit-message-bytes", "-1"},
                                                       {"surplus"},
                                                       {"--limit-memory-bytes", "1"},
                                                       {"--limit-memory-bytes", "-5"},
                                                       {"--page-dir", "/nonexistent"},
                                                       {"--black-box", "/proc/none"},
                                                       {"--tool-mass", "100"},
                                                       {"--ros", "9lab"},
                                                       {"--ros-rate", "1001"},
                                                       {"--ros-rate", "nan"},
                                                       {"--ros-interface", "lo"},
                                                       {"--ros", "lab", "--ros-interface", "eth0"},
                                                       {"--ros", "lab", "--ros-peer", "10.0.0.1"},
                                                       {"--ros", "lab", "--ros-security", "a\nb"},
                                                       {"--devices", "0"},
                                                       {"--devices", "17"},
                                                       {"--device", "1st=sim"},
                                                       {"--faults", "together"},
                                                       {"--device", "dhd:99"}};
  for (std::vector<std::string> arguments : cases) {
    const std::string name = arguments.back();
    if (arguments.front() != "--port") arguments.insert(arguments.end(), {"--port", "0"});
    Daemon daemon(arguments);
    const std::string line = daemon.line("");
    EXPECT_TRUE(line.starts_with("hld: ")) << name << ": " << line;
    EXPECT_EQ(daemon.line(""), "") << name;
    EXPECT_EQ(daemon.wait(), 2) << name;
  }
}

TEST(Hld, DevicesThatCannotBeHadTogetherAreOneLineThatSaysWhy) {
  const auto refusal = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--port", "0"});
    Daemon daemon(arguments);
    std::string line = daemon.line("");
    EXPECT_EQ(daemon.line(""), "");
    EXPECT_EQ(daemon.wait(), 2);
    return line;
  };
  EXPECT_EQ(refusal({"--devices", "2", "--device", "sim"}),
            "hld: --devices 2 is for simulated devices alone: leave it out, and write --device once for each device\n");
  EXPECT_NE(refusal({"--device", "dhd", "--device", "dhd:0"}).find("'left' and 'right' are one device"),
            std::string::npos);
  EXPECT_NE(refusal({"--device", "a=sim", "--device", "a=sim"}).find("two devices have the name 'a'"),
            std::string::npos);
}

TEST(Hld, LogsWhichDeviceIsWhich) {
  const std::string config = fileWith("two.conf", "device = left=sim:touch\ndevice = right=sim\nport = 0\n");
  Daemon daemon({"--config", config});
  EXPECT_NE(daemon.line("event=ready")
                .find("device=\"left: simulated 3D Systems Touch, right: simulated PHANToM Premium 1.5\""),
            std::string::npos);
  EXPECT_NE(daemon.line("event=device").find("name=left model=\"simulated 3D Systems Touch\" number=0"),
            std::string::npos);
  EXPECT_NE(daemon.line("event=device").find("name=right"), std::string::npos);
  EXPECT_EQ(daemon.end(SIGTERM), 0);
}

}  // namespace
}  // namespace hl::test_hld
