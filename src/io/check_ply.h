// What is asked of a PLY file before it is read: its reader waits for ever for the end of a header that is cut, and
// makes up the elements that are missing at the end of a file that is.
#pragma once

#include <string>

namespace hl {

/// Throws hl::Error for a file whose header does not end, one with fewer bytes, or in ASCII fewer lines, than its
/// elements need, and a file with elements that its reader does not know how to pass over.
void checkPly(const std::string& path);

}  // namespace hl
