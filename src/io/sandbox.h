// Sandbox: takes from this process, for good, what a parser of foreign files has no use for.
#pragma once

namespace hl {

/// Keeps standard input and outputs, as /dev/null, and `kept`, which becomes number kKeptDescriptor. Returns that. A
/// `file`, if there is one, becomes number kKeptFile.
int closeDescriptorsBut(int kept, int file = -1);
inline constexpr int kKeptDescriptor = 3, kKeptFile = 4;

/// Only system calls that read files, manage memory, and write to what is open: nothing can be opened for writing, no
/// socket, process or thread be made, no other process be touched. What is not allowed fails with EPERM. False where
/// the kernel has no seccomp filters.
bool allowReadingBySeccomp();
/// Files can be read, and neither written, made, removed nor run. False where it
/// has no Landlock.
bool allowReadingByLandlock();
/// Both, as far as the kernel has them; false where it has neither.
bool allowReadingOnly();
/// After one of them: nothing can be opened any more; what is open can still be read. False where the kernel has no
/// seccomp filters.
bool forbidOpening();
inline constexpr const char* kNoFilters = "this kernel cannot keep its reader from other files: it has no seccomp";

}  // namespace hl
