#include "io/check_ply.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "io/mapped_file.h"
#include "io/ply_body.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr std::size_t kMaxHeader_bytes = 1 << 20;  // comments and all

struct PlyHeader {
  std::string format;
  std::uint64_t elements = 0;  // of all kinds
  std::vector<PlyKind> kinds;  // of which there are some, in their order
};

// What follows an element that the reader does not know is taken for that element's; what it knows may come before.
void checkKinds(const std::vector<PlyKind>& kinds) {
  const auto is_known = [](const PlyKind& kind) {
    return kind.name == "vertex" || kind.name == "face" || kind.name == "edge" || kind.name == "material";
  };
  if (std::any_of(kinds.begin(), kinds.end(), [](const PlyKind& kind) { return kind.name == "tristrips"; }))
    throw Error("has triangle strips (tristrips), which are not read: save it with faces");
  const auto unknown = std::find_if_not(kinds.begin(), kinds.end(), is_known);
  if (std::any_of(unknown, kinds.end(), is_known))
    throw Error(
        fmt::format("has elements of the kind '{}' before its vertices or faces, which are not read: save it without",
                    shown(unknown->name)));
}

// Takes the first line from a text, without its end: LF, CR LF or, in files of old, CR alone. What is between CR and LF
// is an empty line.
bool takeLine(std::string_view& text, std::string_view& line) {
  if (text.empty()) return false;
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return true;
}

std::uint64_t countOf(const std::string& number) {
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
  if (error != std::errc() || end != number.data() + number.size())
    throw Error(fmt::format("'{}' is no count of elements", shown(number)));
  return count;
}

void addPlyProperty(PlyKind& kind, const std::string& type, std::istringstream& words) {
  std::string length, number;
  if (type == "list" && words >> length >> number) {
    // A length of an unknown kind leaves the whole unknown.
    const auto kind_of_length = plyKindOf(length);
    kind.properties.push_back({kind_of_length.value_or(ScalarKind::kUint8),
                               kind_of_length ? plyKindOf(number) : std::optional<ScalarKind>()});
  } else {
    kind.properties.push_back({{}, plyKindOf(type)});
  }
}

// Takes the header from a text.
PlyHeader takeHeader(std::string_view& text) {
  PlyHeader header;
  std::vector<PlyKind> kinds;
  std::string_view rest = text.substr(0, kMaxHeader_bytes);
  for (std::string_view line; takeLine(rest, line);) {
    std::istringstream words{std::string(line)};
    std::string word, second, number;
    words >> word >> second;
    if (word == "end_header") {
      text.remove_prefix(static_cast<std::size_t>(rest.data() - text.data()));
      std::copy_if(kinds.begin(), kinds.end(), std::back_inserter(header.kinds),
                   [](const PlyKind& kind) { return kind.count > 0; });
      return header;
    }
    if (word == "format") header.format = second;
    if (word == "property" && !kinds.empty()) addPlyProperty(kinds.back(), second, words);
    if (word != "element" || !(words >> number)) continue;  // cut: then there is no end either
    kinds.push_back({second, countOf(number)});
    header.elements += std::min(kinds.back().count, std::numeric_limits<std::uint64_t>::max() - header.elements);
  }
  throw Error("its header has no end: the line end_header is missing, or the file is cut");
}

// Whether lines end by CR LF: then the LF behind the header is no part of what follows.
bool endsByTwo(std::string_view file) {
  const std::size_t first = file.find_first_of("\r\n");
  return file.substr(std::min(first, file.size())).starts_with("\r\n");
}

// An element is a line.
void checkLines(std::string_view body, const PlyHeader& header) {
  std::uint64_t lines = 0;
  std::string_view last, before;
  for (std::string_view line; lines < header.elements && takeLine(body, line);) {
    if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
    before = std::exchange(last, line);
    ++lines;
  }
  if (lines < header.elements)
    throw Error(fmt::format("it is cut: its header tells of {} elements, and {} lines follow", header.elements, lines));
  if (lines == 0) return;
  // Where the line before is as short, a program left out what it had nothing for.
  const PlyKind& kind = header.kinds.back();
  if (!isWholePlyLine(last, kind) && (kind.count == 1 || isWholePlyLine(before, kind)))
    throw Error(fmt::format("it is cut: its last line, '{}', is no whole element of the kind '{}'", shown(last),
                            shown(kind.name)));
}

}  // namespace

void checkPly(const std::string& path) {
  const MappedFile file(path);
  std::string_view text = file.bytes();
  const PlyHeader header = takeHeader(text);
  checkKinds(header.kinds);
  // An element has a byte or more.
  if (const std::size_t bytes = file.bytes().size(); header.elements > bytes)
    throw Error(fmt::format("it is cut: its header tells of {} elements, and it has {} bytes", header.elements, bytes));
  if (header.format == "ascii") return checkLines(text, header);
  if (endsByTwo(file.bytes()) && text.starts_with('\n')) text.remove_prefix(1);
  if (header.format.starts_with("binary")) checkPlyBody(text, header.kinds, header.format == "binary_big_endian");
}

}  // namespace hl
