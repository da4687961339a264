#include "io/base64.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace hl {

namespace {

constexpr std::string_view kSigns = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kNoSign = 64;

constexpr std::array<std::uint8_t, 256> kValues = [] {
  std::array<std::uint8_t, 256> values{};
  values.fill(kNoSign);
  for (std::size_t i = 0; i < kSigns.size(); ++i)
    values[static_cast<unsigned char>(kSigns[i])] = static_cast<std::uint8_t>(i);
  return values;
}();

std::uint32_t valueOf(char c) { return kValues[static_cast<unsigned char>(c)]; }

}  // namespace

std::string toBase64(std::string_view bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  std::size_t from = 0, to = 0;
  const auto byte = [&](std::size_t at) -> std::uint32_t {
    return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0;
  };
  for (; from < bytes.size(); from += 3, to += 4) {
    const std::uint32_t bits = byte(from) << 16 | byte(from + 1) << 8 | byte(from + 2);
    text[to] = kSigns[bits >> 18];
    text[to + 1] = kSigns[bits >> 12 & 63];
    text[to + 2] = kSigns[bits >> 6 & 63];
    text[to + 3] = kSigns[bits & 63];
  }
  for (std::size_t filled = from; filled > bytes.size(); --filled) text[text.size() - 1 - (from - filled)] = '=';
  return text;
}

std::optional<std::string> fromBase64(std::string_view text) {
  for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
  if (text.size() % 4 == 1) return {};
  std::string bytes(text.size() / 4 * 3 + (text.size() % 4 * 3) / 4, '\0');
  std::uint32_t wrong = 0;
  std::size_t from = 0, to = 0;
  for (; from + 4 <= text.size(); from += 4, to += 3) {
    const std::uint32_t a = valueOf(text[from]), b = valueOf(text[from + 1]), c = valueOf(text[from + 2]),
                        d = valueOf(text[from + 3]), bits = a << 18 | b << 12 | c << 6 | d;
    wrong |= a | b | c | d;
    bytes[to] = static_cast<char>(bits >> 16);
    bytes[to + 1] = static_cast<char>(bits >> 8);
    bytes[to + 2] = static_cast<char>(bits);
  }
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < 4 && from < text.size(); ++k) {
    const std::uint32_t value = from + k < text.size() ? valueOf(text[from + k]) : 0;
    wrong |= value;
    bits = bits << 6 | (value & 63);
  }
  for (int shift = 16; to < bytes.size(); shift -= 8) bytes[to++] = static_cast<char>(bits >> shift);
  if ((wrong & kNoSign) != 0) return {};
  return bytes;
}

}  // namespace hl
