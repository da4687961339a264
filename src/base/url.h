// Url: the parts of SCHEME://HOST:PORT/PATH?NAME=VALUE&..., taken apart by Boost.URL (RFC 3986): where a server is, and
// what is wanted of it. The one place where addresses that people write are read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hl {

struct UrlOption {
  std::string name;
  std::optional<std::string> value;  ///< percent signs decoded; absent where there is no '='
};

struct Url {
  std::string scheme;
  std::optional<std::string> host;  ///< an IPv6 address without its brackets; absent without "//"
  std::optional<std::uint16_t> port;
  std::string path;
  std::vector<UrlOption> options;
};

/// Throws hl::Error with the fault alone: the text is not repeated, as it may hold a token.
Url parseUrl(std::string_view text);

/// host:port as people write it, with the brackets of an IPv6 address.
std::string hostAndPort(const std::string& host, std::uint16_t port);

/// The value of `name` in the target of an HTTP request, such as "/?a=1&token=abc"; percent signs stay as they are.
/// Empty when it is not there.
std::string queryValue(std::string_view target, std::string_view name);
/// The same with percent signs decoded: any bytes.
std::string queryBytes(std::string_view target, std::string_view name);
/// With each percent sign and its two digits as the byte that they mean; nothing where some have no digits.
std::optional<std::string> percentDecoded(std::string_view text);

}  // namespace hl
