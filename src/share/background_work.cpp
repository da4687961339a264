#include "share/background_work.h"

#include <utility>

#include "base/guarded_thread.h"

namespace hl {

BackgroundWork::BackgroundWork(const char* name) : thread_(startThread(name, [this] { run(); })) {}

BackgroundWork::~BackgroundWork() {
  {
    const std::lock_guard lock(mutex_);
    running_ = false;
  }
  changed_.notify_all();
  thread_.join();
}

void BackgroundWork::post(Work work) {
  {
    const std::lock_guard lock(mutex_);
    work_.push_back(std::move(work));
  }
  changed_.notify_all();
}

void BackgroundWork::finish() {
  std::vector<Finish> done;
  {
    const std::lock_guard lock(mutex_);
    done.swap(done_);
  }
  for (const Finish& one : done) {
    if (one) one();
  }
}

void BackgroundWork::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return !running_ || !work_.empty(); });
    if (!running_) return;
    const Work work = std::move(work_.front());
    work_.pop_front();
    lock.unlock();
    Finish finish;
    guarded([&] { finish = work(); });
    lock.lock();
    done_.push_back(std::move(finish));
  }
}

}  // namespace hl
