#include "io/text_words.h"

#include <fmt/format.h>

#include <charconv>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace hl {

namespace {

constexpr int kNoLetter = -1;

}  // namespace

TextWords::TextWords(ByteFile in, std::string kind) : in_(std::move(in)), kind_(std::move(kind)) {
  filled_ = in_.some(room_.data(), room_.size());
  at_ = filled_ - withoutByteOrderMark({room_.data(), filled_}).size();
}

int TextWords::letter() {
  if (at_ == filled_) {
    filled_ = in_.some(room_.data(), room_.size());
    at_ = 0;
    if (filled_ == 0) return kNoLetter;
  }
  return static_cast<unsigned char>(room_[at_++]);
}

bool TextWords::next(std::string_view& word) {
  constexpr std::size_t kLongest = 100;
  word_.clear();
  for (int c = letter(); c != kNoLetter; c = letter()) {
    const bool space = c == ' ' || c == '\n' || c == '\r' || c == '\t';
    if (space && word_.empty()) continue;
    if (space) break;
    word_ += static_cast<char>(c);
    if (word_.size() > kLongest) throw Error(fmt::format("is not {}: it has a word of more than 100 letters", kind_));
  }
  word = word_;
  return !word_.empty();
}

double TextWords::number(const char* what) {
  std::string_view word;
  if (!next(word)) throw Error(kEndsEarly);
  return numberOf(word, what);
}

double TextWords::numberOf(std::string_view word, const char* what) const {
  double value = 0;
  const char* const last = word.data() + word.size();
  const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  if (end != last || error == std::errc::invalid_argument)
    throw Error(fmt::format("is not {}: '{}' is no number for {}", kind_, shown(word), what));
  return value;
}

void TextWords::checkEnd(std::initializer_list<std::uint64_t> sides) {
  std::string_view rest;
  if (next(rest)) throw Error(fmt::format("has more samples than the {} of its header", fmt::join(sides, " x ")));
}

std::string shown(std::string_view text) {
  constexpr std::size_t kMax = 60;
  std::string piece(text.substr(0, kMax));
  for (char& c : piece) {
    if (c < ' ' || c > '~') c = '?';
  }
  return piece;
}

}  // namespace hl
