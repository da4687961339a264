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

}  // namespace hl
