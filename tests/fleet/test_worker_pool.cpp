// Workers: every task is done once, whatever becomes of the process that does it, and none is left behind.
#include "fleet/worker_pool.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <map>

#include "base/error.h"
#include "temp_folder.h"

namespace hl::test_worker_pool {
namespace {

struct Outcome {
  std::map<std::size_t, std::string> failures;  // of each task, empty where it succeeded
  std::size_t waits = 0;
};

// Tasks by their first words; names are their numbers.
Outcome run(const std::vector<std::string>& tasks, int jobs) {
  Outcome outcome;
  FleetCallbacks callbacks;
  callbacks.order = [&](std::size_t i) {
    return FleetOrderText{std::to_string(i), {tasks[i]}, i % 2 == 1, "scene", "path"};
  };
  callbacks.done = [&](std::size_t i, const std::string& failure) {
    EXPECT_TRUE(outcome.failures.emplace(i, failure).second) << i;
  };
  callbacks.wait = [&] { ++outcome.waits; };
  runWorkers({WORKER_PROGRAM, {"worker", test::tempFolder().string()}}, jobs, tasks.size(), callbacks);
  return outcome;
}

struct Written {
  int rows = -1, id = 0, parent = 0;
};

Written writtenBy(std::size_t task) {
  Written written;
  std::ifstream(test::tempFile(std::to_string(task))) >> written.rows >> written.id >> written.parent;
  return written;
}

TEST(Workers, DoEveryTaskOnce) {
  for (const int jobs : {1, 2, 8, 100}) {
    const std::vector<std::string> tasks(50, "work");
    const Outcome outcome = run(tasks, jobs);
    EXPECT_EQ(outcome.failures.size(), tasks.size());
    std::map<int, int> by;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      EXPECT_EQ(outcome.failures.at(i), "");
      EXPECT_EQ(writtenBy(i).rows, i % 2);
      EXPECT_EQ(writtenBy(i).parent, getpid());
      ++by[writtenBy(i).id];
    }
    EXPECT_LE(by.size(), static_cast<std::size_t>(jobs));
    for (const auto& [id, count] : by) EXPECT_TRUE(kill(id, 0) != 0 && errno == ESRCH) << "left behind";
  }
}

TEST(Workers, TakeNoMoreThanTheirOwnTaskWithThem) {
  std::vector<std::string> tasks(40, "work");
  tasks[3] = "fail";
  tasks[7] = tasks[8] = tasks[39] = "die";
  tasks[20] = "leave";
  tasks[21] = "memory";
  for (const int jobs : {1, 3}) {
    const Outcome outcome = run(tasks, jobs);
    ASSERT_EQ(outcome.failures.size(), tasks.size());
    EXPECT_EQ(outcome.failures.at(3), "it is broken");  // one line
    for (const std::size_t died : {7, 8, 39})
      EXPECT_EQ(outcome.failures.at(died), "its process was ended by signal 9 (Killed): last words");
    EXPECT_NE(outcome.failures.at(20).find("its process ended with code 3"), std::string::npos);
    EXPECT_EQ(outcome.failures.at(21), "needs more memory than there is");
    std::size_t succeeded = 0;
    for (const auto& [task, failure] : outcome.failures) succeeded += failure.empty() ? 1 : 0;
    EXPECT_EQ(succeeded, tasks.size() - 6);
  }
}

TEST(Workers, ThatCannotBeStartedAreAnError) {
  FleetCallbacks callbacks;
  EXPECT_THROW(runWorkers({"/nonexistent/worker", {"worker"}}, 2, 5, callbacks), Error);
}

}  // namespace
}  // namespace hl::test_worker_pool
