#include "io/sha256.h"

#include <fmt/core.h>
#include <openssl/evp.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "base/plain_file.h"

namespace hl {

Sha256::Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
  if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) throw Error("there is no SHA-256");
}

void Sha256::add(const void* data, std::size_t bytes) { EVP_DigestUpdate(context_.get(), data, bytes); }

Digest256 Sha256::end() {
  Digest256 digest{};
  EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr);
  return digest;
}

std::string hexOf(const Digest256& digest) {
  std::string text;
  for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

std::string sha256Of(std::string_view text) {
  Sha256 sha;
  sha.add(text);
  return hexOf(sha.end());
}

std::string sha256OfFile(const std::string& path) {
  checkPlainFile(path);
  constexpr std::size_t kPiece_bytes = 1 << 20;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"), std::fclose);
  if (!file) throw Error(path + ": cannot be read: " + std::strerror(errno));
  Sha256 sha;
  std::vector<char> piece(kPiece_bytes);
  while (const std::size_t got = std::fread(piece.data(), 1, piece.size(), file.get())) sha.add(piece.data(), got);
  if (std::ferror(file.get()) != 0) throw Error(path + ": cannot be read: " + std::strerror(errno));
  return hexOf(sha.end());
}

}  // namespace hl
