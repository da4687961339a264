// Makes every way to a server known to hlCreateContext. Linked as an object, so that it is there without being called.
#include "client/inproc_link.h"
#include "client/open_link.h"
#include "client/websocket_link.h"

namespace hl::client {

namespace {

std::unique_ptr<Link> openWebsocket(const ServerUrl& url) {
  WebsocketLinkSettings settings;
  settings.ca_file = url.ca_file;
  settings.connect_s = url.timeout_s;
  const std::string host = url.host.find(':') == std::string::npos ? url.host : "[" + url.host + "]";
  return connectWebsocket(url.scheme + "://" + host + ":" + std::to_string(url.port), settings);
}

struct AllLinks {
  AllLinks() {
    setLinkOpener("inproc", openInproc);
    setLinkOpener("hl", openWebsocket);
    setLinkOpener("hls", openWebsocket);
  }
};

const AllLinks kAllLinks;

}  // namespace

}  // namespace hl::client
