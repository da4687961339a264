// PLY files that have vertices and nothing else: scans. Those with faces are models.
#include <fmt/core.h>

#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "io/ply_body.h"
#include "io/point_records.h"
#include "io/read_clouds.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr const char* kNoPly = "is no sound PLY file: ";

// Where a list lies in an element of a binary file.
struct PlyList {
  std::size_t before = 0;     // bytes of numbers since the last list
  ScalarKind length, number;  // kinds of its length and of what is in it
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  PointRecord record{}, columns{};  // of binary files and of text; without lists
  std::vector<PlyList> lists{};
};

struct PlyPoints {
  std::string format;
  std::vector<PlyElement> elements;
};

ScalarKind plyKind(const std::string& name) {
  if (const std::optional<ScalarKind> kind = plyKindOf(name)) return *kind;
  throw Error(std::string(kNoPly) + "it has numbers of type '" + shown(name) + "'");
}

void addList(PlyElement& element, const std::string& length, const std::string& number) {
  std::size_t before = element.record.bytes;
  for (const PlyList& list : element.lists) before -= list.before;
  element.lists.push_back({before, plyKind(length), plyKind(number)});
}

void addProperty(PlyElement& element, const std::string& type, const std::string& name) {
  const ScalarKind form = plyKind(type);
  if (const auto number = pointNumberOf(name)) {
    element.record.fields[*number] = {element.record.bytes, form};
    element.columns.fields[*number] = {element.columns.bytes, form};
  }
  element.record.bytes += sizeOf(form);
  ++element.columns.bytes;
}

std::uint64_t plyCount(const std::string& word) {
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (error != std::errc() || end != word.data() + word.size())
    throw Error(std::string(kNoPly) + "'" + shown(word) + "' is no count of elements");
  return count;
}

PlyPoints readPlyHeader(ByteFile& in) {
  constexpr std::size_t kMaxLines = 10'000;
  PlyPoints ply;
  std::string line;
  if (!in.line(line) || trimmed(line) != "ply") throw Error("is not a PLY file");
  for (std::size_t lines = 0; lines < kMaxLines && in.line(line); ++lines) {
    std::istringstream text(line);
    std::string key, first, second;
    text >> key >> first >> second;
    if (key == "end_header") return ply;
    if (key == "format") ply.format = first;
    if (key == "element") ply.elements.push_back({first, plyCount(second)});
    if (key == "property" && ply.elements.empty()) throw Error(std::string(kNoPly) + "a property has no element");
    if (key != "property") continue;
    if (std::string number; first == "list" && text >> number)
      addList(ply.elements.back(), second, number);
    else
      addProperty(ply.elements.back(), first, second);
  }
  throw Error(std::string(kNoPly) + "its header has no line end_header");
}

// Of points: it has vertices, and nothing joins them.
struct PlyOfPoints {
  bool points = false, lists = false;
};

PlyOfPoints pointsOfPly(const std::string& path) {
  try {
    ByteFile in(path);
    PlyOfPoints ply;
    for (const PlyElement& element : readPlyHeader(in).elements) {
      const bool joins = element.name == "face" || element.name == "edge" || element.name == "tristrips";
      if (joins && element.count > 0) return {};
      if (element.name != "vertex" || element.count == 0) continue;
      ply.points = true;
      ply.lists = ply.lists || !element.lists.empty();
    }
    return ply;
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

bool isPlyOfPoints(const std::string& path) {
  const PlyOfPoints ply = pointsOfPly(path);
  return ply.points && !ply.lists;
}

bool isPlyOfListedPoints(const std::string& path) {
  const PlyOfPoints ply = pointsOfPly(path);
  return ply.points && ply.lists;
}

// Throws if there is less.
void skipMany(ByteFile& in, std::uint64_t count, std::size_t bytes) {
  if (bytes > 0 && count > std::numeric_limits<std::uint64_t>::max() / bytes) throw Error(kEndsEarly);
  in.skip(count * bytes);
}

// One element with its lists, of a binary file.
void skipElement(ByteFile& in, const PlyElement& element, bool swap) {
  std::size_t rest = element.record.bytes;
  for (const PlyList& list : element.lists) {
    std::array<char, sizeof(double)> length{};
    in.skip(list.before);
    in.read(length.data(), sizeOf(list.length));
    const double count = numberAt(length.data(), {0, list.length}, swap);
    constexpr double kMost = 1e15;
    if (!(count >= 0 && count <= kMost)) throw Error(fmt::format("{}it has a list of {:g} numbers", kNoPly, count));
    skipMany(in, static_cast<std::uint64_t>(count), sizeOf(list.number));
    rest -= list.before;
  }
  in.skip(rest);
}

// In text an element is a line.
void skipElements(ByteFile& in, const PlyElement& element, const std::string& format) {
  if (format != "ascii" && element.lists.empty()) return skipMany(in, element.count, element.record.bytes);
  std::string line;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (format != "ascii") {
      skipElement(in, element, format == "binary_big_endian");
    } else if (!in.line(line)) {
      throw Error(kEndsEarly);
    }
  }
}

// What comes before the vertices is passed over.
void readPlyPoints(const ModelFile& file, CloudSink& sink) {
  ByteFile in(file.path);
  PlyPoints ply = readPlyHeader(in);
  const bool text = ply.format == "ascii";
  if (!text && ply.format != "binary_little_endian" && ply.format != "binary_big_endian")
    throw Error(std::string(kNoPly) + "its format is '" + shown(ply.format) + "'");
  for (PlyElement& element : ply.elements) {
    if (element.name != "vertex") {
      skipElements(in, element, ply.format);
      continue;
    }
    element.record.requireCoordinates();
    element.record.swap = ply.format == "binary_big_endian";
    sink.header({});
    if (!text) return copyRecords(in, element.count, element.record, sink);
    return copyLines(std::move(in), element.count, element.columns, "a PLY file", sink);
  }
}

}  // namespace hl
