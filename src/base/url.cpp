#include "base/url.h"

#include <boost/url/params_encoded_view.hpp>
#include <boost/url/parse.hpp>
#include <boost/url/url_view.hpp>
#include <charconv>

#include "base/error.h"

namespace hl {

namespace urls = boost::urls;

namespace {

std::uint16_t portOf(const urls::url_view& url) {
  const std::string digits(url.port());  // its number of Boost 1.81 wraps around
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (error != std::errc() || end != digits.data() + digits.size() || port == 0)
    throw Error("the port must be a number from 1 to 65535");
  return port;
}

std::string hostOf(const urls::url_view& url) {
  if (url.has_userinfo()) throw Error("no user belongs before the host");
  std::string host = url.host_address();
  if (host.empty()) throw Error("there is no host in it");
  return host;
}

// The iterators of Boost 1.81 do not end where '?' has nothing behind it but a fragment.
urls::params_encoded_view optionsOf(const urls::url_view& url) {
  return url.encoded_query().empty() ? urls::params_encoded_view() : url.encoded_params();
}

}  // namespace

Url parseUrl(std::string_view text) {
  const auto parsed = urls::parse_uri({text.data(), text.size()});
  if (!parsed) throw Error("it is no URL: SCHEME://HOST:PORT?NAME=VALUE, with '%' and two digits for other characters");
  Url url;
  url.scheme = parsed->scheme();
  url.path = parsed->encoded_path();
  if (parsed->has_authority()) url.host = hostOf(*parsed);
  if (parsed->has_port()) url.port = portOf(*parsed);
  if (parsed->has_fragment()) throw Error("a '#' does not belong in it; write %23");
  for (const auto& option : optionsOf(*parsed)) {
    UrlOption& out = url.options.emplace_back();
    out.name = option.key.decode();
    if (option.has_value) out.value = option.value.decode();
  }
  return url;
}

std::string hostAndPort(const std::string& host, std::uint16_t port) {
  const bool v6 = host.find(':') != std::string::npos;
  return (v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

std::string queryValue(std::string_view target, std::string_view name) {
  const auto parsed = urls::parse_uri_reference({target.data(), target.size()});
  if (!parsed) return {};
  for (const auto& option : optionsOf(*parsed)) {
    if (option.key == urls::string_view(name.data(), name.size())) return std::string(option.value);
  }
  return {};
}

std::string queryBytes(std::string_view target, std::string_view name) {
  const std::string value = queryValue(target, name);
  return urls::pct_string_view(value).decode();
}

std::optional<std::string> percentDecoded(std::string_view text) {
  const auto checked = urls::make_pct_string_view(text);
  if (!checked) return std::nullopt;
  return checked->decode();
}

}  // namespace hl
