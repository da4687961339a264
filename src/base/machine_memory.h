// How much memory this process may use: the machine's, or less where it runs in a container or a service with a limit.
#pragma once

#include <cstdint>
#include <istream>
#include <string>

namespace hl {

/// Bytes; reads files, never called by a real-time thread.
std::uint64_t machineMemory_bytes();

/// The path of the process's own group in the text of /proc/self/cgroup (version 2), "" where there is none.
std::string memoryGroup(std::istream& cgroup);

/// The least of the limits of `group` and the groups that it is in, by their memory.max below `root`; `most` where none
/// is less.
std::uint64_t memoryOfGroup(const std::string& root, std::string group, std::uint64_t most);

}  // namespace hl
