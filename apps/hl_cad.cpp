// hl-cad: reads a CAD file for hl, in a process of its own.
#include <fmt/core.h>

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "cad/cad_mesh.h"
#include "cad/read_cad_shape.h"
#include "io/cad_file.h"
#include "io/isolated.h"
#include "io/sandbox.h"

namespace {

hl::SceneModel parse(const hl::CadTask& task, const hl::ReadingReport& report) {
  constexpr double kReadPart = 0.3;  // of the time, before the mesh is made
  const std::string path = "/proc/self/fd/" + std::to_string(hl::kKeptFile);
  const hl::CadShape cad = hl::readCadShape({path, task.ending, true}, [&](double part) { report(kReadPart * part); });
  hl::Model model =
      hl::meshCad(cad.shape, task.meshing, [&](double part) { report(kReadPart + (1 - kReadPart) * part); });
  model.warnings.insert(model.warnings.end(), cad.warnings.begin(), cad.warnings.end());
  return model;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only when not even stderr can be written
int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 1 && words[0] == "--version") {
    fmt::print("hl-cad {}\n", HL_VERSION);
    return 0;
  }
  try {
    const hl::CadTask task = hl::cadTaskOf(words);
    hl::answerAsProgram({}, [&](const hl::ReadingReport& report) { return parse(task, report); });
  } catch (const hl::Error& error) {
    fmt::print(stderr, "hl-cad: {}\n", error.what());
    return 2;
  }
}
