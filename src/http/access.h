// Access: who may talk to this server. On loopback the Host and Origin must be this machine's; beyond it TLS proves the
// server, a token proves the client, and the Origin must be the page's own.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace hl {

/// True for a Host of this machine's loopback with this port: 127.0.0.1, localhost or [::1].
bool isLoopbackHost(std::string_view host, unsigned port);

/// A token is at least 16 characters of A-Z a-z 0-9 . _ ~ -, so that it fits into an address as it is. Throws hl::Error
/// that says so, but never shows the token.
void checkToken(std::string_view token);

struct AccessSettings {
  bool loopback = true;  ///< the server listens on loopback only
  bool tls = false;
  std::uint16_t port = 0;
  std::string token;  ///< empty: none is asked for
};

/// Any thread.
class Access {
 public:
  /// Throws hl::Error for a token that checkToken refuses.
  explicit Access(const AccessSettings& settings);

  /// On loopback only a loopback Host with this port: a foreign name that resolves to 127.0.0.1 is not ours.
  bool allowsHost(std::string_view host) const;
  /// Absent (programs), or the page's own: the scheme and Host of this very server.
  bool allowsOrigin(std::string_view origin, std::string_view host) const;

  bool wantsToken() const;
  /// In constant time. True also when no token is asked for.
  bool allowsToken(std::string_view token) const;
  /// The token of "Authorization: Bearer TOKEN", for programs that read /metrics.
  bool allowsBearer(std::string_view authorization) const;

  /// A Set-Cookie value that stands for the token; it does not contain it.
  std::string cookie() const;
  /// Whether a Cookie header holds that cookie. True also when no token is asked for.
  bool allowsCookies(std::string_view cookies) const;

  /// From now on this token counts, and cookies made of the one before do not. Sessions that are open stay. Throws
  /// hl::Error for a token that checkToken refuses; then the one before stays.
  void setToken(const std::string& token);

 private:
  using Digest = std::array<unsigned char, 32>;
  static Digest digestOf(std::string_view text);
  std::string cookieName() const;

  AccessSettings settings_;   // but for the token
  mutable std::mutex mutex_;  // guards what follows
  bool wants_token_ = false;
  Digest token_{};  // SHA-256: equal lengths to compare, and no token in memory dumps
  std::string cookie_value_;
};

}  // namespace hl
