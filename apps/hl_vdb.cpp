// hl-vdb: reads an OpenVDB or a NanoVDB file for hl, in a process of its own.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "io/isolated.h"
#include "io/sandbox.h"
#include "io/vdb_file.h"
#include "vdb/read_vdb.h"
#include "vdb/vdb_grids.h"

namespace {

hl::SceneModel parse(const hl::VdbTask& task, const hl::ReadingReport& report) {
  const std::string path = "/proc/self/fd/" + std::to_string(hl::kKeptFile);
  hl::giveVolume(*hl::readVdbGrid({path, task.ending, true}, task.grid), report.volume());
  return {};
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only when not even stderr can be written
int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 1 && words[0] == "--version") {
    fmt::print("hl-vdb {}\n", HL_VERSION);
    return 0;
  }
  // A reader without rights can start no threads.
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  try {
    const hl::VdbTask task = hl::vdbTaskOf(words);
    hl::answerAsProgram({}, [&](const hl::ReadingReport& report) { return parse(task, report); });
  } catch (const hl::Error& error) {
    fmt::print(stderr, "hl-vdb: {}\n", error.what());
    return 2;
  }
}
