#include "io/trace_csv.h"
#include "base/text.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <span>

namespace hl {

namespace {

void addNumbers(fmt::memory_buffer& line, std::span<const double> numbers) {
  for (const double number : numbers) fmt::format_to(std::back_inserter(line), ",{:.17g}", number);
}

void addTurn(fmt::memory_buffer& line, const Eigen::Quaterniond& q) {
  addNumbers(line, std::array{q.w(), q.x(), q.y(), q.z()});
}

void addBodies(fmt::memory_buffer& line, const TraceRow& row) {
  for (const TracedBody& body : row.bodies) {
    addNumbers(line, {body.origin.data(), 3});
    addTurn(line, body.turned);
    addNumbers(line, {body.velocity.data(), 3});
    addNumbers(line, {body.spin.data(), 3});
  }
  const EnergyBook& book = row.world.book;
  addNumbers(line, std::array{row.world.kinetic_J, row.world.gravity_J, book.by_hand_J, book.contact_J, book.friction_J,
                              book.solver_J});
  fmt::format_to(std::back_inserter(line), ",{:016x}", row.world.hash);
}

void addJoints(fmt::memory_buffer& line, const TraceRow& row) {
  for (const TracedJoint& joint : row.joints)
    addNumbers(line, std::array{joint.coordinate, joint.velocity, joint.force});
  addNumbers(line, std::array{row.world.spring_J, row.world.book.joint_J()});
}

}  // namespace

TraceColumnNames columnsOf(const TraceColumns& columns) {
  std::set<std::string> taken{"finger", "proxy", "target", "force"};
  const auto named = [&](std::string name, const char* otherwise) {
    if (name.empty()) name = otherwise;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !isLetterOrDigit(c); }, '_');
    std::string column = name;
    for (int number = 2; !taken.insert(column).second; ++number) column = fmt::format("{}_{}", name, number);
    return column;
  };
  TraceColumnNames names;
  for (const std::string& body : columns.bodies) names.bodies.push_back(named(body, "body"));
  for (const std::string& joint : columns.joints) names.joints.push_back(named(joint, "joint"));
  return names;
}

TraceWriter::TraceWriter(const std::string& file, std::initializer_list<std::string> read, const TraceColumns& columns)
    : file_(file, read) {
  file_.write(
      "t,finger_x,finger_y,finger_z,proxy_x,proxy_y,proxy_z,target_x,target_y,target_z,force_x,force_y,force_z,"
      "contacts,iterations,injected_J,tick_ns");
  const TraceColumnNames names = columnsOf(columns);
  for (const std::string& column : names.bodies) {
    for (const char* part : {"x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"})
      file_.print(",{}_{}", column, part);
  }
  if (!columns.bodies.empty()) file_.write(",kinetic_J,gravity_J,by_hand_J,contact_J,friction_J,solver_J,world_hash");
  for (const std::string& column : names.joints) {
    for (const char* part : {"coordinate", "velocity", "force"}) file_.print(",{}_{}", column, part);
  }
  if (!columns.joints.empty()) file_.write(",spring_J,joint_J");
  if (columns.snap) file_.write(",snap");
  if (columns.turned) file_.write(",stylus_qw,stylus_qx,stylus_qy,stylus_qz");
  file_.write(columns.gripper ? ",gripper_rad\n" : "\n");
}

void TraceWriter::write(const TraceRow& row) {
  fmt::memory_buffer line;
  auto out = std::back_inserter(line);
  fmt::format_to(out, "{:.17g}", row.t);
  for (const Vec3* v : {&row.finger, &row.proxy, &row.target, &row.force}) {
    fmt::format_to(out, ",{:.17g},{:.17g},{:.17g}", v->x(), v->y(), v->z());
  }
  fmt::format_to(out, ",{},{},{:.17g},{}", row.contacts, row.iterations, row.injected_J, row.tick_ns);
  if (!row.bodies.empty()) addBodies(line, row);
  if (!row.joints.empty()) addJoints(line, row);
  if (row.snap) fmt::format_to(std::back_inserter(line), ",{}", *row.snap);
  if (row.turned) addTurn(line, *row.turned);
  if (row.gripper_rad) addNumbers(line, std::array{*row.gripper_rad});
  line.push_back('\n');
  file_.write({line.data(), line.size()});
}

}  // namespace hl
