// RealtimeGuard: each thing that it forbids is found inside a guarded scope, and allowed outside of one.
#include "guard/realtime_guard.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "guard/system_call_trap.h"

namespace hl::test_realtime_guard {
namespace {

// Kept from the optimiser, which may drop an allocation that nobody sees.
void see(const void* memory) {
  static const void* volatile seen = nullptr;
  seen = memory;
  (void)seen;
}

void allocate(std::size_t count) {
  std::vector<int> values(count, 1);
  see(values.data());
}

TEST(RealtimeGuard, TheHooksAreAlive) {
  const std::uint64_t before = RealtimeGuard::heapCalls();
  allocate(1000);
  EXPECT_GT(RealtimeGuard::heapCalls(), before);
}

TEST(RealtimeGuard, OtherThreadsAndLaterScopesAreFree) {
  std::atomic<bool> go{false};
  std::thread other([&] {
    while (!go.load()) std::this_thread::yield();
    allocate(1000);
  });
  {
    const RealtimeGuard outer;
    const RealtimeGuard inner;
    go.store(true);
  }
  other.join();
  allocate(1000);
}

// What a scope of the guard forbids, and the word by which it reports so.
struct Forbidden {
  const char* name;
  const char* word;
  void (*act)();
  bool sanitized_too = false;  // the guard finds it in builds with sanitizers as well
};

std::mutex mutex;
std::shared_mutex shared_mutex;
std::condition_variable condition;
void* block = nullptr;
pthread_mutex_t plain_mutex = PTHREAD_MUTEX_INITIALIZER;
pthread_cond_t plain_condition = PTHREAD_COND_INITIALIZER;

const std::array<Forbidden, 24> kForbidden{{
    {"OperatorNew", "the heap", [] { see(::operator new(100)); }, true},
    {"OperatorNewArray", "the heap", [] { see(::operator new[](100)); }, true},
    {"OperatorNewAligned", "the heap", [] { see(::operator new (100, std::align_val_t{64})); }, true},
    {"OperatorDelete", "the heap", [] { ::operator delete(block); }, true},
    {"Vector", "the heap", [] { allocate(1000); }, true},
    {"Malloc", "the heap", [] { see(std::malloc(100)); }},
    {"Calloc", "the heap", [] { see(std::calloc(10, 10)); }},
    {"Realloc", "the heap", [] { see(std::realloc(block, 200)); }},
    {"Free", "the heap", [] { std::free(block); }},
    {"AlignedAlloc", "the heap", [] { see(std::aligned_alloc(64, 128)); }},
    {"PosixMemalign", "the heap",
     [] {
       void* memory = nullptr;
       see(posix_memalign(&memory, 64, 128) == 0 ? memory : nullptr);
     }},
    {"Throw", "__cxa_allocate_exception",
     [] {
       try {
         throw 1;
       } catch (int) {
       }
     }},
    {"ThrowOfTheLibrary", "__cxa_allocate_exception|the heap",
     [] {
       try {
         see(std::vector<int>().at(3) == 0 ? nullptr : &mutex);
       } catch (const std::out_of_range&) {
       }
     }},
    {"Rethrow", "__cxa_rethrow",
     [] {
       try {
         throw;
       } catch (int) {
       }
     }},
    {"MutexLock", "pthread_mutex_lock", [] { mutex.lock(); }},
    {"MutexTryLock", "pthread_mutex_trylock", [] { see(mutex.try_lock() ? &mutex : nullptr); }},
    {"PlainMutex", "pthread_mutex_lock", [] { pthread_mutex_lock(&plain_mutex); }},
    {"ConditionWait", "pthread_cond_wait", [] { pthread_cond_wait(&plain_condition, &plain_mutex); }},
    {"ConditionOfTheLibrary", "pthread_cond_(wait|timedwait|clockwait)",
     [] {
       std::unique_lock lock(mutex, std::adopt_lock);
       condition.wait_for(lock, std::chrono::seconds(1));
     }},
    {"ConditionNotify", "pthread_cond_signal", [] { condition.notify_one(); }},
    {"ConditionNotifyAll", "pthread_cond_broadcast", [] { condition.notify_all(); }},
    {"SharedLock", "pthread_rwlock_rdlock", [] { shared_mutex.lock_shared(); }},
    {"UniqueLock", "pthread_rwlock_wrlock", [] { shared_mutex.lock(); }},
    {"TryUniqueLock", "pthread_rwlock_trywrlock", [] { see(shared_mutex.try_lock() ? &mutex : nullptr); }},
}};

class RealtimeGuardDeathTest : public testing::TestWithParam<Forbidden> {};

TEST_P(RealtimeGuardDeathTest, FindsWhatIsForbidden) {
  const Forbidden& forbidden = GetParam();
  if (!RealtimeGuard::kWhole && !forbidden.sanitized_too) GTEST_SKIP() << "the sanitizer stands there itself";
  block = ::operator new(100);
  EXPECT_DEATH(
      {
        const RealtimeGuard guard;
        forbidden.act();
      },
      std::string("a real-time scope calls (") + forbidden.word + ")");
  ::operator delete(block);
}

INSTANTIATE_TEST_SUITE_P(All, RealtimeGuardDeathTest, testing::ValuesIn(kForbidden),
                         [](const auto& tested) { return std::string(tested.param.name); });

// What a trapped process ends with while it works, or after.
constexpr int kNotPermitted = 92;

void trap() {
  if (!trapSystemCalls()) _exit(kNotPermitted);
}

class SystemCallTrapDeathTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!RealtimeGuard::kWhole) GTEST_SKIP() << "the sanitizers make system calls of their own";
    if (!trapsArePermitted()) GTEST_SKIP() << "the kernel or a container does not permit seccomp";
  }
};

TEST_F(SystemCallTrapDeathTest, FindsASystemCall) {
  EXPECT_EXIT(
      {
        trap();
        syscall(SYS_getppid);
      },
      testing::ExitedWithCode(kTrappedExit), "number " + std::to_string(SYS_getppid));
}

TEST_F(SystemCallTrapDeathTest, FindsAYieldASleepAndAFile) {
  const auto found = [](void (*act)()) {
    EXPECT_EXIT(
        {
          trap();
          act();
        },
        testing::ExitedWithCode(kTrappedExit), "a system call where none may be");
  };
  found([] { std::this_thread::yield(); });
  found([] { std::this_thread::sleep_for(std::chrono::nanoseconds(1)); });
  found([] { see(std::fopen("/dev/null", "r")); });
  found([] { (void)!::write(STDOUT_FILENO, "", 0); });
  found([] { see(std::malloc(std::size_t{64} << 20)); });
}

TEST_F(SystemCallTrapDeathTest, LetsTheClockAndWhatIsAllowedPass) {
  const auto work = [] {
    constexpr std::array<int, 1> kAllowed{SYS_getppid};
    if (!trapSystemCalls(kAllowed)) _exit(kNotPermitted);
    const std::int64_t now_ns = monotonicNow_ns();
    syscall(SYS_getppid);
    _exit(now_ns > 0 ? 0 : 1);
  };
  EXPECT_EXIT(work(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace hl::test_realtime_guard
