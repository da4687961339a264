#include "io/load_sent.h"

#include <sys/stat.h>

#include <utility>

#include "base/error.h"
#include "io/file_ending.h"
#include "io/load_model.h"
#include "io/load_scene_file.h"
#include "io/sandbox.h"
#include "io/vdb_file.h"

namespace hl {

namespace {

constexpr const char* kSceneEnding = ".hl.json";

std::string pathOfSent() { return "/proc/self/fd/" + std::to_string(kKeptFile); }

SceneModel parseSent(const std::string& name, const ReadingReport& report) {
  const std::string ending = sentEndingOf(name);
  if (ending != kSceneEnding) return parseModel({pathOfSent(), ending, true, false, name}, report);
  LoadOptions options;
  options.alone = true;
  return loadSceneFile(pathOfSent(), options);
}

}  // namespace

std::string sentEndingOf(const std::string& name) {
  const std::string ending = endingOf(name);
  if (ending != ".json") return ending;
  const std::string stem = name.substr(0, name.size() - ending.size());
  return endingOf(stem) + ending;
}

bool readsSent(const std::string& ending) { return ending == kSceneEnding || readsEnding(ending); }

SceneModel loadSent(int descriptor, const std::string& name, ReaderProgram program, const IsolationLimits& limits,
                    const std::atomic<bool>& given_up, const CadMeshing& cad) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || status.st_size == 0) throw Error(name + ": is empty");
  const std::string ending = sentEndingOf(name);
  if (!readsSent(ending)) throw Error(name + ": " + cannotBeRead(ending));
  program.words.push_back(name);
  const auto read = [&] {
    if (readsCad(ending)) return readCad(descriptor, name, {ending, cad}, limits, given_up, {});
    if (readsVdb(ending)) return readVdb(descriptor, name, {ending, ""}, limits, given_up, {});
    return runProgram(name, limits, program, descriptor, given_up);
  };
  SceneModel scene = read();
  if (elementsIn(scene) == 0) throw Error(name + ": there is no geometry in it");
  scene.model.name = name;
  for (SceneSurface& surface : scene.surfaces) {
    if (surface.name.empty()) surface.name = name;
  }
  return scene;
}

void readSent(const std::string& name) {
  answerAsProgram({}, [&](const auto& report) { return parseSent(name, report); });
}

}  // namespace hl
