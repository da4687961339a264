#include "io/read_clouds.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "io/point_records.h"
#include "io/text_words.h"

namespace hl {

namespace {

using ReadCloud = void (*)(const ModelFile&, CloudSink&);
constexpr std::array<std::pair<std::string_view, ReadCloud>, 4> kCloudReaders{
    {{".las", readLas}, {".pcd", readPcd}, {".xyz", readXyz}, {".ply", readPlyPoints}}};

ReadCloud cloudReaderOf(const std::string& ending) {
  for (const auto& [of, read] : kCloudReaders) {
    if (of == ending) return read;
  }
  return nullptr;
}

constexpr std::size_t kColumnsThatCount = 6;  // x y z and a normal

// The numbers of a line, as many as there are up to six; an empty field ends them.
std::size_t numbersOf(std::string_view line, PointNumbers& numbers) {
  constexpr const char* kBetween = " \t,;";
  std::size_t count = 0;
  while (count < kColumnsThatCount) {
    const std::size_t begin = line.find_first_not_of(kBetween);
    if (begin == std::string_view::npos) break;
    const auto marks = std::count_if(line.begin(), line.begin() + begin, [](char c) { return c == ',' || c == ';'; });
    if (marks > (count > 0 ? 1 : 0)) break;
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find_first_of(kBetween));
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(digits.data(), word.data() + word.size(), numbers[count]);
    if (end != word.data() + word.size() || error == std::errc::invalid_argument) break;
    ++count;
    line.remove_prefix(word.size());
  }
  return count;
}

bool isUnitNormal(const PointNumbers& numbers) {
  constexpr double kRounded = 0.01;
  const Vec3 normal(numbers[kNormalX], numbers[kNormalY], numbers[kNormalZ]);
  return std::abs(normal.norm() - 1) < kRounded;
}

// "X,Y,Z" and more, as spreadsheets begin a table.
bool namesColumns(std::string_view line) { return without(" \t,;\"", lowered(line)).starts_with("xyz"); }

PointRecord xyzRecord(bool normals) {
  PointRecord record;
  for (const PointNumber axis : {kNormalX, kNormalY, kNormalZ}) {
    if (normals) record.fields[axis] = RecordField{};
  }
  return record;
}

}  // namespace

bool readsClouds(const std::string& ending) { return ending != ".ply" && cloudReaderOf(ending) != nullptr; }

std::string cloudAdvice(const std::string& ending) {
  if (ending == ".laz") return "is packed LAS, which cannot be read: unpack it, as in laszip -i a.laz -o a.las";
  if (ending == ".e57") return "is E57, which cannot be read: convert it to PLY or LAS, as CloudCompare does";
  if (ending == ".txt" || ending == ".csv")
    return "files ending in '" + ending +
           "' cannot be read; a list of points, x y z on each line, can if it is renamed to end in .xyz";
  return {};
}

void readCloud(const ModelFile& file, CloudSink& sink) { cloudReaderOf(file.ending)(file, sink); }

// The first line that is no comment may be the number of points, or name the columns. Normals are those of columns four
// to six, if the first has length 1.
void readXyz(const ModelFile& file, CloudSink& sink) {
  ByteFile in(file.path);
  sink.header({});
  PointNumbers numbers{};
  std::optional<PointPieces> pieces;
  std::string line;
  bool first = true;
  for (std::uint64_t number = 1; in.line(line); ++number) {
    const std::string_view text = trimmed(number == 1 ? withoutByteOrderMark(line) : line);
    if (text.empty() || text.starts_with('#') || text.starts_with("//")) continue;
    const std::size_t count = numbersOf(text, numbers);
    if (std::exchange(first, false) && (count == 1 || namesColumns(text))) continue;
    if (count < 3)
      throw Error(fmt::format("is no list of points: line {} is '{}', and a point is x y z", number, shown(text)));
    if (!pieces) pieces.emplace(sink, xyzRecord(count == kColumnsThatCount && isUnitNormal(numbers)));
    if (count < kColumnsThatCount) numbers[kNormalX] = numbers[kNormalY] = numbers[kNormalZ] = 0;
    pieces->add(numbers);
  }
  if (pieces) pieces->flush();
}

}  // namespace hl
