#include "io/csv_path.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "base/error.h"
#include "base/finger_reach.h"
#include "io/text_words.h"

namespace hl {

namespace {

// Exactly four finite numbers between commas.
bool parseRow(std::string_view line, std::array<double, 4>& values) {
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i == 3)) return false;
    std::string_view field = trimmed(line.substr(0, comma));
    if (field.starts_with('+')) field.remove_prefix(1);
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), values[i]);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(values[i])) return false;
    if (i < 3) line.remove_prefix(comma + 1);
  }
  return true;
}

}  // namespace

std::vector<PathSample> readPath(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw Error(file + ": cannot be read");
  std::string line;
  std::getline(in, line);
  if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
  if (trimmed(line) != "t,x,y,z") throw Error(file + ":1: the first line must be the header t,x,y,z");
  std::vector<PathSample> path;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    if (trimmed(line).empty()) continue;
    const auto where = [&] { return file + ":" + std::to_string(number) + ": "; };
    std::array<double, 4> v{};
    if (!parseRow(line, v)) throw Error(where() + "a row must be four finite numbers t,x,y,z");
    const Vec3 position(v[1], v[2], v[3]);
    if (!canBeFinger(position) || std::abs(v[0]) > kLastTime_s)
      throw Error(where() + "a row must lie within 1e15 m of the origin, and within 1e15 s of t = 0");
    if (!path.empty() && !(v[0] - path.back().t >= kMinStep_s))
      throw Error(where() + "t must grow from row to row, by 1e-15 s at least");
    path.push_back({v[0], position});
  }
  if (path.empty()) throw Error(file + ": there are no rows after the header");
  return path;
}

}  // namespace hl
