// hl-cad: reads a CAD file for hl, in a process of its own.

#include <string>

#include "base/program_main.h"
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
  hl::Model model = hl::meshCad(cad, task.meshing, [&](double part) { report(kReadPart + (1 - kReadPart) * part); });
  model.warnings.insert(model.warnings.end(), cad.warnings.begin(), cad.warnings.end());
  return model;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only when not even stderr can be written
int main(int argc, char** argv) {
  return hl::programMain("hl-cad", HL_VERSION, {argv, static_cast<std::size_t>(argc)}, [](const auto& words) {
    const hl::CadTask task = hl::cadTaskOf(words);
    hl::answerAsProgram({}, [&](const hl::ReadingReport& report) { return parse(task, report); });
  });
}
