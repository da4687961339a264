#include "io/vdb_file.h"

#include "base/error.h"
#include "io/reading_program.h"

namespace hl {

namespace {

constexpr const char* kVdbProgram = "hl-vdb";
constexpr const char* kNoVdbProgram =
    "OpenVDB files are read by hl-vdb, which is not here: install the package hl-vdb, or run scripts/deps --vdb and "
    "scripts/build";

}  // namespace

bool readsVdb(const std::string& ending) { return ending == ".vdb" || ending == ".nvdb"; }

std::vector<std::string> wordsOf(const VdbTask& task) { return {"--read", task.ending, task.grid}; }

VdbTask vdbTaskOf(const std::vector<std::string>& words) {
  if (words.size() != 3 || words[0] != "--read" || !readsVdb(words[1]))
    throw Error("hl-vdb reads OpenVDB files for hl, which starts it by itself: try hl touch bunny.vdb");
  return {words[1], words[2]};
}

SceneModel readVdb(int descriptor, const std::string& name, const VdbTask& task, const IsolationLimits& limits,
                   const std::atomic<bool>& given_up, const std::function<void(double)>& progress) {
  ReaderProgram program{"", {kVdbProgram}};
  for (const std::string& word : wordsOf(task)) program.words.push_back(word);
  program.file = readingProgram(kVdbProgram, name + ": " + kNoVdbProgram);
  return runProgram(name, limits, program, descriptor, given_up, progress);
}

}  // namespace hl
