// Plain files: what a person names is looked at before it is read. A folder has nothing to be read, and a device or a
// pipe may have no end.
#pragma once

#include <optional>
#include <string>

namespace hl {

/// Throws hl::Error, the name and what is wrong with it, unless it is a plain file that may be read.
void checkPlainFile(const std::string& path);
/// All bytes of a plain file; none where it cannot be opened.
std::optional<std::string> contentOf(const std::string& path);

}  // namespace hl
