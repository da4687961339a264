// TextWords: the words of a text file, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "io/byte_file.h"

namespace hl {

/// Every call throws hl::Error, without the file's name, when the file is not what it should be.
class TextWords {
 public:
  /// From where `in` stands; a byte order mark there is no word. `kind`: what the file should be, for errors: "an Esri
  /// grid".
  TextWords(ByteFile in, std::string kind);

  /// False at the end. The word is valid until the next call.
  bool next(std::string_view& word);
  /// The next word as a number, `what` it is for.
  double number(const char* what);
  double numberOf(std::string_view word, const char* what) const;
  /// After the last sample of a grid of these `sides`: throws when there are more, as all of them then lie elsewhere
  /// than the header says.
  void checkEnd(std::initializer_list<std::uint64_t> sides);

 private:
  int letter();

  ByteFile in_;
  std::string kind_, word_;
  std::vector<char> room_ = std::vector<char>(1 << 16);
  std::size_t at_ = 0, filled_ = 0;
};

/// Takes the first word from a line, with the blanks before it; empty at its end.
inline std::string_view takeWord(std::string_view& line) {
  const auto is_blank = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  std::size_t begin = 0;
  while (begin < line.size() && is_blank(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

/// `text` from a file as an error may show it: a short piece, without what cannot be printed.
std::string shown(std::string_view text);

}  // namespace hl
