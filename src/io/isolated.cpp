#include "io/isolated.h"

#include <fcntl.h>
#include <oneapi/tbb/global_control.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <new>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "base/machine_memory.h"
#include "io/model_parts.h"
#include "io/sandbox.h"

namespace hl {

namespace {

constexpr const char* kTooLong = "reading it takes too long: the file is corrupt, or too large";
constexpr const char* kWaits =
    "its reader waits for what does not come: it names a file that is none, or a disk does not answer";
constexpr const char* kGarbage = "its reader gave what makes no sense: the file is corrupt";

void setLimit(int resource, rlim_t soft, rlim_t hard) {
  const rlimit limit{soft, hard};
  setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

void setLimits(const IsolationLimits& limits) {
  constexpr rlim_t kMaxFiles = 64, kAfterTheSignal_s = 2;
  setLimit(RLIMIT_CPU, limits.cpu_s, limits.cpu_s + kAfterTheSignal_s);
  setLimit(RLIMIT_CORE, 0, 0);
  setLimit(RLIMIT_FSIZE, 0, 0);
  setLimit(RLIMIT_NOFILE, kMaxFiles, kMaxFiles);
#ifndef HL_SANITIZED  // sanitizers reserve terabytes of addresses
  setLimit(RLIMIT_AS, limits.memory_bytes, limits.memory_bytes);
#endif
}

// What the parser gives, or why it gives nothing, goes through the pipe.
void answer(PartSender& out, bool sandboxed, const Parse& parse) {
  std::string failure;
  try {
    SceneModel scene = parse(ReadingReport([&](double fraction) { out.progress(fraction); }, out, out, out));
    if (!sandboxed) scene.model.warnings.emplace_back("was read without a sandbox: this kernel has none");
    return out.scene(scene);
  } catch (const std::bad_alloc&) {
    failure = "needs more memory than it may have";
  } catch (const std::exception& error) {
    failure = error.what();
  }
  out.failure(failure);
}

// Where memory is short, this process is the one to go.
void offerToTheKernel() {
  const int file = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  constexpr std::string_view kFirst = "1000";
  [[maybe_unused]] const ssize_t written = write(file, kFirst.data(), kFirst.size());
  close(file);
}

[[noreturn]] void runChild(int pipe, int file, const IsolationLimits& limits, const Parse& parse) {
  for (const int handled : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGTERM, SIGXCPU, SIGPIPE})
    signal(handled, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  offerToTheKernel();
  const int out = closeDescriptorsBut(pipe, file);
  setLimits(limits);
  PartSender sender(out);
  try {
    answer(sender, allowReadingOnly(), parse);
  } catch (const std::exception&) {
    _exit(1);
  }
  _exit(0);
}

// Gives the number of the process, or that of an error, negative.
using StartChild = std::function<pid_t(int pipe)>;

pid_t forkChild(int pipe, const IsolationLimits& limits, const Parse& parse) {
  const pid_t id = fork();
  if (id == 0) runChild(pipe, -1, limits, parse);
  return id > 0 ? id : -errno;
}

// The servers' threads block signals; a reader must not.
pid_t startProgram(int pipe, const ReaderProgram& program, int descriptor) {
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_t files;
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_init(&files);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  posix_spawn_file_actions_adddup2(&files, descriptor, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, pipe, STDOUT_FILENO);
  std::vector<char*> words;
  for (const std::string& word : program.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  pid_t id = 0;
  const int error = posix_spawn(&id, program.file.c_str(), &files, &attributes, words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  return error == 0 ? id : -error;
}

/// A child process, and the end of the pipe that it writes to. Ends with this object.
class Child {
 public:
  explicit Child(const StartChild& start) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error(std::string("no pipe: ") + std::strerror(errno));
    id_ = start(ends[1]);
    close(ends[1]);
    pipe_ = ends[0];
    if (id_ > 0) return;
    close(pipe_);
    throw Error(std::string("no process to read it in: ") + std::strerror(-id_));
  }
  ~Child() { end(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int pipe() const { return pipe_; }
  /// Processor time that it has used; of a child that is gone, what it was last time.
  double cpu_s() {
    clockid_t clock{};
    timespec used{};
    if (clock_getcpuclockid(id_, &clock) == 0 && clock_gettime(clock, &used) == 0)
      cpu_s_ = static_cast<double>(used.tv_sec) + seconds(used.tv_nsec);
    return cpu_s_;
  }
  /// Kills it where it still runs; else what waitpid() reports of its own end, though it be only just under way.
  int end() {
    if (id_ <= 0) return status_;
    kill(id_, SIGKILL);
    while (waitpid(id_, &status_, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
    close(pipe_);
    return status_;
  }

 private:
  pid_t id_ = 0;
  int pipe_ = -1, status_ = 0;
  double cpu_s_ = 0;
};

/// Bytes of the pipe, as long as the child keeps to its time.
class PipeReader {
 public:
  PipeReader(Child& child, const IsolationLimits& limits, const std::atomic<bool>& given_up)
      : child_(child), limits_(limits), given_up_(given_up), begin_ns_(monotonicNow_ns()), active_ns_(begin_ns_) {}

  /// False at the end of the pipe. Throws hl::Error when the time is over.
  bool read(void* data, std::size_t size) {
    char* at = static_cast<char*>(data);
    while (size > 0) {
      if (!await()) continue;
      const ssize_t got = ::read(child_.pipe(), at, size);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      at += got;
      size -= static_cast<std::size_t>(got);
    }
    return true;
  }

 private:
  // Whether there is something to be read, within a moment.
  bool await() {
    constexpr int kLook_ms = 100;
    constexpr double kWorks_s = 1e-3;  // of the processor: more than looking whether a file is there
    pollfd ready{child_.pipe(), POLLIN, 0};
    const bool there = poll(&ready, 1, kLook_ms) > 0;
    if (given_up_) throw Error("the reading was given up");
    const std::int64_t now_ns = monotonicNow_ns();
    const double cpu_s = child_.cpu_s();
    if (there || cpu_s > cpu_s_ + kWorks_s) {
      active_ns_ = now_ns;
      cpu_s_ = cpu_s;
    }
    if (seconds(now_ns - begin_ns_) > limits_.wall_s) throw Error(kTooLong);
    if (seconds(now_ns - active_ns_) > limits_.idle_s) throw Error(kWaits);
    return there;
  }

  Child& child_;
  const IsolationLimits& limits_;
  const std::atomic<bool>& given_up_;
  std::int64_t begin_ns_, active_ns_;
  double cpu_s_ = 0;
};

std::string causeOf(int status) {
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) return kTooLong;
  if (WIFSIGNALED(status)) return "its reader crashed: the file is corrupt";
  return "its reader stopped: the file is corrupt";
}

// Takes in messages until the scene is whole.
SceneModel receive(Child& child, const IsolationLimits& limits, const std::atomic<bool>& given_up,
                   const std::function<void(double)>& progress) {
  PipeReader pipe(child, limits, given_up);
  PartCollector collector(limits.memory_bytes, limits.samples_bytes);
  std::string bytes;
  proto::ReadingPart part;
  for (std::uint32_t length = 0; pipe.read(&length, sizeof length);) {
    if (length > kMaxPartBytes) throw Error(kGarbage);
    bytes.resize(length);
    if (!pipe.read(bytes.data(), length)) break;
    if (!part.ParseFromString(bytes)) throw Error(kGarbage);
    const PartCollector::State state = collector.add(part, length, progress);
    if (state == PartCollector::State::kFailed) throw Error(collector.failure());
    if (state == PartCollector::State::kWhole) return collector.take();
  }
  throw Error(causeOf(child.end()));
}

SceneModel run(const std::string& name, const IsolationLimits& limits, const StartChild& start,
               const std::atomic<bool>& given_up, const std::function<void(double)>& progress) {
  try {
    Child child(start);
    return receive(child, limits, given_up, progress);
  } catch (const Error& error) {
    throw Error(name + ": " + error.what());
  }
}

IsolationLimits bounded(IsolationLimits limits) {
  limits.memory_bytes = std::min<std::uint64_t>(limits.memory_bytes, machineMemory_bytes());
  limits.samples_bytes = std::min<std::uint64_t>(limits.samples_bytes, machineMemory_bytes());
  return limits;
}

}  // namespace

SceneModel runIsolated(const std::string& name, const IsolationLimits& limits, const Parse& parse,
                       const std::function<void(double)>& progress) {
  const IsolationLimits within = bounded(limits);
  const std::atomic<bool> given_up{false};
  return run(
      name, within, [&](int pipe) { return forkChild(pipe, within, parse); }, given_up, progress);
}

SceneModel runProgram(const std::string& name, const IsolationLimits& limits, const ReaderProgram& program,
                      int descriptor, const std::atomic<bool>& given_up, const std::function<void(double)>& progress) {
  const auto start = [&](int pipe) { return startProgram(pipe, program, descriptor); };
  return run(name, bounded(limits), start, given_up, progress);
}

void answerAsProgram(const IsolationLimits& limits, const Parse& parse) {
  // A reader without rights can start no threads.
  const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  constexpr int kYielding = 10;  // to the loops of the server that waits for it
  setpriority(PRIO_PROCESS, 0, kYielding);
  runChild(STDOUT_FILENO, STDIN_FILENO, bounded(limits), parse);
}

}  // namespace hl
