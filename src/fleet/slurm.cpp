#include "fleet/slurm.h"

#include <fmt/core.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "base/text.h"

namespace hl {

namespace {

constexpr const char* kArrayNumber = "ARRAY";

// For the shell, whatever is in it.
std::string shellWord(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shellLine(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shellWord(word);
  return line;
}

// `more` is for the shell of the job, which knows its number in the array.
std::string sbatchLine(const SlurmSweep& sweep, const std::vector<std::string>& words, const std::string& more) {
  std::vector<std::string> all{"sbatch", "--parsable", "--requeue", "--job-name=" + sweep.name};
  all.insert(all.end(), words.begin(), words.end());
  const std::string job = "exec " + shellLine(sweep.command) + " " + more;
  return shellLine(all) + " " + (sweep.options.empty() ? "" : sweep.options + " ") + shellWord("--wrap=" + job);
}

// Gives the first word of what sbatch prints, the number of the job; with clusters "NUMBER;CLUSTER".
std::string submit(const std::string& line) {
  std::FILE* pipe = popen((line + " 2>&1").c_str(), "re");
  if (pipe == nullptr) throw Error(std::string("sbatch cannot be run: ") + std::strerror(errno));
  std::string output;
  char buffer[4096];
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, got);
  const int status = pclose(pipe);
  const std::string first = output.substr(0, output.find_first_of(";\n"));
  const bool number = !first.empty() && std::all_of(first.begin(), first.end(), [](char c) { return isDigit(c); });
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    throw Error("there is no sbatch here: install slurm-client, or leave --slurm out");
  if (status != 0 || !number) throw Error("Slurm takes no job: " + output.substr(0, output.find('\n')));
  return first;
}

}  // namespace

std::vector<std::string> slurmCommands(const SlurmSweep& sweep) {
  const std::string logs = sweep.folder + "/slurm/";
  const std::string part = fmt::format("--part \"$SLURM_ARRAY_TASK_ID/{}\"", sweep.parts);
  return {sbatchLine(sweep, {fmt::format("--array=0-{}", sweep.parts - 1), "--output=" + logs + "%A_%a.log"}, part),
          sbatchLine(sweep, {std::string("--dependency=afterany:") + kArrayNumber, "--output=" + logs + "%j.log"},
                     "--finish")};
}

SlurmJobs submitToSlurm(const SlurmSweep& sweep) {
  std::error_code failed;
  std::filesystem::create_directories(sweep.folder + "/slurm", failed);
  if (failed) throw Error(sweep.folder + "/slurm: cannot be made: " + failed.message());
  const std::vector<std::string> commands = slurmCommands(sweep);
  SlurmJobs jobs;
  jobs.array = submit(commands[0]);
  std::string last = commands[1];
  const std::string after = "--dependency=afterany:";
  last.replace(last.find(after) + after.size(), std::strlen(kArrayNumber), jobs.array);
  jobs.last = submit(last);
  return jobs;
}

}  // namespace hl
