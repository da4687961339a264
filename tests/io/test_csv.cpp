// Finger paths and traces: what is accepted, what is refused and how, and that no digit is lost.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "io/csv_path.h"
#include "io/output_file.h"
#include "io/trace_csv.h"
#include "temp_folder.h"

namespace hl {
namespace {

std::string refusalOf(const std::string& content) {
  try {
    readPath(test::fileWith("path.csv", content));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CsvPath, ReadsRowsWithAnyLineEndAndSpaces) {
  const auto path = readPath(test::fileWith("path.csv", "t,x,y,z\r\n0,1,2,3\r\n 0.5 , -1e-3,+2, 4 \n\n1,0,0,0"));
  ASSERT_EQ(path.size(), 3u);
  EXPECT_EQ(path[1].t, 0.5);
  EXPECT_EQ(path[1].position, Vec3(-1e-3, 2, 4));
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
  std::ifstream in(name);
  std::string header, line;
  std::getline(in, header);
  std::getline(in, line);
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
}  // namespace hl
