#include "base/guarded_thread.h"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <exception>
#include <utility>

namespace hl {

namespace {

thread_local const char* thread_name = "";

struct Failures {
  std::atomic<const char*> thread{nullptr};
  std::atomic<std::uint64_t> count{0};
  std::atomic<bool> now{false};
};
// Filled from the front; never emptied. Names are few and known when HL is built.
constinit std::array<Failures, kMaxThreadNames> failures_of{};

// snprintf to the stack and write(2): a report of a failure needs no memory.
void reportToStderr(const char* thread, const char* what) {
  std::array<char, 256> line{};
  const int length = std::snprintf(line.data(), line.size(), "thread '%s' failed and goes on: %s\n", thread, what);
  if (length <= 0) return;
  const auto bytes = std::min(static_cast<std::size_t>(length), line.size() - 1);
  (void)!::write(STDERR_FILENO, line.data(), bytes);
}

std::atomic<ReportFailure> report_failure{reportToStderr};

// The place of this name, found or taken; null when all are.
Failures* failuresOf(const char* thread) {
  for (Failures& failures : failures_of) {
    const char* known = nullptr;
    if (failures.thread.compare_exchange_strong(known, thread) || std::strcmp(known, thread) == 0) return &failures;
  }
  return nullptr;
}

void fail(const char* what) noexcept {
  if (Failures* failures = failuresOf(thread_name)) {
    failures->count.fetch_add(1);
    failures->now.store(true);
  }
  try {
    report_failure.load()(thread_name, what);
  } catch (...) {
    reportToStderr(thread_name, what);
  }
}

// Only of threads that have failed: the others have no place.
void succeed() noexcept {
  for (Failures& failures : failures_of) {
    const char* const known = failures.thread.load();
    if (known == nullptr) return;
    if (std::strcmp(known, thread_name) == 0) failures.now.store(false);
  }
}

bool attempt(FunctionRef<void()> work) noexcept {
  try {
    work();
    return true;
  } catch (const std::exception& error) {
    fail(error.what());
  } catch (...) {
    fail("an exception without a message");
  }
  return false;
}

}  // namespace

bool guarded(FunctionRef<void()> work) noexcept {
  const bool good = attempt(work);
  if (good) succeed();
  return good;
}

void keepTrying(FunctionRef<bool()> wanted, FunctionRef<void()> work) noexcept {
  while (wanted() && !guarded(work)) std::this_thread::sleep_for(kAfterFailure);
}

void nameThread(const char* name) noexcept {
  thread_name = name;
  pthread_setname_np(pthread_self(), name);
}

const char* threadName() noexcept { return thread_name; }

std::thread startThread(const char* name, std::function<void()> body) {
  return std::thread([name, body = std::move(body)] {
    nameThread(name);
    while (!guarded(body)) std::this_thread::sleep_for(kAfterFailure);
  });
}

void LoopThread::start(const char* name, std::function<void()> body) {
  running_ = true;
  try {
    thread_ = startThread(name, std::move(body));
  } catch (...) {
    running_ = false;
    throw;
  }
}

bool LoopThread::stop() {
  if (!running_.exchange(false)) return false;
  thread_.join();
  return true;
}

FixedVector<ThreadFailures, kMaxThreadNames> threadFailures() {
  FixedVector<ThreadFailures, kMaxThreadNames> all;
  for (const Failures& failures : failures_of) {
    const char* const thread = failures.thread.load();
    if (thread == nullptr) break;
    all.push({thread, failures.count.load(), failures.now.load()});
  }
  return all;
}

void setReportFailure(ReportFailure report) { report_failure.store(report == nullptr ? reportToStderr : report); }

}  // namespace hl
