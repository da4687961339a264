#include "client/server_address.h"

#include <charconv>
#include <string_view>

#include "base/error.h"

namespace hl {

namespace {

[[noreturn]] void refuse(const std::string& url) {
  throw Error("'" + url + "' is no address of an HL server; write hl://HOST, hl://HOST:PORT, or hls://HOST with TLS");
}

bool takePrefix(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

}  // namespace

std::string ServerAddress::text() const {
  const bool v6 = host.find(':') != std::string::npos;
  return (v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

ServerAddress parseServerAddress(const std::string& url) {
  ServerAddress address;
  std::string_view rest = url;
  address.tls = takePrefix(rest, "hls://");
  if (!address.tls && !takePrefix(rest, "hl://")) refuse(url);
  if (rest.ends_with('/')) rest.remove_suffix(1);
  const std::size_t bracket = rest.starts_with('[') ? rest.find(']') : std::string_view::npos;
  if (rest.starts_with('[') && bracket == std::string_view::npos) refuse(url);
  const std::size_t colon = rest.find(':', bracket == std::string_view::npos ? 0 : bracket);
  const std::string_view host = rest.substr(0, colon);
  address.host = bracket == std::string_view::npos ? host : host.substr(1, bracket - 1);
  if (address.host.empty() || host.find_first_of("/?#@ ") != std::string_view::npos) refuse(url);
  if (bracket != std::string_view::npos && host.size() != bracket + 1) refuse(url);
  if (colon == std::string_view::npos) return address;
  const std::string_view port = rest.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (error != std::errc() || end != port.data() + port.size() || address.port == 0) refuse(url);
  return address;
}

}  // namespace hl
