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
  return connectWebsocket({url.host, url.port, url.scheme == "hls"}, settings);
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
