// Static files of the page: from a request target to a file, its MIME type, or a refusal.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hl {

struct StaticFile {
  std::string content;
  std::string mime;
};

/// The file under `folder` for a target such as "/assets/x.js?y" ("/" is index.html); nothing when it does not exist or
/// the target tries to leave the folder ("..", "%", backslashes and hidden files are refused).
std::optional<StaticFile> readStaticFile(const std::string& folder, std::string_view target);

/// What is shown when the page has not been built.
std::string missingPageNotice();

/// True for a Host of this machine's loopback with this port: 127.0.0.1, localhost or [::1].
bool isLoopbackHost(std::string_view host, unsigned port);
/// True for an absent (empty) Origin or the page's own.
bool isOwnOrigin(std::string_view origin, unsigned port);

}  // namespace hl
