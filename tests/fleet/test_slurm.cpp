// What is submitted to Slurm, with a program in the place of sbatch that writes down how it was called. A Slurm that
// runs is met by run_slurm.py.
#include "fleet/slurm.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <sstream>

#include "base/error.h"
#include "temp_folder.h"

namespace hl::test_slurm {
namespace {

// `ending`: what it does after writing each of its words to a line of the file "calls".
void putInPlaceOfSbatch(const std::string& ending) {
  const std::string file = test::fileWith("sbatch", "#!/bin/sh\nfor word in \"$@\"; do printf '%s\\n' \"$word\" >> '" +
                                                        test::tempFile("calls") + "'; done\n" + ending + "\n");
  chmod(file.c_str(), 0755);
  setenv("PATH", (test::tempFolder().string() + ":/usr/bin:/bin").c_str(), 1);
}

std::string calls() {
  std::ostringstream text;
  text << std::ifstream(test::tempFile("calls")).rdbuf();
  return text.str();
}

SlurmSweep sample() {
  SlurmSweep sweep;
  sweep.command = {"/opt/a b/hl", "sweep", "it's.toml"};
  sweep.name = "hl-x";
  sweep.folder = test::tempFile("out folder");
  sweep.options = "--partition=short --comment='two words'";
  sweep.parts = 7;
  return sweep;
}

TEST(SlurmSweeps, AreAnArrayAndAJobAfterIt) {
  putInPlaceOfSbatch("echo '41;cluster'");
  const SlurmJobs jobs = submitToSlurm(sample());
  EXPECT_EQ(jobs.array, "41");
  EXPECT_EQ(jobs.last, "41");
  EXPECT_TRUE(std::filesystem::is_directory(test::tempFile("out folder/slurm")));
  const std::string logs = test::tempFile("out folder/slurm/"), command = "exec '/opt/a b/hl' 'sweep' 'it'\\''s.toml' ";
  EXPECT_EQ(calls(), "--parsable\n--requeue\n--job-name=hl-x\n--array=0-6\n--output=" + logs +
                         "%A_%a.log\n--partition=short\n--comment=two words\n--wrap=" + command +
                         "--part \"$SLURM_ARRAY_TASK_ID/7\"\n"
                         "--parsable\n--requeue\n--job-name=hl-x\n--dependency=afterany:41\n--output=" +
                         logs + "%j.log\n--partition=short\n--comment=two words\n--wrap=" + command + "--finish\n");
}

std::string faultOfSubmitting() {
  try {
    submitToSlurm(sample());
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(SlurmSweeps, ReportWhatSlurmSays) {
  putInPlaceOfSbatch("echo 'sbatch: error: no such partition' >&2; exit 1");
  EXPECT_EQ(faultOfSubmitting(), "Slurm takes no job: sbatch: error: no such partition");
  putInPlaceOfSbatch("echo hello");
  EXPECT_EQ(faultOfSubmitting(), "Slurm takes no job: hello");
}

TEST(SlurmSweeps, SayWhereThereIsNoSlurm) {
  setenv("PATH", "/nonexistent", 1);
  EXPECT_NE(faultOfSubmitting().find("there is no sbatch here"), std::string::npos);
}

}  // namespace
}  // namespace hl::test_slurm
