#include "ros/dds_process.h"

#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/error.h"
#include "io/reading_program.h"
#include "ros/dds_serving.h"

namespace hl {

namespace {

// Its start takes some tens of milliseconds, its end as many.
constexpr int kStart_ms = 20'000, kEnd_ms = 2'000;

// Signals stay as they are here, blocked in a server: the program ends with its socket, not with the Ctrl-C of a
// terminal.
pid_t startProgram(const DdsProgram& program, const std::string& file, const std::vector<std::string>& words,
                   int socket) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, socket, STDIN_FILENO);
  std::vector<char*> arguments{const_cast<char*>(program.name)};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t id = 0;
  const int error = posix_spawn(&id, file.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw Error(file + " cannot be started: " + std::strerror(error));
  return id;
}

bool readableWithin(int socket, int most_ms) {
  pollfd waiting{socket, POLLIN, 0};
  const std::int64_t until_ns = monotonicNow_ns() + std::int64_t{1'000'000} * most_ms;
  for (;;) {
    const auto left_ms = static_cast<int>((until_ns - monotonicNow_ns()) / 1'000'000);
    if (left_ms <= 0) return false;
    const int found = poll(&waiting, 1, left_ms);
    if (found > 0) return true;
    if (found < 0 && errno != EINTR) return false;
  }
}

// Whether it has ended by itself.
bool waitForEnd(pid_t id, int most_ms) {
  for (int waited_ms = 0;; ++waited_ms) {
    if (waitpid(id, nullptr, WNOHANG) != 0) return true;
    if (waited_ms >= most_ms) return false;
    usleep(1000);
  }
}

}  // namespace

DdsProcess::DdsProcess(const DdsProgram& program, const std::vector<std::string>& words)
    : program_(program), words_(words) {
  start();
}

void DdsProcess::start() {
  const std::string file = readingProgram(program_.name, program_.absent);
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    throw Error(std::string("no socket to ") + program_.name + ": " + std::strerror(errno));
  socket_ = ends[0];
  try {
    id_ = startProgram(program_, file, words_, ends[1]);
    close(ends[1]);
    waitUntilReady();
  } catch (...) {
    if (id_ == 0) close(ends[1]);
    end();
    throw;
  }
}

bool DdsProcess::startAgain() {
  end();
  try {
    start();
    ended_ = false;
  } catch (const Error&) {
    ended_ = true;  // what it lacks it has said itself
  }
  return !ended_;
}

void DdsProcess::waitUntilReady() const {
  if (!readableWithin(socket_, kStart_ms)) throw Error(std::string(program_.name) + " does not get ready");
  DdsReady ready;
  if (recv(socket_, &ready, sizeof ready, MSG_DONTWAIT) != sizeof ready)
    throw Error(std::string(program_.name) + " cannot serve: it has said why");
}

void DdsProcess::end() {
  if (socket_ >= 0) close(std::exchange(socket_, -1));
  const pid_t id = std::exchange(id_, 0);
  if (id == 0 || waitForEnd(id, kEnd_ms)) return;
  kill(id, SIGKILL);
  waitpid(id, nullptr, 0);
}

void DdsProcess::wait(std::int64_t most_ns) const {
  if (most_ns <= 0) return;
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  pollfd waiting{socket_, POLLIN, 0};
  const timespec most{most_ns / kSecond_ns, most_ns % kSecond_ns};
  ppoll(&waiting, 1, &most, nullptr);
}

bool DdsProcess::send(std::span<const char> packet) const {
  return ::send(socket_, packet.data(), packet.size(), MSG_DONTWAIT | MSG_NOSIGNAL) ==
         static_cast<ssize_t>(packet.size());
}

std::optional<std::span<const char>> DdsProcess::receive(std::span<char> buffer) {
  for (;;) {
    const ssize_t size = recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (size > 0) return buffer.first(static_cast<std::size_t>(size));
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && errno == EAGAIN) return std::nullopt;
    ended_ = true;
    if (id_ != 0 && waitForEnd(id_, 0)) id_ = 0;
    return std::nullopt;
  }
}

std::string placeOf(const DdsProgram& program) {
  try {
    return readingProgram(program.name, program.absent);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace hl
