// hl as a user calls it: exit codes, one-line errors, help, and a trace from file to file.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "temp_folder.h"

namespace hl::test_command {
namespace {

struct Result {
  int code;
  std::string output;  // stdout and stderr together
};

Result run(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  Result result{};
  char buffer[4096];
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe)) result.output.append(buffer, got);
  const int status = pclose(pipe);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

Result call(const std::string& arguments) { return run(std::string(HL_PROGRAM) + " " + arguments); }

std::string constantVolume() {
  return hl::test::fileWith("hl_cmd_constant.nrrd",
                            "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 2\nspacings: 1 1 "
                            "1\nendian: little\nencoding: raw\n\n" +
                                std::string(32, '\0'));
}

TEST(Command, AVolumeWithoutASurfaceSaysWhatItsValuesAre) {
  const Result info = call("info " + constantVolume());
  EXPECT_NE(info.output.find("nrrd: all values of the volume are 0: it has no surface"), std::string::npos)
      << info.output;
  EXPECT_EQ(info.output.find("hl_cmd_constant.nrrd: hl_cmd_constant.nrrd:"), std::string::npos) << info.output;
  EXPECT_NE(info.output.find("surface at 0, matter above; 0 triangles"), std::string::npos) << info.output;
  const Result other = call("info ct:phantom:41 --iso 50000");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.output.find("there is no surface at iso 50000: its values are from -1000 to "), std::string::npos)
      << other.output;
  EXPECT_EQ(call("info ct:phantom:41 --iso -1000").code, 2) << "nothing is below its least value";
  EXPECT_EQ(call("info ct:phantom:41 --iso -1000 --below").code, 0);
  EXPECT_EQ(call("info --iso -480,300 ct:phantom:41").code, 0) << "a scene may follow the values";
}

TEST(Command, AWordThatIsNoneOfAnOptionIsReportedWithThoseThatAre) {
  const std::string trace = "trace teapot --path " + hl::test::fileWith("p.csv", "t,x,y,z\n0,0,1,0\n") + " --out " +
                            hl::test::tempFile("o.csv") + " ";
  EXPECT_EQ(call(trace + "--shade smooth --ledger report --textures off").code, 0);
  for (const auto& [option, line] :
       {std::pair{"--shade WRONG", "--shade: 'WRONG' is none of flat, smooth (try --help)"},
        {"--shade 1", "--shade: '1' is none of flat, smooth (try --help)"},
        {"--ledger 1", "--ledger: '1' is none of report, strict, tank (try --help)"},
        {"--textures maybe", "--textures: 'maybe' is none of off, on (try --help)"},
        {"--kp 1 --kp 2", "--kp is given 2 times: give it once (try --help)"},
        {"--fitt 2", "there is no option '--fitt' here (try --help)"},
        {"walker", "'walker' is too much here (try --help)"},
        {"--iso x", "--iso: 'x' is not a number (try --help)"},
        {"--iso 300,nan", "--iso: 'nan' is not a number (try --help)"},
        {"--kp", "--kp needs a value (try --help)"}}) {
    const Result result = call(trace + option);
    EXPECT_EQ(result.code, 2) << option;
    EXPECT_EQ(result.output, std::string("hl: ") + line + "\n");
  }
}

TEST(Command, AWordOfAnyLengthIsAnError) { EXPECT_EQ(call("touch --" + std::string(100'000, 'x')).code, 2); }

TEST(Command, WhatIsNoFileIsNotWaitedFor) {
  std::filesystem::create_symlink("circle", hl::test::tempFile("circle"));
  const std::string trace = "trace teapot --out " + hl::test::tempFile("o.csv") + " --path ";
  for (const std::string& one : {std::string("info "), std::string("sweep "), trace}) {
    for (const std::string& file : {std::string("/dev/zero"), hl::test::tempFile("circle")}) {
      const Result result = call(one + file);
      EXPECT_EQ(result.code, 2) << one;
      EXPECT_TRUE(result.output.starts_with("hl: " + file + ": ")) << result.output;
    }
  }
  const std::string sweep = hl::test::fileWith("s.toml", "scenes = \"/dev/zero\"\npaths = \"/dev/zero\"\n");
  EXPECT_EQ(call("sweep " + sweep).output, "hl: /dev/zero: is not a file\n");
}

TEST(Command, HelpForEachCommand) {
  for (const char* command :
       {"", "touch", "trace", "info", "doctor", "bench", "record", "replay", "stability", "sweep", "keys"}) {
    const Result result = call(std::string(command) + " --help");
    EXPECT_EQ(result.code, 0) << command;
    EXPECT_NE(result.output.find("Usage"), std::string::npos) << command;
  }
}

std::string contentOf(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Command, KeysAreMadeOnceForEachName) {
  const std::string folder = hl::test::tempFile("hl_cmd_keys");
  const Result made = call("keys " + folder + " --name lab/hand --name /console --domain 5");
  EXPECT_EQ(made.code, 0);
  EXPECT_NE(made.output.find("/enclaves/lab/hand: keys for domain 5\n"), std::string::npos) << made.output;
  EXPECT_NE(contentOf(folder + "/enclaves/console/permissions.p7s").find("<id>5</id>"), std::string::npos);
  const std::string key = contentOf(folder + "/enclaves/console/key.pem");
  for (const char* words : {" --name console", " --name con-sole", " --name camera --domain 231", ""}) {
    const Result refused = call("keys " + folder + words);
    EXPECT_EQ(refused.code, 2) << words;
    EXPECT_EQ(std::count(refused.output.begin(), refused.output.end(), '\n'), 1) << refused.output;
  }
  EXPECT_EQ(contentOf(folder + "/enclaves/console/key.pem"), key);
  EXPECT_EQ(call("keys " + folder + " --name camera").code, 0);
}

// Whether it passes depends on what else the machine does meanwhile: tests/tools/test_self_test.cpp has that.
TEST(Command, DoctorTestsADeviceAndWritesAReport) {
  const std::string report = hl::test::tempFile("doctor.json");
  const Result result = call("doctor sim --self-test --report " + report);
  EXPECT_LE(result.code, 1) << result.output;
  for (const char* part : {"locale: ", "ready: ", "self-test: ", "pull +1", "verdict: ", "servo rate: ", "report: "})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << result.output;
  const std::string written = contentOf(report);
  for (const char* key : {"hl_doctor", "machine", "findings", "self_test", "passed", "pulls"})
    EXPECT_NE(written.find(key), std::string::npos) << key << written;
}

TEST(Command, DoctorsReportNamesNobody) {
  const std::string report = hl::test::tempFile("doctor_names.json");
  setenv("HL_DHD_LIBRARY", "/home/anna/sdk/libdhd.so.3", 1);
  const Result result = call("doctor dhd --report " + report);
  unsetenv("HL_DHD_LIBRARY");
  EXPECT_EQ(result.code, 1);
  const std::string written = contentOf(report);
  EXPECT_NE(written.find("~/sdk/libdhd.so.3"), std::string::npos) << written;
  EXPECT_EQ(written.find("anna"), std::string::npos) << written;
}

TEST(Command, BadInputIsOneLineAndExitCodeTwo) {
  const std::string path = hl::test::fileWith("hl_cmd_path.csv", "t,x,y,z\n0,0,0,0.2\n0.001,0,0,0.1\n");
  const std::string bad = hl::test::fileWith("hl_cmd_bad.csv", "t,x,y,z\n0,0,nan,0.2\n");
  const std::string out = hl::test::tempFile("hl_cmd_out.csv");
  for (const std::string& arguments :
       {std::string(""),
        std::string("fly"),
        std::string("info"),
        std::string("info nosuch"),
        std::string("doctor theremin"),
        std::string("doctor --self-test"),
        std::string("doctor sim --report /nonexistent/report.json"),
        std::string("info /nonexistent.obj"),
        std::string("info '/nonexistent\x1b[31m\n.obj'"),
        "trace teapot --path " + bad + " --out " + out,
        "trace teapot --path /nonexistent.csv --out " + out,
        "trace teapot --path " + path + " --out /nonexistent/o.csv",
        "trace teapot --path " + path,
        "trace teapot --radius -1 --path " + path + " --out " + out,
        "trace teapot --radius nan --path " + path + " --out " + out,
        "trace teapot --kp x --path " + path + " --out " + out,
        "trace teapot --hierarchy octree --path " + path + " --out " + out,
        "trace teapot --stiffness 2 --path " + path + " --out " + out,
        "trace teapot --path " + path + " --out " + path,
        std::string("trace teapot --ledger x --path a --out b"),
        std::string("record teapot --out a.hlr --max-size -1"),
        std::string("stability --quick --csv /nowhere/at/all.csv --rates 1000 --delays 0 --grips light"),
        std::string("touch --port 70000"),
        std::string("touch --hand weak"),
        std::string("touch --tool-mass 100"),
        std::string("touch --black-box /proc/none"),
        std::string("touch --black-box ''"),
        std::string("info ''"),
        std::string("touch --deflection 1e-5 --upload off"),
        std::string("touch --iso 1"),
        "trace teapot --deflection 1e-5 --path " + path + " --out " + out,
        std::string("info teapot --deflection 1e-5"),
        std::string("touch --page-dir /nonexistent"),
        std::string("touch --device theremin"),
        std::string("touch --device sim:abacus"),
        std::string("touch --device replay:/nonexistent --no-open --port 0"),
        std::string("touch --servo-rate 99"),
        std::string("touch --servo-rate lots"),
        std::string("touch --dead-man button:32"),
        std::string("touch --spring 1,2,3"),
        std::string("touch --constant-force 1,2,x"),
        std::string("touch --force-limit 0"),
        std::string("record"),
        std::string("record --out /nonexistent/a.hlr --no-open --port 0"),
        std::string("record --out " + out + " --max-size many"),
        std::string("replay"),
        std::string("replay /nonexistent"),
        "replay " + path + " --csv " + out,
        std::string("sweep"),
        std::string("sweep /nonexistent.toml"),
        "sweep " + path,
        "sweep " + path + " --jobs 0",
        std::string("bench --most 1"),
        std::string("bench --scenes teapot"),
        std::string("bench --motions flying"),
        std::string("bench --radii 1"),
        std::string("bench --ticks 0"),
        std::string("bench --scene /nonexistent.obj"),
        std::string("bench --csv /nonexistent/o.csv")}) {
    const Result result = call(arguments);
    EXPECT_EQ(result.code, 2) << arguments << "\n" << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << arguments << "\n" << result.output;
  }
}

// Each option that takes a number: what is none, or larger than any that could be meant, is refused before anything
// runs.
TEST(Command, NoOptionTakesNaNInfinityOrANumberOutOfRange) {
  const std::string path = hl::test::fileWith("hl_cmd_path.csv", "t,x,y,z\n0,0,0,0.2\n");
  const std::string surfaces = "--stiffness --static-friction --dynamic-friction --viscosity ";
  struct Options {
    std::string command, names;
  };
  for (const Options& options :
       {Options{"trace teapot --path " + path + " --out " + hl::test::tempFile("hl_cmd_out.csv"),
                surfaces + "--radius --kp --scale --fit --tremor --seed"},
        Options{"touch plane:200 --no-open --port 0 --duration 0.01",
                surfaces + "--radius --size --kp --damping --scale --servo-rate --force-limit --speed-limit "
                           "--tool-mass --free-damping --constant-force --spring"},
        Options{"touch plane:200 --no-open --port 0", "--duration --port"},
        Options{"stability", "--rates --delays --damping --jitter --body"},
        Options{"bench", "--radius --radius-edges --ticks --most"}, Options{"info teapot", "--scale --fit"}}) {
    std::istringstream names(options.names);
    for (std::string name; names >> name;) {
      for (const char* number : {"nan", "NaN", "-nan", "inf", "-inf", "1e999", "-1", "x"}) {
        const Result result = call(options.command + " " + name + "=" + number);
        EXPECT_EQ(result.code, 2) << options.command << " " << name << "=" << number << "\n" << result.output;
        EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << name << "\n" << result.output;
      }
    }
  }
  for (const char* large : {"--radius=1e200", "--kp=1e308", "--viscosity=1e308", "--static-friction=1e308"})
    EXPECT_EQ(call("trace teapot --path " + path + " --out " + hl::test::tempFile("hl_cmd_out.csv") + " " + large).code,
              2)
        << large;
}

TEST(Command, TouchRunsAtTheRateThatIsAskedForOrAtTheHighestThatIsMeasured) {
  const std::string touch = "touch plane:2000 --no-open --port 0 --duration 0.1 --servo-rate ";
  EXPECT_NE(call(touch + "2500").output.find(", 2500 Hz;"), std::string::npos);
  const Result highest = call(touch + "highest");
  EXPECT_EQ(highest.code, 0);
  EXPECT_NE(highest.output.find("000 Hz;"), std::string::npos) << highest.output;
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

TEST(Command, TraceNamesTheEndingsThatOccurred) {
  const std::string path =
      hl::test::fileWith("hl_cmd_path3.csv", "t,x,y,z\n0,0,0.3,0\n0.001,0,0.2,0\n0.002,0,0.15,0\n");
  const Result result = call("trace sphere:2000 --path " + path + " --out " + hl::test::tempFile("hl_cmd_out3.csv"));
  ASSERT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find("\nticks that ended: reached 3\n"), std::string::npos) << result.output;
}

// Field by field, the rows of a CSV file without quotes.
std::vector<std::vector<std::string>> readCsv(const std::string& name) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream in(name);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string>& row = rows.emplace_back(1);
    for (const char c : line) {
      if (c == ',') {
        row.emplace_back();
      } else {
        row.back() += c;
      }
    }
  }
  return rows;
}

TEST(Command, BenchWritesARowForEachSceneMotionAndRadius) {
  const std::string out = hl::test::tempFile("hl_cmd_bench.csv");
  const Result result = call(
      "bench --scenes terrain,rough,sphere,soup,pits --motions sliding,free,tapping,corners,tracing --radii "
      "fixed,scaled "
      "--hierarchies bvh --no-effects --most 10000 --ticks 200 --csv " +
      out);
  ASSERT_EQ(result.code, 0) << result.output;
  const auto rows = readCsv(out);
  ASSERT_EQ(rows.size(), 1u + 5 * 5 * 2 * 2);
  const std::string header =
      "scene,motion,radius,radius_m,who,question,hierarchy,surface,primitives,mean_edge_m,count,p50_us,p99_us,p999_us,"
      "max_us,single_p999_us,single_max_us,mean_us,capped,out_of_work,build_one_thread_ns,build_ns,refit_ns,"
      "index_bytes,all_bytes,to_plain,to_tick,to_query,compared,different,note";
  std::string first;
  for (const std::string& name : rows[0]) first += (first.empty() ? "" : ",") + name;
  EXPECT_EQ(first, header);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), rows[0].size());
    EXPECT_EQ(rows[i][10], "200");
    EXPECT_LE(std::stod(rows[i][11]), std::stod(rows[i][14]));
  }
}

TEST(Command, BenchMeasuresEffectsHierarchiesAndFiles) {
  const std::string out = hl::test::tempFile("hl_cmd_bench2.csv");
  const Result builtin = call("bench --most 1000 --ticks 100 --csv " + out);
  ASSERT_EQ(builtin.code, 0) << builtin.output;
  EXPECT_EQ(readCsv(out).size(), 1u + 4 + 2);  // four surfaces on the bvh, and two other hierarchies
  const std::string file =
      hl::test::fileWith("hl_cmd_bench.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 2 3\nf 1 2 4\n");
  const Result own = call("bench --scene " + file + " --hierarchies bvh --ticks 100 --csv " + out);
  ASSERT_EQ(own.code, 0) << own.output;
  const auto rows = readCsv(out);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NE(rows[1][0].find("hl_cmd_bench.obj"), std::string::npos);
  EXPECT_EQ(rows[1][8], "2");
}

TEST(Command, BenchComparesWithOthersOrSaysHowToGetThem) {
  const std::string out = hl::test::tempFile("hl_cmd_bench3.csv");
  const Result result = call("bench --peers --hierarchies bvh --no-effects --most 1000 --ticks 100 --csv " + out);
  if (result.code == 2) {
    EXPECT_NE(result.output.find("scripts/build --peers"), std::string::npos) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    return;
  }
  ASSERT_EQ(result.code, 0) << result.output;
  std::multiset<std::string> asked;
  for (const auto& row : readCsv(out)) asked.insert(row[4] + " " + row[5]);
  EXPECT_EQ(asked, (std::multiset<std::string>{"who question", "hl tick", "hl near", "hl impact", "embree near",
                                               "embree nearest", "embree finger", "cgal nearest", "cgal finger",
                                               "fcl nearest", "bullet impact"}));
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

std::string lineWith(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

TEST(Command, ARecordedSessionIsReproducedAndTabled) {
  const std::string file = hl::test::tempFile("hl_cmd_session.hlr"), csv = hl::test::tempFile("hl_cmd_steps.csv");
  const Result recorded = call("record sphere:2000 --no-open --port 0 --black-box off --duration 2 --out " + file);
  ASSERT_EQ(recorded.code, 0) << recorded.output;
  const Result replayed = call("replay " + file + " --csv " + csv);
  EXPECT_EQ(replayed.code, 0) << replayed.output;
  EXPECT_EQ(lineWith(replayed.output, "reproduced"), "reproduced: bit for bit") << replayed.output;
  const auto rows = readCsv(csv);
  ASSERT_GT(rows.size(), 1u);
  EXPECT_EQ(rows[0].size(), 24u);
  EXPECT_EQ(rows[0][0], "t");
  EXPECT_EQ(rows.back().size(), 24u);
  EXPECT_TRUE(rows[1][13] == "arming" || rows[1][13] == "fault") << rows[1][13];
  const Result again =
      call("touch terrain:2000 --no-open --port 0 --black-box off --duration 1 --device replay:" + file);
  EXPECT_EQ(again.code, 0) << again.output;
  EXPECT_NE(again.output.find("replay of simulated"), std::string::npos) << again.output;
}

TEST(Command, ARecordingThatIsCutIsReproducedOnlyWhereItHasSteps) {
  const std::string file = hl::test::tempFile("hl_cmd_cut.hlr");
  ASSERT_EQ(call("record plane:200 --no-open --port 0 --black-box off --duration 1 --out " + file).code, 0);
  std::set<int> codes;
  for (auto bytes = std::filesystem::file_size(file); bytes > 0; bytes = bytes * 3 / 4) {
    std::filesystem::resize_file(file, bytes);
    const Result replayed = call("replay " + file);
    const bool reproduced = lineWith(replayed.output, "reproduced") == "reproduced: bit for bit" &&
                            lineWith(replayed.output, " 0 servo steps, 0 ticks").empty();
    EXPECT_EQ(replayed.code, reproduced ? 0 : 2) << bytes << "\n" << replayed.output;
    codes.insert(replayed.code);
  }
  EXPECT_EQ(codes, (std::set<int>{0, 2}));
}

TEST(Command, OfSeveralDevicesEachHasItsOwnRecording) {
  const std::string file = hl::test::tempFile("hl_cmd_hands.hlr");
  const std::string left = hl::test::tempFile("hl_cmd_hands-left.hlr");
  const std::string pen = hl::test::tempFile("hl_cmd_hands-pen.hlr");
  const Result recorded = call(
      "record sphere:2000 --no-open --port 0 --black-box off --duration 1 --device sim:touch "
      "--device pen=sim --out " +
      file);
  ASSERT_EQ(recorded.code, 0) << recorded.output;
  EXPECT_NE(recorded.output.find("device: pen: simulated PHANToM"), std::string::npos) << recorded.output;
  EXPECT_NE(recorded.output.find("pen: recorded: " + pen), std::string::npos) << recorded.output;
  const Result of_left = call("replay " + left), of_pen = call("replay " + pen);
  EXPECT_EQ(of_left.code, 0) << of_left.output;
  EXPECT_NE(of_left.output.find(", left, simulated 3D Systems Touch,"), std::string::npos) << of_left.output;
  EXPECT_NE(of_pen.output.find(", pen, simulated PHANToM"), std::string::npos) << of_pen.output;
  const Result again =
      call("touch sphere:2000 --no-open --port 0 --black-box off --duration 1 --device replay:" + left +
           " --device replay:" + pen);
  EXPECT_EQ(again.code, 0) << again.output;
  EXPECT_NE(again.output.find("left: replay of simulated 3D"), std::string::npos) << again.output;
  EXPECT_EQ(call("record sphere:2000 --no-open --port 0 --device replay:" + left + " --device sim --out " + file).code,
            2)
      << "it would overwrite what it reads";
}

// A floor, and a ball and a block that fall on it.
std::string sceneWithBodies() {
  return hl::test::fileWith("hl_cmd_bodies.hl.json", R"({"gravityMS2": {"y": -5}, "objects": [
    {"name": "floor", "primitives": {"vertices": [-0.2,0,-0.2, 0.2,0,-0.2, 0.2,0,0.2, -0.2,0,0.2],
     "polygons": [{"vertices": [3, 2, 1, 0]}]}, "body": {"fixed": true}},
    {"name": "red ball", "builtin": "sphere:100", "transform": {"scale": {"x": 0.02, "y": 0.02, "z": 0.02},
     "translate": {"y": 0.03}}, "body": {"shape": "BALL", "massKg": 0.25, "restitution": 0.5}},
    {"name": "block", "builtin": "sphere:100", "transform": {"scale": {"x": 0.02, "y": 0.02, "z": 0.02},
     "translate": {"x": 0.1, "y": 0.03}}, "body": {"shape": "BOX"}}]})");
}

TEST(Command, InfoAddsUpAllObjectsAndListsBodies) {
  const Result result = call("info " + sceneWithBodies());
  EXPECT_EQ(result.code, 0);
  for (const char* part : {"body floor: fixed", "body red ball: ball, 0.25 kg", "body block: box, ", "restitution 0.5",
                           "gravity:    0 -5 0 m/s^2"})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << '\n' << result.output;
  EXPECT_EQ(call("info sphere:100").output.find("gravity"), std::string::npos);
}

TEST(Command, MatterIsAboveTheIsoValueUnlessItIsSaidToBeBelow) {
  for (const auto& [options, part] :
       {std::pair{"", "matter above"}, {" --below", "matter below"}, {" --below=false", "matter above"}}) {
    const Result result = call(std::string("info ct:phantom:16") + options);
    EXPECT_EQ(result.code, 0) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << options << '\n' << result.output;
  }
}

TEST(Command, InfoListsJoints) {
  const Result result = call("info workshop");
  EXPECT_EQ(result.code, 0);
  for (const char* part : {"joint drawer slide: slider, drawer to the world, 0 .. 0.034 m, friction 0.15 N\n",
                           "joint button 1 slide: ", "damping 0.05 N s/m, a force table of 4 rows\n",
                           "body ring: parts, ", " kg, 16 parts, "})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << '\n' << result.output;
}

TEST(Command, BodiesAreTracedRecordedAndReproduced) {
  const std::string path = hl::test::fileWith("hl_cmd_path.csv", "t,x,y,z\n0,0,0.1,0\n0.001,0,0.1,0\n");
  const std::string out = hl::test::tempFile("hl_cmd_out.csv"), recording = hl::test::tempFile("hl_cmd_bodies.hlr");
  const Result traced = call("trace " + sceneWithBodies() + " --path " + path + " --out " + out);
  EXPECT_EQ(traced.code, 0) << traced.output;
  EXPECT_NE(traced.output.find("2 bodies: kinetic energy +"), std::string::npos) << traced.output;
  EXPECT_NE(contentOf(out).find(",tick_ns,red_ball_x,"), std::string::npos);
  EXPECT_EQ(
      call("record " + sceneWithBodies() + " --duration 1 --no-open --port 0 --black-box off --out " + recording).code,
      0);
  const Result replayed = call("replay " + recording);
  EXPECT_EQ(replayed.code, 0);
  EXPECT_NE(replayed.output.find("reproduced: bit for bit"), std::string::npos) << replayed.output;
  EXPECT_NE(replayed.output.find("bodies:     compared after "), std::string::npos) << replayed.output;
}

TEST(Command, AKilledRecordingIsReproducedAsFarAsItGoes) {
  const std::string file = hl::test::tempFile("hl_cmd_killed.hlr");
  call("record sphere:2000 --no-open --port 0 --black-box off --out " + file + " & child=$!; sleep 2; kill -9 $child");
  const Result replayed = call("replay " + file);
  EXPECT_EQ(replayed.code, 0) << replayed.output;
  EXPECT_EQ(lineWith(replayed.output, "reproduced"), "reproduced: bit for bit") << replayed.output;
  EXPECT_NE(lineWith(replayed.output, "ended:").find("killed"), std::string::npos) << replayed.output;
}

TEST(Command, AFaultReportsWhereItsBlackBoxIs) {
  const std::string boxes = hl::test::tempFile("hl_cmd_boxes");
  const Result touched = call("touch teapot --no-open --port 0 --duration 2 --speed-limit 0.001 --black-box " + boxes);
  ASSERT_EQ(touched.code, 0) << touched.output;
  const std::string line = lineWith(touched.output, "black box: ");
  ASSERT_NE(line, "") << touched.output;
  const Result replayed = call("replay " + line.substr(std::string("black box: ").size()));
  EXPECT_EQ(replayed.code, 0) << replayed.output;
  EXPECT_NE(lineWith(replayed.output, "fault:").find("faster"), std::string::npos) << replayed.output;
}

}  // namespace
}  // namespace hl::test_command
