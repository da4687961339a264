#include "base/utf8.h"

#include <algorithm>
#include <iterator>

namespace hl {

namespace {

constexpr std::uint32_t kPayload = 0x3f;  // of a byte that continues

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xc0U) == 0x80; }

// Bytes of the character that begins here; 0: none does. The ranges are those of RFC 3629.
std::size_t lengthOfCharacter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  std::size_t length = 0;
  if (first >= 0xc2 && first < 0xe0) length = 2;
  if (first >= 0xe0 && first < 0xf0) length = 3;
  if (first >= 0xf0 && first < 0xf5) length = 4;
  if (length == 0 || length > text.size()) return 0;
  const unsigned char least = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned char most = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  if (byte(1) < least || byte(1) > most) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if (!continues(text[i])) return 0;
  }
  return length;
}

}  // namespace

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = lengthOfCharacter(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string validUtf8(std::string text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = lengthOfCharacter(std::string_view(text).substr(at));
    if (length == 0) text[at] = '?';
    at += std::max<std::size_t>(length, 1);
  }
  return text;
}

bool isHidden(std::uint32_t point) {
  struct Range {
    std::uint32_t first, last;
  };
  // Controls; the Arabic letter mark; the Mongolian vowel separator; the space of no width; marks, embeddings,
  // overrides and isolates of direction, with the ends of lines and paragraphs; invisible operators; the byte order
  // mark; marks of annotations; tags.
  constexpr Range kHidden[] = {{0, 0x1f},        {0x7f, 0x9f},     {0x61c, 0x61c},    {0x180e, 0x180e},
                               {0x200b, 0x200b}, {0x200e, 0x200f}, {0x2028, 0x202e},  {0x2060, 0x206f},
                               {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0001, 0xe007f}};
  return std::any_of(std::begin(kHidden), std::end(kHidden),
                     [point](const Range& range) { return point >= range.first && point <= range.last; });
}

std::string printable(std::string_view text) {
  std::vector<std::uint32_t> points = codePointsOf(text);
  std::replace_if(points.begin(), points.end(), isHidden, '?');
  return utf8Of(points);
}

std::string_view beginOf(std::string_view text, std::size_t most_bytes) {
  std::size_t end = std::min(text.size(), most_bytes);
  while (end > 0 && end < text.size() && continues(text[end])) --end;
  return text.substr(0, end);
}

std::vector<std::uint32_t> codePointsOf(std::string_view text) {
  std::vector<std::uint32_t> points;
  while (!text.empty()) {
    const std::size_t length = lengthOfCharacter(text);
    std::uint32_t point = length == 0 ? '?' : static_cast<unsigned char>(text[0]);
    if (length > 1) point &= kPayload >> (length - 1);
    for (std::size_t i = 1; i < length; ++i) point = point << 6U | (static_cast<unsigned char>(text[i]) & kPayload);
    points.push_back(point);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return points;
}

std::string utf8Of(const std::vector<std::uint32_t>& points) {
  std::string text;
  for (const std::uint32_t point : points) {
    const unsigned followers = point < 0x80 ? 0 : point < 0x800 ? 1 : point < 0x10000 ? 2 : 3;
    constexpr std::uint32_t kLead[] = {0, 0xc0, 0xe0, 0xf0};
    text += static_cast<char>(kLead[followers] | point >> 6 * followers);
    for (unsigned left = followers; left > 0; --left)
      text += static_cast<char>(0x80U | (point >> 6 * (left - 1) & kPayload));
  }
  return text;
}

}  // namespace hl
