// Whole runs of bytes to and from a file descriptor, in as many system calls as it takes.
#pragma once

#include <cstddef>

namespace hl {

/// False where it fails (errno says why) or takes no more.
bool writeWhole(int descriptor, const void* data, std::size_t bytes);
/// False where it fails (errno says why) or ends before.
bool readWhole(int descriptor, void* data, std::size_t bytes);

}  // namespace hl
