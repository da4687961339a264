#include "client/open_link.h"

#include <map>
#include <mutex>
#include <utility>

#include "base/error.h"

namespace hl::client {

namespace {

struct Openers {
  std::mutex mutex;
  std::map<std::string, LinkOpener> by_scheme;
};

Openers& openers() {
  static Openers all;
  return all;
}

std::string knownSchemes(const Openers& all) {
  std::string names;
  for (const auto& [scheme, opener] : all.by_scheme) names += (names.empty() ? "" : ", ") + scheme + ":";
  return names.empty() ? "none" : names;
}

}  // namespace

void setLinkOpener(const std::string& scheme, LinkOpener opener) {
  Openers& all = openers();
  const std::lock_guard lock(all.mutex);
  if (opener) {
    all.by_scheme[scheme] = std::move(opener);
  } else {
    all.by_scheme.erase(scheme);
  }
}

std::unique_ptr<Link> openLink(const ServerUrl& url) {
  LinkOpener opener;
  {
    Openers& all = openers();
    const std::lock_guard lock(all.mutex);
    const auto found = all.by_scheme.find(url.scheme);
    if (found == all.by_scheme.end())
      throw Error("this program has no way to a server at '" + url.scheme + ":' (it has: " + knownSchemes(all) + ")");
    opener = found->second;
  }
  return opener(url);
}

}  // namespace hl::client
