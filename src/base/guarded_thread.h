// Every thread of HL runs guarded: what it throws costs the piece of work that threw it, and never the process, whose
// servo may be holding somebody's hand. Failures are counted by the name of their thread, and reported.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>

#include "base/fixed_vector.h"
#include "base/function_ref.h"

namespace hl {

/// After a failure a thread waits so long: what failed, memory for the most part, may be there again.
inline constexpr auto kAfterFailure = std::chrono::milliseconds(10);

/// A thread that runs `body` under `name`, a literal of at most 15 characters: the kernel shows no more. The body
/// returns when its work is over; when an exception leaves it, it runs once more, after kAfterFailure.
std::thread startThread(const char* name, std::function<void()> body);

/// The thread of a loop: what it runs looks at running(), and returns when that is false. One thread starts and stops
/// it; running() may be asked by any.
class LoopThread {
 public:
  LoopThread() = default;
  LoopThread(const LoopThread&) = delete;
  LoopThread& operator=(const LoopThread&) = delete;
  ~LoopThread() { stop(); }

  /// As startThread(). When it throws, nothing runs.
  void start(const char* name, std::function<void()> body);
  /// Joins it. Returns whether it was running: safe to call twice.
  bool stop();
  const std::atomic<bool>& running() const { return running_; }

 private:
  std::atomic<bool> running_{false};
  std::thread thread_;
};

/// For a thread that somebody else has started: its name from now on. Never fails.
void nameThread(const char* name) noexcept;
/// Of the calling thread, as it was started; "" for one that is not HL's.
const char* threadName() noexcept;

/// Runs a piece of work. What it throws is counted for this thread, reported, and goes no further. Returns whether
/// nothing was thrown.
bool guarded(FunctionRef<void()> work) noexcept;
/// Until it throws nothing, or `wanted` no longer holds: for what must not be lost.
void keepTrying(FunctionRef<bool()> wanted, FunctionRef<void()> work) noexcept;

/// What threads of one name have thrown since the process began.
struct ThreadFailures {
  const char* thread = "";
  std::uint64_t count = 0;
  bool now = false;  ///< their newest piece of work failed
};
inline constexpr std::size_t kMaxThreadNames = 32;
FixedVector<ThreadFailures, kMaxThreadNames> threadFailures();

/// Called for each failure, by the thread that failed; may throw. The first is a line on stderr.
using ReportFailure = void (*)(const char* thread, const char* what);
void setReportFailure(ReportFailure report);

}  // namespace hl
