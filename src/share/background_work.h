// BackgroundWork: pieces of work that take long, in a thread of their own, one after the other. What each gives is
// taken by the thread that has asked for it.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hl {

/// Constructed, used and destroyed by one thread. What is not begun when it is destroyed never is.
class BackgroundWork {
 public:
  /// Runs in the thread that calls finish(), once the work is done.
  using Finish = std::function<void()>;
  using Work = std::function<Finish()>;

  /// `name` of the thread, a literal of at most 15 characters.
  explicit BackgroundWork(const char* name);
  ~BackgroundWork();
  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;

  /// Work that throws is reported as any failure of a thread, and has no finish.
  void post(Work work);
  /// All that is done.
  void finish();

 private:
  void run();

  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::deque<Work> work_;
  std::vector<Finish> done_;
  bool running_ = true;
  std::thread thread_;
};

}  // namespace hl
