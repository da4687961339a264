// Which link brings the messages to a server: by the scheme of its URL. The calls know no link, so that a program
// links only those it uses.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "client/server_url.h"
#include "wire/link.h"

namespace hl::client {

/// Opens a link; may wait up to the URL's timeout; throws hl::Error with one line that says why it cannot.
using LinkOpener = std::function<std::unique_ptr<Link>(const ServerUrl&)>;

/// From now on `opener` opens the links of `scheme`; an empty one: nobody does. Any thread.
void setLinkOpener(const std::string& scheme, LinkOpener opener);

/// Throws hl::Error. Any thread.
std::unique_ptr<Link> openLink(const ServerUrl& url);

}  // namespace hl::client
