#include "io/utf8.h"

namespace hl {

namespace {

struct DecodedPoint {
  std::uint32_t point;
  std::size_t bytes;
};

constexpr std::uint32_t kPayload = 0x3f;  // of a byte that continues

// How many bytes follow this one; 4: it begins none.
unsigned followersOf(unsigned char lead) {
  if (lead < 0x80) return 0;
  if (lead >= 0xc2 && lead < 0xe0) return 1;
  if (lead >= 0xe0 && lead < 0xf0) return 2;
  return lead >= 0xf0 && lead < 0xf5 ? 3 : 4;
}

DecodedPoint pointAt(std::string_view text, std::size_t at) {
  constexpr DecodedPoint kNone{'?', 1};
  constexpr std::uint32_t kLeast[] = {0, 0x80, 0x800, 0x10000}, kLast = 0x10ffff;
  const auto lead = static_cast<unsigned char>(text[at]);
  const unsigned followers = followersOf(lead);
  if (followers > 3 || at + followers >= text.size()) return kNone;
  std::uint32_t point = followers == 0 ? lead : lead & (kPayload >> followers);
  for (unsigned i = 1; i <= followers; ++i) {
    const auto byte = static_cast<unsigned char>(text[at + i]);
    if ((byte & 0xc0U) != 0x80) return kNone;
    point = point << 6U | (byte & kPayload);
  }
  const bool surrogate = point >= 0xd800 && point < 0xe000;
  return point < kLeast[followers] || point > kLast || surrogate ? kNone : DecodedPoint{point, followers + 1U};
}

}  // namespace

std::vector<std::uint32_t> codePointsOf(std::string_view text) {
  std::vector<std::uint32_t> points;
  for (std::size_t at = 0; at < text.size();) {
    const DecodedPoint decoded = pointAt(text, at);
    points.push_back(decoded.point);
    at += decoded.bytes;
  }
  return points;
}

std::string utf8Of(const std::vector<std::uint32_t>& points) {
  std::string text;
  for (const std::uint32_t point : points) {
    const auto continued = [&](unsigned shift) { text += static_cast<char>(0x80U | (point >> shift & kPayload)); };
    if (point < 0x80) {
      text += static_cast<char>(point);
    } else if (point < 0x800) {
      text += static_cast<char>(0xc0U | point >> 6U);
      continued(0);
    } else if (point < 0x10000) {
      text += static_cast<char>(0xe0U | point >> 12U);
      continued(6);
      continued(0);
    } else {
      text += static_cast<char>(0xf0U | point >> 18U);
      continued(12);
      continued(6);
      continued(0);
    }
  }
  return text;
}

}  // namespace hl
