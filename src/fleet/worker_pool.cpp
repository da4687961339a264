#include "fleet/worker_pool.h"

#include <fcntl.h>
#include <fleet.pb.h>
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "base/descriptor_bytes.h"
#include "base/error.h"
#include "fleet/fleet_texts.h"

namespace hl {

namespace {

constexpr std::uint32_t kMaxMessage_bytes = 1 << 20;

bool sendMessage(int pipe, const google::protobuf::MessageLite& message) {
  const auto size = static_cast<std::uint32_t>(message.ByteSizeLong());
  std::string bytes(reinterpret_cast<const char*>(&size), sizeof size);
  return message.AppendToString(&bytes) && writeWhole(pipe, bytes.data(), bytes.size());
}

bool receiveMessage(int pipe, google::protobuf::MessageLite& message) {
  std::uint32_t size = 0;
  if (!readWhole(pipe, &size, sizeof size) || size > kMaxMessage_bytes) return false;
  std::string bytes(size, '\0');
  return readWhole(pipe, bytes.data(), size) && message.ParseFromString(bytes);
}

std::string lastLineOf(int file) {
  constexpr off_t kMax = 4096;
  const off_t end = lseek(file, 0, SEEK_END);
  std::string text(static_cast<std::size_t>(std::clamp<off_t>(end, 0, kMax)), '\0');
  if (pread(file, text.data(), text.size(), std::max<off_t>(0, end - kMax)) < 0) return {};
  text.erase(std::find_if(text.rbegin(), text.rend(), [](char c) { return c != '\n'; }).base(), text.end());
  return text.substr(text.rfind('\n') + 1);
}

/// A worker process, with the pipes to and from it and a file in memory for what it says on standard error.
class Worker {
 public:
  explicit Worker(const WorkerProgram& program) {
    int to[2], from[2];
    if (pipe2(to, O_CLOEXEC) != 0) fail(errno);
    if (pipe2(from, O_CLOEXEC) != 0) fail(errno);
    said_ = memfd_create("hl worker", MFD_CLOEXEC);
    const int error = start(program, to[0], from[1]);
    close(to[0]);
    close(from[1]);
    to_ = to[1];
    from_ = from[0];
    if (error == 0) return;
    closeAll();
    fail(error);
  }
  // It ends at the end of its orders.
  ~Worker() { end(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  int pipe() const { return from_; }
  std::optional<std::size_t> task;  ///< that it does

  bool give(const FleetOrderText& text) {
    proto::FleetOrder order;
    order.set_name(text.name);
    for (const std::string& word : text.words) order.add_words(word);
    order.set_rows(text.rows);
    order.set_scene_sha256(text.scene_sha256);
    order.set_path_sha256(text.path_sha256);
    return sendMessage(to_, order);
  }
  /// The failure of its task, or empty. nullopt: it has died.
  std::optional<std::string> answer() {
    proto::FleetAnswer answer;
    if (!receiveMessage(from_, answer)) return {};
    return oneLineOf(answer.failure());
  }
  std::string causeOfDeath() {
    const std::string said = said_ >= 0 ? lastLineOf(said_) : "";
    const int status = end();
    const std::string cause = WIFSIGNALED(status) ? fmt::format("its process was ended by signal {} ({})",
                                                                WTERMSIG(status), strsignal(WTERMSIG(status)))
                                                  : fmt::format("its process ended with code {}", WEXITSTATUS(status));
    return oneLineOf(said.empty() ? cause : cause + ": " + said);
  }

 private:
  [[noreturn]] static void fail(int error) {
    throw Error(std::string("no worker can be started: ") + std::strerror(error));
  }

  int start(const WorkerProgram& program, int in, int out) {
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_t files;
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_init(&files);
    sigset_t pipes;
    sigemptyset(&pipes);
    sigaddset(&pipes, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &pipes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    posix_spawn_file_actions_adddup2(&files, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
    if (said_ >= 0) posix_spawn_file_actions_adddup2(&files, said_, STDERR_FILENO);
    std::vector<char*> words;
    for (const std::string& word : program.words) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const int error = posix_spawn(&id_, program.file.c_str(), &files, &attributes, words.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    return error;
  }
  void closeAll() {
    for (int* file : {&to_, &from_, &said_}) {
      if (*file >= 0) close(std::exchange(*file, -1));
    }
  }
  int end() {
    closeAll();
    if (id_ > 0) {
      while (waitpid(id_, &status_, 0) < 0 && errno == EINTR) {
      }
    }
    id_ = 0;
    return status_;
  }

  pid_t id_ = 0;
  int to_ = -1, from_ = -1, said_ = -1, status_ = 0;
};

/// Gives the tasks out.
class WorkerPool {
 public:
  WorkerPool(const WorkerProgram& program, std::size_t tasks, const FleetCallbacks& callbacks)
      : program_(program), tasks_(tasks), callbacks_(callbacks) {}

  void run(int jobs) {
    const std::size_t count = std::min(static_cast<std::size_t>(jobs), tasks_);
    for (std::size_t i = 0; i < count; ++i) workers_.push_back(std::make_unique<Worker>(program_));
    for (auto& worker : workers_) giveNext(worker);
    while (done_ < tasks_) look();
  }

 private:
  // To a worker that has died meanwhile: it takes this task with it, as if it had begun.
  void giveNext(std::unique_ptr<Worker>& worker) {
    while (next_ < tasks_) {
      worker->task = next_++;
      if (worker->give(callbacks_.order(*worker->task))) return;
      replace(worker);
    }
  }
  void replace(std::unique_ptr<Worker>& worker) {
    const std::size_t task = *std::exchange(worker->task, {});
    finish(task, worker->causeOfDeath());
    if (next_ < tasks_) worker = std::make_unique<Worker>(program_);
  }
  void finish(std::size_t task, const std::string& failure) {
    ++done_;
    callbacks_.done(task, failure);
  }
  void look() {
    constexpr int kLook_ms = 200;
    std::vector<pollfd> ready;
    for (const auto& worker : workers_) ready.push_back({worker->task ? worker->pipe() : -1, POLLIN, 0});
    poll(ready.data(), ready.size(), kLook_ms);
    for (std::size_t i = 0; i < ready.size(); ++i) {
      if (ready[i].revents != 0) take(workers_[i]);
    }
    callbacks_.wait();
  }
  void take(std::unique_ptr<Worker>& worker) {
    const std::optional<std::string> failure = worker->answer();
    if (failure) {
      finish(*std::exchange(worker->task, {}), *failure);
    } else {
      replace(worker);
    }
    giveNext(worker);
  }

  const WorkerProgram& program_;
  const std::size_t tasks_;
  const FleetCallbacks& callbacks_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::size_t next_ = 0, done_ = 0;
};

}  // namespace

void runWorkers(const WorkerProgram& program, int jobs, std::size_t tasks, const FleetCallbacks& callbacks) {
  const auto before = signal(SIGPIPE, SIG_IGN);  // a worker that is gone is an error of write()
  WorkerPool(program, tasks, callbacks).run(jobs);
  signal(SIGPIPE, before);
}

void answerOrders(const std::function<void(const FleetOrderText& order)>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // where its sweep is gone already, the orders end
  const int answers = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  proto::FleetOrder order;
  while (receiveMessage(STDIN_FILENO, order)) {
    proto::FleetAnswer answer;
    try {
      work({order.name(),
            {order.words().begin(), order.words().end()},
            order.rows(),
            order.scene_sha256(),
            order.path_sha256()});
    } catch (const std::bad_alloc&) {
      answer.set_failure("needs more memory than there is");
    } catch (const std::exception& error) {
      answer.set_failure(*error.what() == 0 ? "failed" : error.what());
    }
    if (!sendMessage(answers, answer)) return;
  }
}

}  // namespace hl
