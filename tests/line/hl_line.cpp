// hl_line: a bad line between network namespaces, by user-space alone: README.md says how to use it.
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cerrno>
#include <cstdio>
#include <iostream>
#include <string>

#include "base/clock.h"
#include "line/hub.h"
#include "line/line_end.h"

namespace hl::line {
namespace {

constexpr int kCannot = 2, kRefused = 77;  // codes that it ends with

// Answers "ok" after what was asked for, or "error: ..." and nothing is changed.
std::string answer(Hub& hub, const std::string& text, int ends) {
  try {
    const Order order = orderOf(text, ends);
    hub.obey(order);
    return (order.kind == OrderKind::kCount ? hub.describe() : "") + "ok\n";
  } catch (const Error& error) {
    return std::string("error: ") + error.what() + '\n';
  }
}

/// Lines of standard input, as they come.
class Input {
 public:
  /// To be called when there is something to read. False: no more comes.
  template <typename Take>
  bool read(const Take& take) {
    std::array<char, 4096> buffer;
    const ssize_t size = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (size <= 0) return false;
    text_.append(buffer.data(), static_cast<std::size_t>(size));
    for (std::size_t end; (end = text_.find('\n')) != text_.npos; text_.erase(0, end + 1)) take(text_.substr(0, end));
    return true;
  }

 private:
  std::string text_;
};

// Some at a time, so that no end waits for another that sends without a pause.
void readPackets(Hub& hub, int end, int device) {
  constexpr int kMax = 64;
  std::array<char, 2048> buffer;
  for (int i = 0; i < kMax; ++i) {
    const ssize_t size = read(device, buffer.data(), buffer.size());
    if (size <= 0) return;
    hub.put(end, Packet(buffer.data(), buffer.data() + size), monotonicNow_ns());
  }
}

timespec untilNext(const Hub& hub) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000, kLongest_ns = 10 * kSecond_ns;
  const std::int64_t due_ns = hub.due_ns();
  const std::int64_t left_ns =
      due_ns == Link::kNever_ns ? kLongest_ns : std::clamp<std::int64_t>(due_ns - monotonicNow_ns(), 0, kLongest_ns);
  return {left_ns / kSecond_ns, left_ns % kSecond_ns};
}

// Until its input ends or a signal asks it to.
void run(Hub& hub, const std::vector<LineEnd>& ends, int signals) {
  std::vector<pollfd> files{{STDIN_FILENO, POLLIN, 0}, {signals, POLLIN, 0}};
  for (const LineEnd& end : ends) files.push_back({end.device(), POLLIN, 0});
  Input input;
  for (;;) {
    hub.give(monotonicNow_ns(), [&](int end, const Packet& packet) {
      // An end that is down takes nothing.
      [[maybe_unused]] const auto size =
          write(files[static_cast<std::size_t>(end) + 1].fd, packet.data(), packet.size());
    });
    const timespec wait = untilNext(hub);
    if (ppoll(files.data(), files.size(), &wait, nullptr) < 0 && errno != EINTR) return;
    if (files[1].revents != 0) return;
    for (std::size_t i = 2; i < files.size(); ++i) {
      if (files[i].revents != 0) readPackets(hub, static_cast<int>(i) - 1, files[i].fd);
    }
    const auto obey = [&](const std::string& text) {
      std::fputs(answer(hub, text, static_cast<int>(ends.size())).c_str(), stdout);
      std::fflush(stdout);
    };
    if (files[0].revents != 0 && !input.read(obey)) return;
  }
}

// Before anything is started that would inherit its own answer to them.
int blockedSignals() {
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGINT);
  sigaddset(&ends, SIGTERM);
  sigprocmask(SIG_BLOCK, &ends, nullptr);
  return signalfd(-1, &ends, SFD_CLOEXEC);
}

void serve(int count, std::uint64_t seed, const std::string& order) {
  Hub hub(count, seed);
  if (!order.empty()) hub.obey(orderOf(order, count));
  std::vector<LineEnd> ends;
  for (int end = 1; end <= count; ++end) {
    ends.emplace_back(end);
    std::printf("%d %s /proc/%d/fd/%d\n", end, addressOf(end).c_str(), getpid(), ends.back().nameSpace());
  }
  const int signals = blockedSignals();
  prctl(PR_SET_TIMERSLACK, 1000UL);  // ns; usually 50 us
  std::puts("ready");
  std::fflush(stdout);
  run(hub, ends, signals);
  std::fputs(hub.describe().c_str(), stdout);
}

}  // namespace
}  // namespace hl::line

// NOLINTNEXTLINE(bugprone-exception-escape): only when not even stderr can be written
int main(int argc, char** argv) {
  CLI::App app("Joins network namespaces by a bad line; tests/line/README.md tells how.");
  int ends = 2;
  std::uint64_t seed = 1;
  std::vector<std::string> order;
  app.add_option("--ends", ends, "how many namespaces")
      ->check(CLI::Range(2, hl::line::Hub::kMaxEnds))
      ->capture_default_str();
  app.add_option("--seed", seed, "of all chance: the same loses the same packets")->capture_default_str();
  app.add_option("ORDER", order, "how the line is from the start, such as: delay 50 jitter 5 loss 1");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : hl::line::kCannot;
  }
  try {
    hl::line::serve(ends, seed, CLI::detail::join(order, " "));
    return 0;
  } catch (const hl::line::LineRefused& refused) {
    std::fprintf(stderr, "hl_line: %s\n", refused.what());
    return hl::line::kRefused;
  } catch (const hl::Error& error) {
    std::fprintf(stderr, "hl_line: %s\n", error.what());
    return hl::line::kCannot;
  }
}
