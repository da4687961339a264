// An STL file as its reader expects it. The reader takes the facets that are there when a text is cut, leaves out the
// fourth vertex of a facet and everything of a binary file that has bytes behind its triangles.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hl {

/// The same file without what follows the triangles of a binary one, which is left out with a warning; nothing where it
/// is so already. Throws hl::Error for a binary file that is shorter than its header tells, and for a text without its
/// end or with a facet of not three vertices. A file is a text unless it has a byte of zero near its begin, as the
/// headers of binary ones may say "solid" too.
std::optional<std::string> plainStl(std::string_view file, std::vector<std::string>& warnings);

}  // namespace hl
