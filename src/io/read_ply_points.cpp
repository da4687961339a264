// PLY files that have vertices and nothing else: scans. Those with faces are models.
#include <fmt/core.h>

#include <array>
#include <charconv>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "io/point_records.h"
#include "io/read_clouds.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr const char* kNoPly = "is no sound PLY file: ";

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  PointRecord record, columns;  // of binary files and of text
  bool lists = false;
};

struct PlyPoints {
  std::string format;
  std::vector<PlyElement> elements;
};

ScalarKind plyKind(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, ScalarKind>, 16> kForms{{{"char", ScalarKind::kInt8},
                                                                            {"int8", ScalarKind::kInt8},
                                                                            {"uchar", ScalarKind::kUint8},
                                                                            {"uint8", ScalarKind::kUint8},
                                                                            {"short", ScalarKind::kInt16},
                                                                            {"int16", ScalarKind::kInt16},
                                                                            {"ushort", ScalarKind::kUint16},
                                                                            {"uint16", ScalarKind::kUint16},
                                                                            {"int", ScalarKind::kInt32},
                                                                            {"int32", ScalarKind::kInt32},
                                                                            {"uint", ScalarKind::kUint32},
                                                                            {"uint32", ScalarKind::kUint32},
                                                                            {"float", ScalarKind::kFloat},
                                                                            {"float32", ScalarKind::kFloat},
                                                                            {"double", ScalarKind::kDouble},
                                                                            {"float64", ScalarKind::kDouble}}};
  for (const auto& [of, form] : kForms) {
    if (of == name) return form;
  }
  throw Error(std::string(kNoPly) + "it has numbers of type '" + shown(name) + "'");
}

void addProperty(PlyElement& element, const std::string& type, const std::string& name) {
  if (type == "list") {
    element.lists = true;
    return;
  }
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
    if (key == "element") ply.elements.push_back({first, plyCount(second), {}, {}, false});
    if (key == "property" && ply.elements.empty()) throw Error(std::string(kNoPly) + "a property has no element");
    if (key == "property") addProperty(ply.elements.back(), first, second);
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
      ply.lists = ply.lists || element.lists;
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

// What comes before the vertices is passed over.
void readPlyPoints(const ModelFile& file, CloudSink& sink) {
  ByteFile in(file.path);
  PlyPoints ply = readPlyHeader(in);
  const bool text = ply.format == "ascii";
  if (!text && ply.format != "binary_little_endian" && ply.format != "binary_big_endian")
    throw Error(std::string(kNoPly) + "its format is '" + shown(ply.format) + "'");
  for (PlyElement& element : ply.elements) {
    if (element.name != "vertex") {
      if (element.lists && element.count > 0) throw Error("has lists before its vertices, which are not understood");
      std::string line;
      for (std::uint64_t i = 0; text && i < element.count; ++i) {
        if (!in.line(line)) throw Error(kEndsEarly);
      }
      if (!text && element.count > 0 && element.record.bytes > 0) {
        if (element.count > std::numeric_limits<std::uint64_t>::max() / element.record.bytes) throw Error(kEndsEarly);
        in.skip(element.count * element.record.bytes);
      }
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
