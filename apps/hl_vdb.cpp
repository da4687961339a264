// hl-vdb: reads an OpenVDB or a NanoVDB file for hl, in a process of its own.
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <string>

#include "base/error.h"
#include "base/program_main.h"
#include "io/isolated.h"
#include "io/sandbox.h"
#include "io/vdb_file.h"
#include "vdb/read_vdb.h"
#include "vdb/vdb_grids.h"

namespace {

// A corrupt file may ask for any memory. A leaf of 8 x 8 x 8 voxels takes 2 KB here, and in the file no less than some
// 30 bytes, if all its voxels have one value; OpenVDB keeps its parts beside.
hl::IsolationLimits limitsOf(int file) {
  constexpr std::size_t kMin_bytes = std::size_t{1} << 30, kForEachByte = 256;
  hl::IsolationLimits limits;
  struct stat status {};
  const std::size_t size = fstat(file, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
  if (size < limits.memory_bytes / kForEachByte)
    limits.memory_bytes = std::min(limits.memory_bytes, kMin_bytes + kForEachByte * size);
  return limits;
}

hl::SceneModel parse(const hl::VdbTask& task, const hl::ReadingReport& report) {
  const std::string path = "/proc/self/fd/" + std::to_string(hl::kKeptFile);
  hl::giveVolume(*hl::readVdbGrid({path, task.ending, true}, task.grid), report.volume());
  return {};
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only when not even stderr can be written
int main(int argc, char** argv) {
  return hl::programMain("hl-vdb", HL_VERSION, {argv, static_cast<std::size_t>(argc)}, [](const auto& words) {
    const hl::VdbTask task = hl::vdbTaskOf(words);
    const hl::IsolationLimits limits = limitsOf(STDIN_FILENO);
    hl::answerAsProgram(limits, [&](const hl::ReadingReport& report) {
      try {
        return parse(task, report);
      } catch (const std::bad_alloc&) {
        throw hl::Error(fmt::format("is corrupt, or too large: it takes more than {:.1f} GB to read",
                                    1e-9 * static_cast<double>(limits.memory_bytes)));
      }
    });
  });
}
