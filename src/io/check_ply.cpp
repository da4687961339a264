#include "io/check_ply.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr std::size_t kMaxHeader_bytes = 1 << 20;  // comments and all

struct PlyHeader {
  bool ascii = false;
  std::uint64_t elements = 0;      // of all kinds
  std::vector<std::string> kinds;  // of which there are some, in their order
};

// What follows an element that the reader does not know is taken for that element's; what it knows may come before.
void checkKinds(const std::vector<std::string>& kinds) {
  const auto is_known = [](const std::string& kind) {
    return kind == "vertex" || kind == "face" || kind == "edge" || kind == "material";
  };
  if (std::find(kinds.begin(), kinds.end(), "tristrips") != kinds.end())
    throw Error("has triangle strips (tristrips), which are not read: save it with faces");
  const auto unknown = std::find_if_not(kinds.begin(), kinds.end(), is_known);
  if (std::any_of(unknown, kinds.end(), is_known))
    throw Error(
        fmt::format("has elements of the kind '{}' before its vertices or faces, which are not read: save it without",
                    shown(*unknown)));
}

// Lines end by LF, CR LF or, in files of old, CR alone: what is between CR and LF is an empty line.
bool nextLine(std::istream& in, std::string& line) {
  line.clear();
  for (int byte = in.get(); in; byte = in.get()) {
    if (byte == '\n' || byte == '\r') return true;
    line += static_cast<char>(byte);
  }
  return !line.empty();
}

PlyHeader headerOf(std::istream& in) {
  PlyHeader header;
  std::size_t bytes = 0;
  for (std::string line; bytes < kMaxHeader_bytes && nextLine(in, line); bytes += line.size() + 1) {
    std::istringstream words(line);
    std::string word, second;
    std::uint64_t count = 0;
    words >> word >> second;
    if (word == "end_header") return header;
    if (word == "format") header.ascii = second == "ascii";
    if (word != "element") continue;
    std::string number;
    if (!(words >> number)) continue;  // cut: then there is no end either
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
    if (error != std::errc() || end != number.data() + number.size())
      throw Error(fmt::format("'{}' is no count of elements", shown(number)));
    if (count > 0) header.kinds.push_back(second);
    header.elements += std::min(count, std::numeric_limits<std::uint64_t>::max() - header.elements);
  }
  throw Error("its header has no end: the line end_header is missing, or the file is cut");
}

// An element is a line.
std::uint64_t linesLeft(std::istream& in) {
  std::uint64_t lines = 0;
  for (std::string line; nextLine(in, line);) lines += line.find_first_not_of(" \t") != std::string::npos ? 1 : 0;
  return lines;
}

}  // namespace

void checkPly(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const PlyHeader header = headerOf(in);
  checkKinds(header.kinds);
  // Of binary files an element has a byte or more.
  if (const std::uintmax_t bytes = std::filesystem::file_size(path); header.elements > bytes)
    throw Error(fmt::format("it is cut: its header tells of {} elements, and it has {} bytes", header.elements, bytes));
  if (!header.ascii) return;
  const std::uint64_t lines = linesLeft(in);
  if (lines < header.elements)
    throw Error(fmt::format("it is cut: its header tells of {} elements, and {} lines follow", header.elements, lines));
}

}  // namespace hl
