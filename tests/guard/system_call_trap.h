// A trap for system calls, by seccomp, for tests of the real-time loops: it cannot be taken away again, so it belongs
// into a process of its own, such as that of a death test.
#pragma once

#include <span>

namespace hl {

/// What the process ends with when a trapped call is made, after a line on stderr.
inline constexpr int kTrappedExit = 91;

/// From now on, each system call of the calling thread that is not in `allowed` ends the process. exit_group() and
/// write() to stderr always pass. False: the kernel does not permit it, and nothing is trapped.
bool trapSystemCalls(std::span<const int> allowed = {});
/// Whether the kernel permits it: tried in a process of its own.
bool trapsArePermitted();

}  // namespace hl
