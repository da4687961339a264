// hl as a user calls it: exit codes, one-line errors, help, and a trace from file to file.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>

#include "temp_folder.h"

namespace {

struct Result {
  int code;
  std::string output;  // stdout and stderr together
};

Result call(const std::string& arguments) {
  std::FILE* pipe = popen((std::string(HL_PROGRAM) + " " + arguments + " 2>&1").c_str(), "r");
  Result result{};
  char buffer[4096];
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe)) result.output.append(buffer, got);
  const int status = pclose(pipe);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

TEST(Command, HelpForEachCommand) {
  for (const char* command : {"", "touch", "trace", "info", "doctor", "bench"}) {
    const Result result = call(std::string(command) + " --help");
    EXPECT_EQ(result.code, 0) << command;
    EXPECT_NE(result.output.find("Usage"), std::string::npos) << command;
  }
}

TEST(Command, BadInputIsOneLineAndExitCodeTwo) {
  const std::string path = hl::test::fileWith("hl_cmd_path.csv", "t,x,y,z\n0,0,0,0.2\n0.001,0,0,0.1\n");
  const std::string bad = hl::test::fileWith("hl_cmd_bad.csv", "t,x,y,z\n0,0,nan,0.2\n");
  const std::string out = hl::test::tempFile("hl_cmd_out.csv");
  for (const std::string& arguments :
       {std::string(""), std::string("fly"), std::string("info"), std::string("info nosuch"),
        std::string("info /nonexistent.obj"), "trace teapot --path " + bad + " --out " + out,
        "trace teapot --path /nonexistent.csv --out " + out,
        "trace teapot --path " + path + " --out /nonexistent/o.csv", "trace teapot --path " + path,
        "trace teapot --radius -1 --path " + path + " --out " + out,
        "trace teapot --radius nan --path " + path + " --out " + out,
        "trace teapot --kp x --path " + path + " --out " + out,
        "trace teapot --hierarchy octree --path " + path + " --out " + out,
        "trace teapot --stiffness 2 --path " + path + " --out " + out, std::string("touch --port 70000"),
        std::string("touch --hand weak"), std::string("bench --most 1")}) {
    const Result result = call(arguments);
    EXPECT_EQ(result.code, 2) << arguments << "\n" << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << arguments << "\n" << result.output;
  }
}

TEST(Command, TraceWritesOneRowForEachRow) {
  const std::string path = hl::test::fileWith("hl_cmd_path2.csv", "t,x,y,z\n0,0,0.2,0\n0.001,0,0.1,0\n0.002,0,0,0\n");
  const std::string out = hl::test::tempFile("hl_cmd_out2.csv");
  for (const char* hierarchy : {"bvh", "spheres", "none"}) {
    const Result result =
        call("trace sphere:2000 --hierarchy " + std::string(hierarchy) + " --path " + path + " --out " + out);
    ASSERT_EQ(result.code, 0) << result.output;
    std::ifstream in(out);
    std::string line;
    int lines = 0;
    while (std::getline(in, line)) ++lines;
    EXPECT_EQ(lines, 4);
  }
}

TEST(Command, TouchServesAndEndsByItself) {
  const Result result = call("touch plane:200 --port 0 --no-open --duration 0.5");
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find("page: http://127.0.0.1:"), std::string::npos) << result.output;
}

TEST(Command, TouchEndsWithCodeZeroOnTermination) {
  const Result result =
      call("touch plane:200 --port 0 --no-open & pid=$!; sleep 1; kill -TERM $pid; wait $pid; exit $?");
  EXPECT_EQ(result.code, 0) << result.output;
}

}  // namespace
