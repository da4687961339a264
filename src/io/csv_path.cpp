#include "io/csv_path.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <span>
#include <string_view>

#include "base/error.h"
#include "base/finger_reach.h"
#include "base/plain_file.h"
#include "base/text.h"
#include "base/turn.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr std::string_view kPlace = "t,x,y,z", kTurned = ",qw,qx,qy,qz", kGripper = ",gripper_rad";
constexpr const char* kHeaders = "t,x,y,z or t,x,y,z,qw,qx,qy,qz, with ,gripper_rad after it or without";

struct Columns {
  bool turned = false, gripper = false;
  std::size_t count() const { return 4 + (turned ? 4 : 0) + (gripper ? 1 : 0); }
  std::string text() const {
    return std::string(kPlace) + std::string(turned ? kTurned : "") + std::string(gripper ? kGripper : "");
  }
};

bool readHeader(std::string_view line, Columns& columns) {
  for (columns.turned = false;; columns.turned = true) {
    for (const bool gripper : {false, true}) {
      columns.gripper = gripper;
      if (line == columns.text()) return true;
    }
    if (columns.turned) return false;
  }
}

// Exactly so many finite numbers between commas.
bool parseRow(std::string_view line, std::span<double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_last = i + 1 == values.size();
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != is_last) return false;
    std::string_view field = trimmed(line.substr(0, comma));
    if (field.starts_with('+')) field.remove_prefix(1);
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), values[i]);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(values[i])) return false;
    if (!is_last) line.remove_prefix(comma + 1);
  }
  return true;
}

PathSample sampleOf(const std::array<double, 9>& v, const Columns& columns) {
  PathSample sample{v[0], {v[1], v[2], v[3]}};
  if (columns.turned) sample.turned = Eigen::Quaterniond(v[4], v[5], v[6], v[7]);
  if (columns.gripper) sample.gripper_rad = v[columns.count() - 1];
  return sample;
}

// What is wrong with a row of finite numbers, or empty; makes its orientation one of unit length.
std::string faultOf(PathSample& sample, const std::vector<PathSample>& before) {
  if (!canBeFinger(sample.position) || std::abs(sample.t) > kLastTime_s)
    return "a row must lie within 1e15 m of the origin, and within 1e15 s of t = 0";
  if (!before.empty() && !(sample.t - before.back().t >= kMinStep_s))
    return "t must grow from row to row, by 1e-15 s at least";
  return !sample.turned || toUnit(*sample.turned) ? "" : "the quaternion qw,qx,qy,qz must not be 0";
}

}  // namespace

std::vector<PathSample> readPath(const std::string& file) {
  checkPlainFile(file);
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  Columns columns;
  if (!readHeader(without(" \t\r\"", withoutByteOrderMark(line)), columns))  // that programs write around names
    throw Error(file + ":1: the first line must be the header " + kHeaders + "; it is '" + shown(trimmed(line)) + "'");
  std::vector<PathSample> path;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    if (trimmed(line).empty()) continue;
    const auto where = [&] { return file + ":" + std::to_string(number) + ": "; };
    std::array<double, 9> v{};
    if (!parseRow(line, std::span(v).first(columns.count())))
      throw Error(where() + "a row must be finite numbers " + columns.text());
    PathSample sample = sampleOf(v, columns);
    if (const std::string fault = faultOf(sample, path); !fault.empty()) throw Error(where() + fault);
    path.push_back(sample);
  }
  if (path.empty()) throw Error(file + ": there are no rows after the header");
  return path;
}

}  // namespace hl
