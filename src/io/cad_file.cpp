#include "io/cad_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "base/error.h"
#include "io/reading_cache.h"
#include "io/reading_program.h"

namespace hl {

namespace {

constexpr const char* kCadProgram = "hl-cad";
constexpr const char* kNoCadProgram =
    "CAD files are read by hl-cad, which is not here: install the package hl-cad, or run scripts/deps --cad and "
    "scripts/build";
constexpr const char *kAsked = "as-asked", *kUnasked = "or-coarser";
constexpr std::array kCadEndings{".step", ".stp", ".iges", ".igs", ".brep"};

double numberOf(const std::string& word, double least, double most) {
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [at, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || at != end || !(value >= least && value <= most))
    throw Error("'" + word + "' is no number");
  return value;
}

}  // namespace

bool readsCad(const std::string& ending) {
  return std::find(kCadEndings.begin(), kCadEndings.end(), ending) != kCadEndings.end();
}

std::vector<std::string> wordsOf(const std::string& ending, const CadMeshing& meshing) {
  return {"--read", ending, fmt::format("{}", meshing.deflection_m), fmt::format("{}", meshing.angle_rad),
          meshing.asked ? kAsked : kUnasked};
}

CadTask cadTaskOf(const std::vector<std::string>& words) {
  const bool sound = words.size() == 5 && (words[4] == kAsked || words[4] == kUnasked);
  if (!sound || words[0] != "--read" || !readsCad(words[1]))
    throw Error("hl-cad reads CAD files for hl, which starts it by itself: try hl touch part.step");
  return {words[1],
          {numberOf(words[2], kMinDeflection_m, kMaxDeflection_m), numberOf(words[3], kMinAngle_rad, kMaxAngle_rad),
           words[4] == kAsked}};
}

SceneModel readCad(int descriptor, const std::string& name, const CadTask& task, const IsolationLimits& limits,
                   const std::atomic<bool>& given_up, const std::function<void(double)>& progress) {
  ReaderProgram program{"", {kCadProgram}};
  std::string options;
  for (const std::string& word : wordsOf(task.ending, task.meshing)) {
    program.words.push_back(word);
    options += word + " ";
  }
  const ReadingCache cache(cacheFolder());
  const std::string key = cache.keyOf(descriptor, options);
  if (std::optional<SceneModel> kept = cache.find(key, limits)) return std::move(*kept);
  program.file = readingProgram(kCadProgram, name + ": " + kNoCadProgram);
  SceneModel scene = runProgram(name, limits, program, descriptor, given_up, progress);
  cache.keep(key, scene);
  return scene;
}

}  // namespace hl
