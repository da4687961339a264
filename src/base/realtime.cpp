#include "base/realtime.h"

#include <link.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "base/plain_file.h"

namespace hl {

namespace {

// ThreadSanitizer's own locks spin: a real-time thread would wait for ever for one whose owner it keeps from running.
#ifdef __SANITIZE_THREAD__
constexpr bool kLocksSpin = true;
#else
constexpr bool kLocksSpin = false;
#endif

// errno of lockProcessMemory(), 0 when it succeeded.
constexpr int kNobodyAsked = -1;
std::atomic<int> memory_lock{kNobodyAsked};

constexpr std::size_t kPageBytes = 4096;
constexpr std::size_t kEnoughToSpare = 4;

[[gnu::noinline]] void touchStack() {
  std::array<char, kTouchedStack_bytes> stack;
  volatile char* const pages = stack.data();
  for (std::size_t i = 0; i < kTouchedStack_bytes; i += kPageBytes) pages[i] = 0;
}

int numberAt(std::string_view& text) {
  int number = -1;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number).ptr;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

// The kernel's lists: "2-3,5"; empty when there is none.
std::vector<int> isolatedCores() {
  const std::string list = contentOf("/sys/devices/system/cpu/isolated").value_or("");
  std::vector<int> cores;
  for (std::string_view rest = list; !rest.empty() && rest.front() >= '0' && rest.front() <= '9';) {
    const int first = numberAt(rest);
    int last = first;
    if (!rest.empty() && rest.front() == '-') {
      rest.remove_prefix(1);
      last = numberAt(rest);
    }
    for (int core = first; core <= last; ++core) cores.push_back(core);
    if (!rest.empty()) rest.remove_prefix(1);
  }
  return cores;
}

std::vector<int> allowedCores() {
  cpu_set_t allowed;
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof(allowed), &allowed) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(core, &allowed)) cores.push_back(core);
  }
  return cores;
}

// 0, or why not.
int pinTo(int core) {
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(core, &only);
  return pthread_setaffinity_np(pthread_self(), sizeof(only), &only);
}

// A byte of each page. Between the globals of the sanitizers lies what must not be read.
__attribute__((no_sanitize("address", "thread"))) void touchPages(std::uintptr_t first, std::size_t bytes) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  for (std::uintptr_t at = first & ~(page - 1); at < first + bytes; at += page)
    static_cast<void>(*reinterpret_cast<const volatile char*>(at));  // NOLINT: the linker says where it is
}

std::string reason(int error) { return error == kNobodyAsked ? "this program does not lock it" : std::strerror(error); }

}  // namespace

int spareCore(int nth) {
  const auto n = static_cast<std::size_t>(nth);
  if (const std::vector<int> isolated = isolatedCores(); n < isolated.size()) return isolated[n];
  const std::vector<int> allowed = allowedCores();
  if (allowed.size() < kEnoughToSpare || n >= allowed.size() / 2) return -1;
  return allowed[allowed.size() - 1 - n];
}

void lockProcessMemory() {
  memory_lock = mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0 ? 0 : errno;
  touchPrograms();
}

void touchPrograms() {
  const auto touch = [](dl_phdr_info* program, std::size_t, void*) {
    for (const ElfW(Phdr) & part : std::span(program->dlpi_phdr, program->dlpi_phnum)) {
      if (part.p_type == PT_LOAD && (part.p_flags & PF_R) != 0)
        touchPages(program->dlpi_addr + part.p_vaddr, part.p_memsz);
    }
    return 0;
  };
  dl_iterate_phdr(touch, nullptr);
}

RealtimeGrant requestRealtime(int priority, int core) {
  RealtimeGrant grant;
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int refused = kLocksSpin ? ENOTSUP : pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  grant.fifo = refused == 0;
  if (refused != 0) grant.why += std::string("no real-time priority (") + std::strerror(refused) + "). ";
  const int unlocked = memory_lock.load();
  grant.memory_locked = unlocked == 0;
  if (!grant.memory_locked) grant.why += "memory is not locked (" + reason(unlocked) + "). ";
  const int unpinned = core < 0 ? 0 : pinTo(core);
  if (core >= 0 && unpinned == 0) grant.core = core;
  if (unpinned != 0) grant.why += "no core of its own (" + reason(unpinned) + "). ";
  touchStack();
  return grant;
}

}  // namespace hl
