// SHA-256, by OpenSSL: names what something was made from, and shows whether what is there is whole.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace hl {

using Digest256 = std::array<unsigned char, 32>;

class Sha256 {
 public:
  /// Throws hl::Error where OpenSSL has none.
  Sha256();
  void add(const void* data, std::size_t bytes);
  void add(std::string_view text) { add(text.data(), text.size()); }
  /// Of all that was added. Once.
  Digest256 end();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// 64 hexadecimal digits.
std::string hexOf(const Digest256& digest);
/// hexOf() the digest of `text`.
std::string sha256Of(std::string_view text);
/// The same of the bytes of a file, as sha256sum has it. Throws hl::Error, with the file's name, if it cannot be read.
std::string sha256OfFile(const std::string& path);

}  // namespace hl
