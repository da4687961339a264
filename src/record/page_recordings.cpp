#include "record/page_recordings.h"

#include <fcntl.h>

#include <utility>

#include "base/clock.h"

namespace hl {

namespace {

using Phase = PageRecordingStatus::Phase;

bool isPast(std::int64_t since_ns, double limit_s, std::int64_t now_ns) { return seconds(now_ns - since_ns) > limit_s; }

}  // namespace

void PageRecordings::ask(std::uint32_t owner, bool on, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  if (owner == 0) return;
  if (owner == status_.owner) {
    heard_ns_ = now_ns;
    if (!on) wanted_ = false;
    return;
  }
  if (!on || status_.phase == Phase::kStarting || status_.phase == Phase::kRunning) return;
  clear({});
  status_.phase = Phase::kStarting;
  status_.owner = owner;
  wanted_ = true;
  heard_ns_ = now_ns;
}

PageRecordingStatus PageRecordings::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

// The writer's descriptor has its own place in the file, so readers open the file anew.
FilePointer PageRecordings::open(std::uint32_t owner) const {
  const std::lock_guard lock(mutex_);
  if (status_.phase != Phase::kReady || owner != status_.owner || !file_) return nullptr;
  const std::string path = "/proc/self/fd/" + std::to_string(file_->descriptor());
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  return descriptor < 0 ? nullptr : std::make_shared<const OpenFile>(descriptor);
}

std::optional<std::uint32_t> PageRecordings::wanted(std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  if (status_.phase == Phase::kReady && isPast(ready_ns_, kKept_s, now_ns)) clear({});
  if (wanted_ && isPast(heard_ns_, kMaxSilence_s, now_ns)) {
    wanted_ = false;
    abandoned_ = true;
  }
  return wanted_ ? std::optional(status_.owner) : std::nullopt;
}

bool PageRecordings::abandoned() const {
  const std::lock_guard lock(mutex_);
  return abandoned_;
}

// The owner stays: its page goes on asking until it has read this.
void PageRecordings::refuse(const std::string& why) {
  const std::lock_guard lock(mutex_);
  const std::uint32_t owner = status_.owner;
  clear(why);
  status_.owner = owner;
}

void PageRecordings::report(double time_s, std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (status_.phase == Phase::kStarting) ++status_.begun;
  status_.phase = Phase::kRunning;
  status_.time_s = time_s;
  status_.bytes = bytes;
}

void PageRecordings::keep(FilePointer file, const std::string& reason, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  status_.phase = Phase::kReady;
  status_.text = reason;
  ready_ns_ = now_ns;
  wanted_ = false;
  file_ = std::move(file);
}

void PageRecordings::drop() {
  const std::lock_guard lock(mutex_);
  clear({});
}

void PageRecordings::clear(std::string text) {
  status_ = {.text = std::move(text), .begun = status_.begun};
  wanted_ = abandoned_ = false;
  file_.reset();
}

}  // namespace hl
