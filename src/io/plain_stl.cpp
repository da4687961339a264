#include "io/plain_stl.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/error.h"
#include "base/text.h"

namespace hl {

namespace {

constexpr std::size_t kStlHeader_bytes = 84, kTriangle_bytes = 50;

// The header has a title of 80 bytes and the number of triangles.
std::uint64_t trianglesTold(std::string_view file) {
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, file.data() + kStlHeader_bytes - sizeof triangles, sizeof triangles);
  return triangles;
}

std::optional<std::string> plainBinary(std::string_view file, std::vector<std::string>& warnings) {
  if (file.size() < kStlHeader_bytes) throw Error("it is cut: it ends in its header");
  const std::uint64_t triangles = trianglesTold(file), bytes = kStlHeader_bytes + kTriangle_bytes * triangles;
  if (file.size() == bytes) return std::nullopt;
  if (file.size() < bytes)
    throw Error(fmt::format("it is cut: its header tells of {} triangles, and it has the bytes of {}", triangles,
                            (file.size() - kStlHeader_bytes) / kTriangle_bytes));
  warnings.push_back(fmt::format("its header tells of {} triangles: the {} bytes behind them are left out", triangles,
                                 file.size() - bytes));
  return std::string(file.substr(0, bytes));
}

bool isSpace(char c) { return static_cast<unsigned char>(c) <= ' '; }

// The words of a text, as its reader sees them.
class StlWalk {
 public:
  explicit StlWalk(std::string_view text) : text_(text) {}

  void check() {
    for (std::string_view word = next(); !word.empty(); word = next()) {
      if (word == "solid" || word == "endsolid") {
        endFacet(word);
        skipLine();  // with a name
        in_solid_ = word == "solid";
      } else if (word == "facet") {
        endFacet(word);
        in_facet_ = true;
        vertices_ = 0;
      } else if (word == "vertex") {
        ++vertices_;
      } else if (word == "endfacet") {
        endFacet(word);
      } else if (word == "end") {
        in_solid_ = in_solid_ && next() != "solid";
      }
    }
    if (in_facet_ || in_solid_) throw Error("it is cut: its last line is not 'endsolid'");
  }

 private:
  // The next word that begins with a small letter; most others are numbers.
  std::string_view next() {
    while (true) {
      while (at_ < text_.size() && text_[at_] < 'a') ++at_;
      const std::size_t begin = at_;
      while (at_ < text_.size() && !isSpace(text_[at_])) ++at_;
      if (begin == text_.size() || begin == 0 || isSpace(text_[begin - 1])) return text_.substr(begin, at_ - begin);
    }
  }

  void skipLine() {
    while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
  }

  void endFacet(std::string_view word) {
    if (in_facet_ && vertices_ != 3)
      throw Error(fmt::format("line {}: '{}' comes after {} vertices of a facet, which has three",
                              1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n'),
                              word, vertices_));
    in_facet_ = false;
  }

  const std::string_view text_;
  std::size_t at_ = 0;
  int vertices_ = 0;
  bool in_solid_ = false, in_facet_ = false;
};

}  // namespace

std::optional<std::string> plainStl(std::string_view file, std::vector<std::string>& warnings) {
  constexpr std::size_t kLooked_bytes = 500;
  const bool sized =
      file.size() >= kStlHeader_bytes && file.size() == kStlHeader_bytes + kTriangle_bytes * trianglesTold(file);
  if (sized || file.substr(0, kLooked_bytes).find('\0') != std::string_view::npos) return plainBinary(file, warnings);
  StlWalk(withoutByteOrderMark(file)).check();
  return std::nullopt;
}

}  // namespace hl
