// Finger paths and traces: what is accepted, what is refused and how, and that no digit is lost.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "io/csv_path.h"
#include "io/output_file.h"
#include "io/trace_csv.h"
#include "temp_folder.h"

namespace hl::test_csv {
namespace {

std::string refusalOf(const std::string& content) {
  try {
    readPath(test::fileWith("path.csv", content));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::pair<std::string, std::string> twoLinesOf(const std::string& name) {
  std::ifstream in(name);
  std::pair<std::string, std::string> lines;
  std::getline(in, lines.first);
  std::getline(in, lines.second);
  return lines;
}

// Header and row of a trace that has these columns.
std::pair<std::string, std::string> linesWith(const TraceColumns& columns, const TraceRow& row) {
  const std::string name = test::tempFile("out.csv");
  TraceWriter writer(name, {}, columns);
  writer.write(row);
  writer.close();
  return twoLinesOf(name);
}

TEST(CsvPath, ReadsRowsWithAnyLineEndAndSpaces) {
  const auto path = readPath(test::fileWith("path.csv", "t,x,y,z\r\n0,1,2,3\r\n 0.5 , -1e-3,+2, 4 \n\n1,0,0,0"));
  ASSERT_EQ(path.size(), 3u);
  EXPECT_EQ(path[1].t, 0.5);
  EXPECT_EQ(path[1].position, Vec3(-1e-3, 2, 4));
}

TEST(CsvPath, MayTurnTheStylusAndOpenItsGripper) {
  const auto read = [](const std::string& text) { return readPath(test::fileWith("path.csv", text)).back(); };
  PathSample sample = read("t,x,y,z,qw,qx,qy,qz\n0,1,2,3,0,0,-3,4\n");
  EXPECT_LT((sample.turned->coeffs() - Eigen::Vector4d(0, -0.6, 0.8, 0)).norm(), 1e-15);
  EXPECT_FALSE(sample.gripper_rad);
  sample = read("t,x,y,z,gripper_rad\n0,1,2,3,0.5\n");
  EXPECT_FALSE(sample.turned);
  EXPECT_EQ(sample.gripper_rad, 0.5);
  sample = read("t,x,y,z,qw,qx,qy,qz,gripper_rad\n0,1,2,3,2,0,0,0,0.25\n");
  EXPECT_EQ(sample.turned->w(), 1);
  EXPECT_EQ(sample.gripper_rad, 0.25);
  EXPECT_NE(refusalOf("t,x,y,z,qw,qx,qy,qz\n0,0,0,0,0,0,0,0\n").find(":2: the quaternion"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z,qw,qx,qy,qz\n0,0,0,0,1,0,0\n").find(":2: a row must be finite numbers t,x,y,z,qw"),
            std::string::npos);
  const std::string refusal = refusalOf("t,x,y,z,qw\n0,0,0,0,1\n");
  EXPECT_NE(refusal.find(":1: the first line must be the header t,x,y,z or"), std::string::npos);
  EXPECT_NE(refusal.find("it is 't,x,y,z,qw'"), std::string::npos) << refusal;
  EXPECT_EQ(read("\xef\xbb\xbf\"t\", x, y, z\r\n0, 1, 2, 3\r\n").position, Vec3(1, 2, 3)) << "as spreadsheets write it";
}

TEST(CsvPath, RefusesWithTheLineNumber) {
  EXPECT_NE(refusalOf("x,y,z\n1,2,3\n").find(":1:"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z\n0,0,0,0\n1,nan,0,0\n").find(":3:"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z\n0,0,0,0\n1,inf,0,0\n").find(":3:"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z\n0,0,0\n").find(":2:"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z\n0,0,0,0,0\n").find(":2:"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z\n0,0,0,zero\n").find(":2:"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z\n1,0,0,0\n1,0,0,0\n").find("must grow"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z\n0,0,0,0\n1,0,1e200,0\n").find(":3: a row must lie within 1e15 m"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z\n0,0,0,-1e308\n").find(":2: a row must lie within 1e15 m"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z\n0,0,0,0\n1e308,0,0,0\n").find("within 1e15 s"), std::string::npos);
  EXPECT_NE(refusalOf("t,x,y,z\n0,0,0,0\n1e-320,0,0,0\n").find("by 1e-15 s at least"), std::string::npos);
  EXPECT_EQ(refusalOf("t,x,y,z\n0,0,0,1e15\n1e-3,0,-1e15,0\n"), "accepted");
  EXPECT_NE(refusalOf("t,x,y,z\n").find("no rows"), std::string::npos);
  EXPECT_NE(refusalOf("").find(":1:"), std::string::npos);
  EXPECT_THROW(readPath("/nonexistent/path.csv"), Error);
}

TEST(TraceCsv, HasTheColumnsOfTheContractAndEveryDigit) {
  const std::string name = test::tempFile("out.csv");
  TraceWriter writer(name);
  TraceRow row;
  row.t = 0.1;
  row.finger = Vec3(1.0 / 3, 2.0 / 3, -1e-300);
  row.contacts = 2;
  writer.write(row);
  writer.close();
  auto [header, line] = twoLinesOf(name);
  EXPECT_EQ(header,
            "t,finger_x,finger_y,finger_z,proxy_x,proxy_y,proxy_z,target_x,target_y,target_z,force_x,force_y,force_z,"
            "contacts,iterations,injected_J,tick_ns");
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream fields(line);
  double t, x, y, z;
  fields >> t >> x >> y >> z;
  EXPECT_EQ(t, row.t);
  EXPECT_EQ(Vec3(x, y, z), row.finger);
}

TEST(TraceCsv, ColumnsOfBodiesHaveNamesThatAHeaderCanHave) {
  const TraceColumnNames columns = columnsOf(
      {{"ball", "ball", "ball_2", "", "red ball,\"1\"", "force", "kugel \u00e4", "objects[3]"}, {"ball", ""}});
  EXPECT_EQ(columns.joints, (std::vector<std::string>{"ball_3", "joint"}));
  EXPECT_EQ(columns.bodies, (std::vector<std::string>{"ball", "ball_2", "ball_2_2", "body", "red_ball__1_", "force_2",
                                                      "kugel___", "objects_3_"}));
}

TEST(TraceCsv, BodiesFollowTheColumnsOfTheTick) {
  const TracedBody ball{Vec3(1, 2, 3), Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), Vec3(4, 5, 6), Vec3(7, 8, 1.0 / 3)};
  TraceRow row;
  row.bodies = {&ball, 1};
  row.world.kinetic_J = 1;
  row.world.gravity_J = 2;
  row.world.book.by_hand_J = 3;
  row.world.book.contact_J = 4;
  row.world.book.friction_J = 5;
  row.world.book.solver_J = 6;
  row.world.hash = 0xabc;
  const auto [header, line] = linesWith({{"ball"}}, row);
  EXPECT_TRUE(
      header.ends_with("tick_ns,ball_x,ball_y,ball_z,ball_qw,ball_qx,ball_qy,ball_qz,ball_vx,ball_vy,ball_vz,"
                       "ball_wx,ball_wy,ball_wz,kinetic_J,gravity_J,by_hand_J,contact_J,friction_J,solver_J,"
                       "world_hash"));
  EXPECT_TRUE(line.ends_with(",1,2,3,0.5,0.5,-0.5,0.5,4,5,6,7,8,0.33333333333333331,1,2,3,4,5,6,0000000000000abc"));
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(line.begin(), line.end(), ','));
}

TEST(TraceCsv, JointsFollowTheBodies) {
  const TracedBody door{};
  const TracedJoint hinge{0.5, -2, 0.25};
  TraceRow row;
  row.bodies = {&door, 1};
  row.joints = {&hinge, 1};
  row.world.spring_J = 7;
  row.world.book.joint_damping_J = 8;
  const auto [header, line] = linesWith({{"door"}, {"hinge"}}, row);
  EXPECT_TRUE(header.ends_with("world_hash,hinge_coordinate,hinge_velocity,hinge_force,spring_J,joint_J"));
  EXPECT_TRUE(line.ends_with(",0.5,-2,0.25,7,8"));
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(line.begin(), line.end(), ','));
}

TEST(TraceCsv, TheSnapIsTheLastColumn) {
  TraceRow row;
  row.snap = 3;
  const auto [header, line] = linesWith({{}, {}, true}, row);
  EXPECT_TRUE(header.ends_with("tick_ns,snap"));
  EXPECT_TRUE(line.ends_with(",0,3"));
}

TEST(TraceCsv, TheStylusOfThePathComesLast) {
  TraceRow row;
  row.turned = Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5);
  row.gripper_rad = 0.25;
  const auto [header, line] = linesWith({{}, {}, false, true, true}, row);
  EXPECT_TRUE(header.ends_with("tick_ns,stylus_qw,stylus_qx,stylus_qy,stylus_qz,gripper_rad"));
  EXPECT_TRUE(line.ends_with(",0,0.5,-0.5,0.5,0.5,0.25"));
}

TEST(TraceCsv, SaysWhenItCannotWrite) {
  EXPECT_THROW(TraceWriter("/nonexistent/out.csv"), Error);
  TraceWriter full("/dev/full");
  full.write({});
  EXPECT_THROW(full.close(), Error);
}

TEST(OutputFile, LeavesWhatIsReadAsItIs) {
  const std::string name = test::tempFile("path.csv");
  std::ofstream(name) << "kept";
  EXPECT_THROW(OutputFile(name, {"teapot", name}), Error);
  std::filesystem::create_symlink(name, name + ".link");
  EXPECT_THROW(OutputFile(name + ".link", {name}), Error);
  std::string text;
  std::ifstream(name) >> text;
  EXPECT_EQ(text, "kept");
  OutputFile other(name + ".out", {name});
  other.print("{},{}\n", 1, 2);
  other.close();
  std::ifstream(name + ".out") >> text;
  EXPECT_EQ(text, "1,2");
}

}  // namespace
}  // namespace hl::test_csv
