#include "client/server_url.h"

#include <errno.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <string_view>

#include "base/error.h"

namespace hl::client {

namespace {

[[noreturn]] void fail(const std::string& what) { throw Error("the server's URL: " + what); }

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  fail("a '%' must be followed by two hexadecimal digits");
}

std::string percentDecoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    if (i + 2 >= text.size()) fail("a '%' must be followed by two hexadecimal digits");
    out += static_cast<char>(16 * hexDigit(text[i + 1]) + hexDigit(text[i + 2]));
    i += 2;
  }
  return out;
}

template <typename Number>
Number numberOf(const std::string& option, const std::string& text, Number least, Number most) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !(number >= least && number <= most))
    fail("'" + text + "' is not a value for " + option);
  return number;
}

bool flagOf(const std::string& option, const std::string& text) { return numberOf<int>(option, text, 0, 1) == 1; }

constexpr double kMostRate_Hz = 1e6;  // no server sends more: anything above is a slip of the pen
constexpr double kLongestTimeout_s = 1e6;

// The options by name; each writes its value into the URL.
const auto& options() {
  using Setter = std::function<void(ServerUrl&, const std::string&)>;
  static const std::map<std::string, Setter, std::less<>> all{
      {"name", [](ServerUrl& url, const std::string& value) { url.name = value; }},
      {"token", [](ServerUrl& url, const std::string& value) { url.token = value; }},
      {"ca", [](ServerUrl& url, const std::string& value) { url.ca_file = value; }},
      {"device",
       [](ServerUrl& url, const std::string& value) {
         url.device = numberOf<std::uint32_t>("device", value, 0, UINT32_MAX);
       }},
      {"master", [](ServerUrl& url, const std::string& value) { url.master = flagOf("master", value); }},
      {"keep", [](ServerUrl& url, const std::string& value) { url.keep = flagOf("keep", value); }},
      {"state_rate",
       [](ServerUrl& url, const std::string& value) {
         url.state_rate_Hz = numberOf<double>("state_rate", value, 0, kMostRate_Hz);
       }},
      {"timeout",
       [](ServerUrl& url, const std::string& value) {
         url.timeout_s = numberOf<double>("timeout", value, 0, kLongestTimeout_s);
       }},
  };
  return all;
}

void parseOptions(ServerUrl& url, std::string_view query) {
  while (!query.empty()) {
    const std::string_view option = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(option.size() + 1, query.size()));
    const std::size_t equals = option.find('=');
    const std::string_view name = option.substr(0, equals);
    const auto found = options().find(name);
    if (found == options().end() || equals == std::string_view::npos)
      fail("'" + std::string(option) +
           "' is not an option (name=, token=, device=, master=, keep=, state_rate=, timeout=, ca=)");
    found->second(url, percentDecoded(option.substr(equals + 1)));
  }
}

// host, host:port, [IPv6], [IPv6]:port
void parsePlace(ServerUrl& url, std::string_view place) {
  while (place.ends_with('/')) place.remove_suffix(1);
  std::size_t end = place.find(':');
  if (place.starts_with('[')) {
    const std::size_t close = place.find(']');
    if (close == std::string_view::npos) fail("a '[' without ']'");
    url.host = place.substr(1, close - 1);
    end = close + 1;
    if (end < place.size() && place[end] != ':') fail("only a port may follow ']'");
  } else {
    url.host = place.substr(0, end);
  }
  if (url.host.empty()) fail("there is no host in it");
  if (end < place.size()) url.port = numberOf<std::uint16_t>("the port", std::string(place.substr(end + 1)), 1, 65535);
}

}  // namespace

ServerUrl parseServerUrl(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || colon == 0) fail("it must begin with inproc:, hl:// or hls://");
  ServerUrl url;
  url.scheme = text.substr(0, colon);
  url.name = program_invocation_short_name;
  if (const char* token = std::getenv("HL_TOKEN")) url.token = token;
  std::string_view rest = std::string_view(text).substr(colon + 1);
  const std::size_t question = rest.find('?');
  if (question != std::string_view::npos) parseOptions(url, rest.substr(question + 1));
  rest = rest.substr(0, question);
  if (rest.starts_with("//")) {
    parsePlace(url, rest.substr(2));
  } else if (!rest.empty()) {
    fail("after '" + url.scheme + ":' comes '//' and a host, or '?' and options");
  }
  return url;
}

}  // namespace hl::client
