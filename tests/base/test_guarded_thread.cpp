// Guarded threads: what a piece of work throws ends that piece alone, is counted under the thread's name, and reported.
#include "base/guarded_thread.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>

#include <array>
#include <atomic>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "guard/failing_allocation.h"

namespace hl::test_guarded_thread {
namespace {

ThreadFailures failuresOf(const std::string& thread) {
  for (const ThreadFailures& failures : threadFailures()) {
    if (failures.thread == thread) return failures;
  }
  return {};
}

std::string reported;  // of the thread that is joined before it is read

TEST(GuardedThread, IsKnownToTheKernelByItsName) {
  std::string kernel, own;
  startThread("test name", [&] {
    std::array<char, 16> name{};
    pthread_getname_np(pthread_self(), name.data(), name.size());
    kernel = name.data();
    own = threadName();
  }).join();
  EXPECT_EQ(kernel, "test name");
  EXPECT_EQ(own, "test name");
  EXPECT_EQ(std::string(threadName()), "") << "this thread is the test's";
}

TEST(GuardedThread, WhatAPieceOfWorkThrowsIsCountedReportedAndOver) {
  setReportFailure([](const char* thread, const char* what) { reported = std::string(thread) + ": " + what; });
  startThread("test pieces", [] {
    EXPECT_FALSE(guarded([] { throw std::runtime_error("a piece"); }));
    EXPECT_TRUE(failuresOf("test pieces").now);
    EXPECT_FALSE(guarded([] { throw 3; }));
    EXPECT_TRUE(guarded([] {}));
    EXPECT_FALSE(failuresOf("test pieces").now) << "its newest piece went well";
  }).join();
  setReportFailure(nullptr);
  EXPECT_EQ(failuresOf("test pieces").count, 2u);
  EXPECT_EQ(reported, "test pieces: an exception without a message");
}

TEST(GuardedThread, ABodyThatThrowsRunsOnceMore) {
  int runs = 0;
  startThread("test body", [&] {
    if (++runs < 3) throw std::bad_alloc();
  }).join();
  EXPECT_EQ(runs, 3);
  EXPECT_EQ(failuresOf("test body").count, 2u);
}

TEST(GuardedThread, OneThatCannotReportStillGoesOn) {
  setReportFailure([](const char*, const char*) { throw std::bad_alloc(); });
  EXPECT_FALSE(guarded([] { throw std::runtime_error("a piece"); }));
  setReportFailure(nullptr);
}

TEST(GuardedThread, TriesUntilItSucceedsOrIsNoLongerWanted) {
  int tries = 0;
  keepTrying([] { return true; },
             [&] {
               if (++tries < 3) throw std::bad_alloc();
             });
  EXPECT_EQ(tries, 3);
  keepTrying([&] { return tries < 5; },
             [&] {
               ++tries;
               throw std::bad_alloc();
             });
  EXPECT_EQ(tries, 5);
}

TEST(LoopThread, RunsUntilItIsStoppedAndMayBeStoppedTwice) {
  std::atomic<int> turns{0};
  LoopThread loop;
  EXPECT_FALSE(loop.stop());
  loop.start("test loop", [&] {
    while (loop.running()) ++turns;
  });
  while (turns == 0) std::this_thread::yield();
  EXPECT_TRUE(loop.stop());
  EXPECT_FALSE(loop.stop());
  EXPECT_FALSE(loop.running());
}

#ifndef HL_SANITIZED  // sanitizers reserve terabytes of addresses: there the limit is not set
// Without addresses for a stack there is no thread. Stacks of threads that have ended are used again first.
TEST(LoopThread, WhatCannotStartDoesNotRunAndNeedNotBeJoined) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  std::array<LoopThread, 32> loops;
  rlimit none = before;
  none.rlim_cur = 1 << 20;
  ASSERT_EQ(setrlimit(RLIMIT_AS, &none), 0);
  LoopThread* failed = nullptr;
  for (LoopThread& loop : loops) {
    try {
      loop.start("test loop", [&loop] {
        while (loop.running()) std::this_thread::yield();
      });
    } catch (const std::system_error&) {
      failed = &loop;
      break;
    }
  }
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  ASSERT_NE(failed, nullptr);
  EXPECT_FALSE(failed->running());
  EXPECT_FALSE(failed->stop());
}
#endif

// The test's own tool: the nth allocation of one thread fails, no other of it, and none of another thread.
TEST(FailingAllocation, FailsOnceInItsThread) {
  FailingAllocation::arm("test failing", 2);
  std::vector<int> failed;
  const auto allocate = [&failed](int number) {
    try {
      const auto owned = std::make_unique<std::array<char, 100>>();
      const volatile char* const kept = owned->data();  // an allocation that nobody sees may be dropped
      (void)kept[0];
    } catch (const std::bad_alloc&) {
      failed.push_back(number);
    }
  };
  failed.reserve(10);
  allocate(0);
  startThread("test other", [&] { allocate(0); }).join();
  startThread("test failing", [&] {
    for (int number = 1; number < 5; ++number) allocate(number);
  }).join();
  EXPECT_TRUE(FailingAllocation::disarm());
  EXPECT_EQ(failed, std::vector<int>{2});
}

}  // namespace
}  // namespace hl::test_guarded_thread
