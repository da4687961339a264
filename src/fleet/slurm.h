// A sweep as jobs of Slurm (22.05 and later): an array job, whose parts each do every so-manieth task, and one job
// after it that writes the table and the manifest.
#pragma once

#include <string>
#include <vector>

namespace hl {

struct SlurmSweep {
  std::vector<std::string> command;  ///< program and words of the sweep, that every job calls with more words
  std::string name;                  ///< of the jobs
  std::string folder;                ///< an absolute path; the jobs' logs go to FOLDER/slurm
  std::string options;               ///< for sbatch, as in a shell
  std::size_t parts = 1;
};

struct SlurmJobs {
  std::string array, last;  ///< their numbers
};

/// The commands that submit() runs: the array, and the last one with ARRAY in place of its number. For the shell.
std::vector<std::string> slurmCommands(const SlurmSweep& sweep);
/// Throws hl::Error where Slurm refuses.
SlurmJobs submitToSlurm(const SlurmSweep& sweep);

}  // namespace hl
