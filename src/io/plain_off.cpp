#include "io/plain_off.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "geometry/polygon.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr std::size_t kMostCorners = 9, kLongestOffLine = 4000;  // of the reader

template <typename Number>
bool isNumber(std::string_view word, Number& number) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

// The next word of a line as a whole number; false, and nothing is taken, where it is none. Large files have millions.
bool takeWhole(std::string_view& line, std::uint64_t& number) {
  constexpr std::size_t kMostDigits = 18;
  std::size_t at = 0;
  while (at < line.size() && line[at] == ' ') ++at;
  const std::size_t begin = at;
  for (number = 0; at < line.size() && line[at] >= '0' && line[at] <= '9'; ++at)
    number = 10 * number + static_cast<std::uint64_t>(line[at] - '0');
  const bool ends = at == line.size() || line[at] == ' ';
  if (at == begin || at - begin > kMostDigits || !ends) return false;
  line.remove_prefix(at);
  return true;
}

// Without the blanks at its ends.
std::string_view bare(std::string_view line) {
  while (!line.empty() && static_cast<unsigned char>(line.front()) <= ' ') line.remove_prefix(1);
  while (!line.empty() && static_cast<unsigned char>(line.back()) <= ' ') line.remove_suffix(1);
  return line;
}

// The lines that have something, without comments.
class OffLines {
 public:
  explicit OffLines(std::string_view text)
      : text_(text), has_comments_(text.find('#') != std::string_view::npos), ends_(endsOf(text)) {}

  bool next(std::string_view& line) {
    for (line = std::exchange(rest_, {}); line.empty();) {
      if (at_ >= text_.size()) return false;
      line = take();
    }
    return true;
  }
  /// What is left of the line: it is the next.
  void putBack(std::string_view rest) { rest_ = bare(rest); }
  std::size_t number() const { return number_; }
  /// Whether there was anything that is not for the reader, since the last call.
  bool takeOdd() { return std::exchange(odd_, false); }

 private:
  // Files of old end their lines by CR alone.
  static char endsOf(std::string_view text) {
    const std::size_t first = text.find_first_of("\r\n");
    const bool old = first != std::string_view::npos && text[first] == '\r' && text.substr(first + 1, 1) != "\n";
    return old ? '\r' : '\n';
  }

  std::string_view take() {
    const std::size_t end = std::min(text_.find(ends_, at_), text_.size());
    std::string_view whole = text_.substr(at_, end - at_);
    if (whole.ends_with('\r')) whole.remove_suffix(1);
    at_ = end + 1;
    ++number_;
    const std::string_view line = bare(has_comments_ ? whole.substr(0, whole.find('#')) : whole);
    odd_ = odd_ || line.empty() != whole.empty() || whole.size() > kLongestOffLine;
    return line;
  }

  const std::string_view text_;
  const bool has_comments_;
  const char ends_;
  std::string_view rest_;
  std::size_t at_ = 0, number_ = 0;
  bool odd_ = false;
};

struct OffHeader {
  std::string keyword = "OFF";
  std::size_t coordinates = 3, numbers = 3;  // of a vertex; in its line at least
  std::uint64_t vertices = 0, faces = 0;
  bool has_weight = false;
};

class OffReader {
 public:
  OffReader(std::string_view text, std::vector<std::string>& warnings)
      : lines_(withoutByteOrderMark(text)), warnings_(warnings) {
    readHeader();
  }

  /// Throws for what is wrong. Whether the reader takes the text as it is.
  bool isPlain() {
    bool plain = plain_header_;
    readBody([&](std::string_view) {},
             [&](std::string_view, std::size_t corners) { plain &= corners <= kMostCorners; });
    return plain && !lines_.takeOdd();
  }

  std::string plainText() {
    std::vector<std::string_view> vertices, faces;
    std::string triangles;
    std::size_t more = 0;
    readBody([&](std::string_view line) { vertices.push_back(line); },
             [&](std::string_view line, std::size_t corners) {
               if (corners <= kMostCorners) return faces.push_back(line);
               more += appendTriangles(triangles, line, vertices);
             });
    std::string text = fmt::format("{}\n{} {} 0\n", header_.keyword, header_.vertices, faces.size() + more);
    for (const auto* list : {&vertices, &faces}) {
      for (const std::string_view line : *list) (text += line.substr(0, kLongestOffLine)) += '\n';
    }
    return text + triangles;
  }

 private:
  std::uint64_t count(std::string_view word, const char* of) const {
    std::uint64_t number = 0;
    if (!isNumber(word, number))
      throw Error(fmt::format("line {}: '{}' is no count of {}", lines_.number(), shown(word), of));
    return number;
  }

  // The next word of the header, which may be on a line of its own.
  std::string_view headerWord(std::string_view& line) {
    while (true) {
      if (const std::string_view word = takeWord(line); !word.empty()) return word;
      if (!lines_.next(line)) throw Error("it is cut: its header has no end");
    }
  }

  void readHeader() {
    std::string_view line;
    std::string_view word = headerWord(line);
    // Without the keyword the reader takes a first 4 for a part of it.
    const bool has_keyword = word.ends_with("OFF");
    if (has_keyword) {
      readKeyword(word, line);
      word = headerWord(line);
    }
    header_.vertices = count(word, "vertices");
    const std::size_t line_of_vertices = lines_.number();
    header_.faces = count(headerWord(line), "faces");
    const bool on_one = lines_.number() == line_of_vertices;
    // Some programs write no count of edges.
    const bool has_edges = !on_one || !trimmed(line).empty();
    if (has_edges) count(headerWord(line), "edges");
    lines_.putBack(line);
    plain_header_ = has_keyword && has_edges && trimmed(line).empty();
    lines_.takeOdd();  // the reader knows comments there
  }

  // [ST][C][N][4][n]OFF, and the number of coordinates where there is the n.
  void readKeyword(std::string_view word, std::string_view& line) {
    header_.keyword = word;
    const auto has = [&](std::string_view sign) {
      const bool there = word.starts_with(sign);
      if (there) word.remove_prefix(sign.size());
      return there;
    };
    const bool texture = has("ST"), colours = has("C"), normals = has("N");
    header_.has_weight = has("4");
    const bool dimension = has("n");
    if (word != "OFF") throw Error(fmt::format("line {}: '{}' is no kind of OFF file", lines_.number(), shown(word)));
    if (std::string_view rest = line; takeWord(rest) == "BINARY")
      throw Error("is a binary OFF file, which is not read: save it as text");
    if (dimension) {
      header_.coordinates = count(headerWord(line), "coordinates");
      header_.keyword += fmt::format(" {}", header_.coordinates);
    }
    constexpr std::size_t kMost = 3;
    if (header_.coordinates > kMost) throw Error("its vertices have more than three coordinates");
    header_.numbers =
        header_.coordinates + (header_.has_weight ? 1 : 0) + (normals ? 3 : 0) + (texture ? 2 : 0) + (colours ? 1 : 0);
  }

  template <typename OnVertex, typename OnFace>
  void readBody(const OnVertex& on_vertex, const OnFace& on_face) {
    std::string_view line;
    for (std::uint64_t i = 0; i < header_.vertices; ++i) {
      nextElement(line, i, "vertices", header_.vertices);
      requireNumbers(line);
      on_vertex(line);
    }
    for (std::uint64_t i = 0; i < header_.faces; ++i) {
      nextElement(line, i, "faces", header_.faces);
      on_face(line, cornersOf(line));
    }
    if (lines_.next(line))
      warnings_.push_back(
          fmt::format("what follows its {} faces, from line {} on, is left out", header_.faces, lines_.number()));
  }

  void nextElement(std::string_view& line, std::uint64_t had, const char* what, std::uint64_t told) {
    if (!lines_.next(line))
      throw Error(fmt::format("it is cut: its header tells of {} {}, and {} follow", told, what, had));
  }

  void requireNumbers(std::string_view line) const {
    for (std::size_t i = 0; i < header_.numbers; ++i) {
      if (takeWord(line).empty())
        throw Error(fmt::format("line {}: a vertex has {} numbers, and needs {}", lines_.number(), i, header_.numbers));
    }
  }

  std::size_t cornersOf(std::string_view line) const {
    std::uint64_t corners = 0, index = 0;
    if (!takeWhole(line, corners)) corners = count(takeWord(line), "corners");
    for (std::uint64_t i = 0; i < corners; ++i) {
      std::string_view rest = line;
      if (takeWhole(rest, index) && index < header_.vertices) {
        line = rest;
        continue;
      }
      const std::string_view word = takeWord(line);
      if (word.empty())
        throw Error(fmt::format("line {}: a face has {} corners, and tells of {}", lines_.number(), i, corners));
      if (!isNumber(word, index) || index >= header_.vertices)
        throw Error(fmt::format("line {}: a face has the vertex '{}', and there are {}, from 0", lines_.number(),
                                shown(word), header_.vertices));
    }
    return corners;
  }

  Vec3 positionOf(std::string_view line) const {
    Vec3 position = Vec3::Zero();
    double weight = 1;
    for (std::size_t i = 0; i < header_.coordinates; ++i)
      isNumber(takeWord(line), position[static_cast<Eigen::Index>(i)]);
    if (header_.has_weight) isNumber(takeWord(line), weight);
    return position / weight;
  }

  // How many.
  std::size_t appendTriangles(std::string& text, std::string_view line,
                              const std::vector<std::string_view>& vertices) const {
    std::vector<std::uint64_t> indices(count(takeWord(line), "corners"));
    std::vector<Vec3> corners;
    for (std::uint64_t& index : indices) {
      isNumber(takeWord(line), index);
      corners.push_back(positionOf(vertices[index]));
    }
    const auto triangles = trianglesOf(corners);
    for (const auto& [a, b, c] : triangles) text += fmt::format("3 {} {} {}\n", indices[a], indices[b], indices[c]);
    return triangles.size();
  }

  OffLines lines_;
  std::vector<std::string>& warnings_;
  OffHeader header_;
  bool plain_header_ = true;
};

}  // namespace

std::optional<std::string> plainOff(std::string_view text, std::vector<std::string>& warnings) {
  if (OffReader(text, warnings).isPlain()) return std::nullopt;
  std::vector<std::string> same;
  return OffReader(text, same).plainText();
}

}  // namespace hl
