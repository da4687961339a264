// An OFF file as its reader expects it. The reader makes up the vertices that a cut file lacks, takes an index beyond
// them for that of the last, and leaves out faces of more than nine corners, without a word; it takes comments between
// vertices for vertices, and needs the count of edges.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hl {

/// The same surface without comments and blank lines, with an edge count, and with faces of more than nine corners cut
/// into triangles; nothing where the text is so already. Throws hl::Error, with the line, for a text that has fewer
/// vertices or faces than its header tells of, or an index beyond the vertices. What follows the last face is left out
/// with a warning.
std::optional<std::string> plainOff(std::string_view text, std::vector<std::string>& warnings);

}  // namespace hl
