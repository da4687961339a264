#include "http/access.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/crypto.h>
#include <openssl/sha.h>

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "io/sha256.h"

namespace hl {

namespace {

constexpr std::size_t kMinToken = 16;  // characters: 96 bits when random
constexpr std::size_t kMaxToken = 256;
// So that the cookie's value is not the token's own digest.
constexpr std::string_view kCookieSalt = "hl page cookie of ";
constexpr std::string_view kBlank = " ";  // around a token in a header

bool isTokenCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
         c == '~' || c == '-';
}

}  // namespace

bool isLoopbackHost(std::string_view host, unsigned port) {
  const std::string suffix = ":" + std::to_string(port);
  if (!host.ends_with(suffix)) return false;
  host.remove_suffix(suffix.size());
  if (host == "localhost" || host == "[::1]") return true;
  in_addr address{};  // any of 127.0.0.0/8, but no name: one may lead anywhere
  return inet_pton(AF_INET, std::string(host).c_str(), &address) == 1 && ntohl(address.s_addr) >> 24 == IN_LOOPBACKNET;
}

void checkToken(std::string_view token) {
  if (token.size() < kMinToken || token.size() > kMaxToken || !std::ranges::all_of(token, isTokenCharacter)) {
    throw Error("a token is 16 to 256 characters of A-Z a-z 0-9 . _ ~ -; make one with: openssl rand -hex 32");
  }
}

Access::Access(const AccessSettings& settings) : settings_(settings) {
  settings_.token.clear();
  if (!settings.token.empty()) setToken(settings.token);
}

bool Access::allowsHost(std::string_view host) const {
  return !settings_.loopback || isLoopbackHost(host, settings_.port);
}

bool Access::allowsOrigin(std::string_view origin, std::string_view host) const {
  if (origin.empty()) return true;
  const std::string_view scheme = settings_.tls ? "https://" : "http://";
  if (!origin.starts_with(scheme)) return false;
  origin.remove_prefix(scheme.size());
  return settings_.loopback ? isLoopbackHost(origin, settings_.port) : origin == host;
}

bool Access::wantsToken() const {
  const std::scoped_lock lock(mutex_);
  return wants_token_;
}

bool Access::allowsToken(std::string_view token) const {
  const Digest given = digestOf(token);
  const std::scoped_lock lock(mutex_);
  return !wants_token_ || CRYPTO_memcmp(given.data(), token_.data(), given.size()) == 0;
}

bool Access::allowsBearer(std::string_view authorization) const {
  constexpr std::string_view kScheme = "bearer ";
  const bool is_bearer = lowered(authorization.substr(0, kScheme.size())) == kScheme;  // RFC 9110, 11.1
  if (!is_bearer) return !wantsToken();
  return allowsToken(trimmed(authorization.substr(kScheme.size()), kBlank));
}

// The port is part of the name: browsers share cookies between the ports of a host.
std::string Access::cookieName() const { return "hl_page_" + std::to_string(settings_.port); }

std::string Access::cookie() const {
  const std::scoped_lock lock(mutex_);
  return cookieName() + "=" + cookie_value_ + "; Path=/; HttpOnly; SameSite=Strict" + (settings_.tls ? "; Secure" : "");
}

bool Access::allowsCookies(std::string_view cookies) const {
  const std::string wanted = cookieName() + "=";
  const std::scoped_lock lock(mutex_);
  if (!wants_token_) return true;
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find(';'), cookies.size());
    const std::string_view one = trimmed(cookies.substr(0, end), kBlank);
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
    if (!one.starts_with(wanted)) continue;
    const Digest given = digestOf(one.substr(wanted.size()));
    const Digest right = digestOf(cookie_value_);
    if (CRYPTO_memcmp(given.data(), right.data(), given.size()) == 0) return true;
  }
  return false;
}

void Access::setToken(const std::string& token) {
  checkToken(token);
  const Digest digest = digestOf(token);
  const Digest cookie = digestOf(std::string(kCookieSalt) + token);
  const std::scoped_lock lock(mutex_);
  wants_token_ = true;
  token_ = digest;
  cookie_value_ = hexOf(cookie);
}

Access::Digest Access::digestOf(std::string_view text) {
  Digest digest;
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data());
  return digest;
}

}  // namespace hl
