#include "base/machine_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace hl {

std::string memoryGroup(std::istream& cgroup) {
  std::string line;
  while (std::getline(cgroup, line)) {
    if (line.starts_with("0::/")) return line.substr(3);
  }
  return {};
}

std::uint64_t memoryOfGroup(const std::string& root, std::string group, std::uint64_t most) {
  while (true) {
    std::uint64_t limit = 0;
    std::ifstream file(root + group + "/memory.max");  // a number, or "max"
    if (file >> limit) most = std::min(most, limit);
    if (group.empty()) return most;
    group.resize(group.find_last_of('/') == std::string::npos ? 0 : group.find_last_of('/'));
  }
}

std::uint64_t machineMemory_bytes() {
  const auto installed =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  std::ifstream cgroup("/proc/self/cgroup");
  const std::uint64_t granted = memoryOfGroup("/sys/fs/cgroup", memoryGroup(cgroup), installed);
  rlimit own{};  // as `ulimit -v` sets it
  return getrlimit(RLIMIT_AS, &own) == 0 ? std::min<std::uint64_t>(granted, own.rlim_cur) : granted;
}

}  // namespace hl
