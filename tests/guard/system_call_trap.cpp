#include "guard/system_call_trap.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace hl {

namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;  // not known: nothing is trapped
#endif

void onTrap(int, siginfo_t* info, void*) {
  std::array<char, 80> line{};
  const int length =
      std::snprintf(line.data(), line.size(), "a system call where none may be: number %d\n", info->si_syscall);
  (void)!::write(STDERR_FILENO, line.data(), static_cast<std::size_t>(length));
  _exit(kTrappedExit);
}

sock_filter load(std::size_t offset) { return {BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<std::uint32_t>(offset)}; }
sock_filter answer(std::uint32_t verdict) { return {BPF_RET | BPF_K, 0, 0, verdict}; }
// Skips so many of what follows unless the word loaded last is `value`.
sock_filter unless(std::uint32_t value, std::uint8_t skip) { return {BPF_JMP | BPF_JEQ | BPF_K, 0, skip, value}; }

std::vector<sock_filter> filterFor(std::span<const int> allowed) {
  std::vector<sock_filter> filter;
  filter.push_back(load(offsetof(seccomp_data, nr)));
  for (const int call : allowed) {
    filter.push_back(unless(static_cast<std::uint32_t>(call), 1));
    filter.push_back(answer(SECCOMP_RET_ALLOW));
  }
  filter.push_back(unless(SYS_exit_group, 1));
  filter.push_back(answer(SECCOMP_RET_ALLOW));
  filter.push_back(unless(SYS_write, 3));
  filter.push_back(load(offsetof(seccomp_data, args)));  // little endian: the low half of the first
  filter.push_back(unless(STDERR_FILENO, 1));
  filter.push_back(answer(SECCOMP_RET_ALLOW));
  filter.push_back(answer(SECCOMP_RET_TRAP));
  return filter;
}

}  // namespace

bool trapsArePermitted() {
  const pid_t child = fork();
  if (child == 0) _exit(trapSystemCalls() ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool trapSystemCalls(std::span<const int> allowed) {
  if (kArchitecture == 0) return false;
  struct sigaction action {};
  action.sa_sigaction = onTrap;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
  std::vector<sock_filter> filter = filterFor(allowed);
  sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
}

}  // namespace hl
