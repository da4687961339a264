#include "client/server_address.h"

#include "base/error.h"
#include "base/printable.h"
#include "base/url.h"

namespace hl {

std::string ServerAddress::text() const { return hostAndPort(host, port); }

ServerAddress parseServerAddress(const std::string& text) {
  checkPrintable(text, "an address");
  const auto refuse = [&](const std::string& why) {
    throw Error("'" + text + "' is no address of an HL server (" + why +
                "); write hl://HOST, hl://HOST:PORT, or hls://HOST with TLS");
  };
  Url url;
  try {
    url = parseUrl(text);
  } catch (const Error& error) {
    refuse(error.what());
  }
  if (url.scheme != "hl" && url.scheme != "hls") refuse("it does not begin with hl:// or hls://");
  if (!url.host) refuse("there is no host in it");
  if ((!url.path.empty() && url.path != "/") || !url.options.empty()) refuse("nothing follows the host and its port");
  ServerAddress address;
  address.host = *url.host;
  address.tls = url.scheme == "hls";
  if (url.port) address.port = *url.port;
  return address;
}

}  // namespace hl
