#include "io/sandbox.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>

namespace hl {

namespace {

// Reading, memory, time, and what the C library needs to begin, to wait and to end.
constexpr std::array kAllowed{
    SCMP_SYS(read),
    SCMP_SYS(pread64),
    SCMP_SYS(readv),
    SCMP_SYS(write),
    SCMP_SYS(writev),
    SCMP_SYS(lseek),
    SCMP_SYS(close),
    SCMP_SYS(fstat),
    SCMP_SYS(stat),
    SCMP_SYS(lstat),
    SCMP_SYS(newfstatat),
    SCMP_SYS(statx),
    SCMP_SYS(access),
    SCMP_SYS(faccessat),
    SCMP_SYS(faccessat2),
    SCMP_SYS(readlink),
    SCMP_SYS(readlinkat),
    SCMP_SYS(getcwd),
    SCMP_SYS(getdents64),
    SCMP_SYS(fadvise64),
    SCMP_SYS(mmap),
    SCMP_SYS(munmap),
    SCMP_SYS(mprotect),
    SCMP_SYS(mremap),
    SCMP_SYS(madvise),
    SCMP_SYS(brk),
    SCMP_SYS(futex),
    SCMP_SYS(rt_sigaction),
    SCMP_SYS(rt_sigreturn),
    SCMP_SYS(rt_sigprocmask),
    SCMP_SYS(sigaltstack),
    SCMP_SYS(clock_gettime),
    SCMP_SYS(gettimeofday),
    SCMP_SYS(getrandom),
    SCMP_SYS(getrusage),
    SCMP_SYS(getpid),
    SCMP_SYS(gettid),
    SCMP_SYS(getuid),
    SCMP_SYS(geteuid),
    SCMP_SYS(getgid),
    SCMP_SYS(getegid),
    SCMP_SYS(uname),
    SCMP_SYS(sysinfo),
    SCMP_SYS(sched_yield),
    SCMP_SYS(sched_getaffinity),
    SCMP_SYS(restart_syscall),
    SCMP_SYS(seccomp),  // another filter can only take away more
    SCMP_SYS(exit),
    SCMP_SYS(exit_group),
#ifdef HL_SANITIZED
    // UndefinedBehaviorSanitizer asks through a pipe whether there is an object where a virtual function is called.
    SCMP_SYS(pipe2),
#endif
};

// Flags of open() that a file could be changed with.
constexpr scmp_datum_t kChanging = O_ACCMODE | O_CREAT | O_TRUNC;

int addConditional(scmp_filter_ctx filter) {
  const auto own = static_cast<scmp_datum_t>(getpid());
  int failed = seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(open), 1, SCMP_A1(SCMP_CMP_MASKED_EQ, kChanging, 0));
  failed |= seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(openat), 1, SCMP_A2(SCMP_CMP_MASKED_EQ, kChanging, 0));
  // fdopendir() asks how a folder was opened, and has it closed on exec.
  for (const scmp_datum_t command : {F_GETFL, F_SETFD})
    failed |= seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(fcntl), 1, SCMP_A1(SCMP_CMP_EQ, command));
  // abort() and raise() signal the process itself; limits are asked for, not set.
  failed |= seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1, SCMP_A0(SCMP_CMP_EQ, own));
  failed |= seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), 1, SCMP_A2(SCMP_CMP_EQ, 0));
  return failed;
}

// The two calls have no function in the C library.
int landlockRuleset(const landlock_ruleset_attr* attributes, std::size_t size, unsigned flags) {
  return static_cast<int>(syscall(SYS_landlock_create_ruleset, attributes, size, flags));
}

}  // namespace

int closeDescriptorsBut(int kept, int file) {
  constexpr int kAboveAll = 10;  // clear of the numbers that are given anew
  const int aside = fcntl(kept, F_DUPFD, kAboveAll);
  const int file_aside = file < 0 ? -1 : fcntl(file, F_DUPFD, kAboveAll);
  const int nothing = open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, standard);
  dup2(aside, kKeptDescriptor);
  if (file_aside >= 0) dup2(file_aside, kKeptFile);
  close_range((file_aside >= 0 ? kKeptFile : kKeptDescriptor) + 1, ~0U, 0);
  return kKeptDescriptor;
}

bool allowReadingBySeccomp() {
  const std::unique_ptr<void, void (*)(void*)> filter(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release);
  if (!filter) return false;
  // All threads: a library may have started some of its own when the program began.
  int failed = seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1);
  failed |= addConditional(filter.get());
  for (const int call : kAllowed) failed |= seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, call, 0);
  return failed == 0 && seccomp_load(filter.get()) == 0;
}

bool allowReadingByLandlock() {
  const int version = landlockRuleset(nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  landlock_ruleset_attr attributes{};
  // What is handled and granted by no rule is refused.
  attributes.handled_access_fs =
      LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
      LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR |
      LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
      LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
  const int rules = landlockRuleset(&attributes, sizeof attributes, 0);
  if (rules < 0) return false;
  const bool done = prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  close(rules);
  return done;
}

bool forbidOpening() {
  const std::unique_ptr<void, void (*)(void*)> filter(seccomp_init(SCMP_ACT_ALLOW), seccomp_release);
  if (!filter) return false;
  // The first filter has set what this attribute asks for, and forbids the call that sets it.
  int failed = seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_NNP, 0);
  failed |= seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1);
  for (const int call : {SCMP_SYS(open), SCMP_SYS(openat), SCMP_SYS(openat2)})
    failed |= seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EACCES), call, 0);
  return failed == 0 && seccomp_load(filter.get()) == 0;
}

bool allowReadingOnly() {
  const bool landlock = allowReadingByLandlock();  // first: the filter would refuse its calls
  return allowReadingBySeccomp() || landlock;
}

}  // namespace hl
