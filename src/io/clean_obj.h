// An OBJ file as its reader expects it: without a byte order mark, blanks before a line or a comment behind one. The
// reader leaves out lines that begin with blanks, and the first vertex after a mark, without a word.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hl {

/// The same lines without these; nothing where there are none.
std::optional<std::string> cleanedObj(std::string_view text);

}  // namespace hl
