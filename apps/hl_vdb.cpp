// hl-vdb: reads an OpenVDB or a NanoVDB file for hl, in a process of its own.
#include <string>

#include "io/isolated.h"
#include "io/reading_program.h"
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
  return hl::readingMain("hl-vdb", HL_VERSION, {argv, static_cast<std::size_t>(argc)}, [](const auto& words) {
    const hl::VdbTask task = hl::vdbTaskOf(words);
    hl::answerAsProgram({}, [&](const hl::ReadingReport& report) { return parse(task, report); });
  });
}
