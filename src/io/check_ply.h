// What is asked of a PLY file before it is read: its reader waits for ever for the end of a header that is cut, and
// makes up the elements that are missing at the end of one in ASCII.
#pragma once

#include <string>

namespace hl {

/// Throws hl::Error for a file whose header does not end, or an ASCII file with fewer lines than elements.
void checkPly(const std::string& path);

}  // namespace hl
