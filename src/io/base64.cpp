#include "io/base64.h"

#include <openssl/evp.h>

#include <cstddef>

namespace hl {

namespace {

// OpenSSL counts in int.
constexpr std::size_t kPiece_bytes = std::size_t{3} << 24, kPieceText_bytes = kPiece_bytes / 3 * 4;

unsigned char* unsignedOf(char* data) { return reinterpret_cast<unsigned char*>(data); }
const unsigned char* unsignedOf(const char* data) { return reinterpret_cast<const unsigned char*>(data); }

// Whole groups of four signs to `out`. False: there is another character among them. Blanks, which OpenSSL leaves out
// at both ends, leave too few bytes.
bool decodeGroups(std::string_view text, char* out) {
  for (std::size_t at = 0; at < text.size(); at += kPieceText_bytes) {
    const std::string_view piece = text.substr(at, kPieceText_bytes);
    const auto bytes = static_cast<std::ptrdiff_t>(piece.size() / 4 * 3);
    if (EVP_DecodeBlock(unsignedOf(out), unsignedOf(piece.data()), static_cast<int>(piece.size())) != bytes)
      return false;
    out += bytes;
  }
  return true;
}

}  // namespace

std::string toBase64(std::string_view bytes) {
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // with the zero that OpenSSL writes behind
  std::size_t to = 0;
  for (std::size_t at = 0; at < bytes.size(); at += kPiece_bytes) {
    const std::string_view piece = bytes.substr(at, kPiece_bytes);
    to += static_cast<std::size_t>(
        EVP_EncodeBlock(unsignedOf(text.data() + to), unsignedOf(piece.data()), static_cast<int>(piece.size())));
  }
  text.resize(to);
  return text;
}

// OpenSSL takes a '=' anywhere.
std::optional<std::string> fromBase64(std::string_view text) {
  for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
  if (text.size() % 4 == 1 || text.find('=') != std::string_view::npos) return {};
  const std::size_t whole = text.size() / 4 * 4;
  std::string bytes(whole / 4 * 3, '\0');
  if (!decodeGroups(text.substr(0, whole), bytes.data())) return {};
  if (whole == text.size()) return bytes;
  std::string last(text.substr(whole)), group(3, '\0');
  last.resize(4, '=');
  if (!decodeGroups(last, group.data())) return {};
  return bytes + group.substr(0, text.size() - whole - 1);
}

}  // namespace hl
