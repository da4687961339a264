#include "client/server_url.h"

#include <errno.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/printable.h"
#include "base/text.h"
#include "base/url.h"

namespace hl::client {

namespace {

[[noreturn]] void fail(const std::string& what) { throw Error("the server's URL: " + what); }

template <typename Number>
Number numberOf(const std::string& option, const std::string& text, Number least, Number most) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !(number >= least && number <= most))
    fail("'" + text + "' is not a value for " + option);
  return number;
}

bool flagOf(const std::string& option, const std::string& text) { return numberOf<int>(option, text, 0, 1) == 1; }

constexpr double kMaxRate_Hz = 1e6;  // no server sends more: what is above was not meant
constexpr double kLongestTimeout_s = 1e6;

// The options by name; each writes its value into the URL.
const auto& options() {
  using Setter = std::function<void(ServerUrl&, const std::string&)>;
  static const std::map<std::string, Setter, std::less<>> all{
      {"name", [](ServerUrl& url, const std::string& value) { url.name = value; }},
      {"token", [](ServerUrl& url, const std::string& value) { url.token = value; }},
      {"ca", [](ServerUrl& url, const std::string& value) { url.ca_file = value; }},
      {"sim", [](ServerUrl& url, const std::string& value) { url.sim = value; }},
      {"device",
       [](ServerUrl& url, const std::string& value) {
         const bool is_label = !value.empty() && isLetter(value.front());
         if (is_label)
           url.device_label = value;
         else
           url.device = numberOf<std::uint32_t>("device", value, 0, UINT32_MAX);
       }},
      {"master", [](ServerUrl& url, const std::string& value) { url.master = flagOf("master", value); }},
      {"keep", [](ServerUrl& url, const std::string& value) { url.keep = flagOf("keep", value); }},
      {"state_rate",
       [](ServerUrl& url, const std::string& value) {
         url.state_rate_Hz = numberOf<double>("state_rate", value, 0, kMaxRate_Hz);
       }},
      {"timeout",
       [](ServerUrl& url, const std::string& value) {
         url.timeout_s = numberOf<double>("timeout", value, 0, kLongestTimeout_s);
       }},
  };
  return all;
}

void parseOptions(ServerUrl& url, const std::vector<UrlOption>& given) {
  std::set<std::string> seen;
  for (const UrlOption& option : given) {
    if (!seen.insert(option.name).second) fail("the option " + option.name + " is there twice");
    const auto found = options().find(option.name);
    if (found == options().end())
      fail("'" + option.name +
           "' is not an option (name=, token=, device=, master=, keep=, state_rate=, timeout=, ca=, sim=)");
    if (!option.value) fail("the option " + option.name + " has no value: write " + option.name + "=");
    found->second(url, *option.value);
  }
}

Url urlOf(const std::string& text) {
  try {
    return parseUrl(text);
  } catch (const Error& error) {
    fail(error.what());
  }
}

}  // namespace

ServerUrl parseServerUrl(const std::string& text) {
  checkPrintable(text, "an address");
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || colon == 0) fail("it must begin with inproc:, hl:// or hls://");
  const Url parts = urlOf(text);
  ServerUrl url;
  url.scheme = parts.scheme;
  url.name = program_invocation_short_name;
  if (const char* token = std::getenv("HL_TOKEN")) url.token = token;
  if (parts.host) url.host = *parts.host;
  if (parts.port) url.port = *parts.port;
  const bool far = url.scheme == "hl" || url.scheme == "hls";
  if (far && parts.host && !parts.path.empty() && parts.path != "/")
    fail("an address of a server has no path: leave '" + parts.path + "' out");
  if ((!parts.host || url.scheme == "inproc") && !parts.path.empty())
    fail("after '" + url.scheme + ":' comes '//' and a host, or '?' and options");
  parseOptions(url, parts.options);
  if (!url.sim.empty() && (url.scheme == "hl" || url.scheme == "hls"))
    fail("the option sim is for inproc: alone; elsewhere the server has its device already");
  return url;
}

}  // namespace hl::client
