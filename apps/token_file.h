// The file that holds the server's token.
#pragma once

#include <string>

namespace hl {

/// The first line of `file`, without the white space around it. Throws hl::Error when it cannot be read or checkToken()
/// refuses it.
std::string readTokenFile(const std::string& file);

/// Whether others than its owner and group may read the file: then its token is no secret on this machine.
bool isReadableByOthers(const std::string& file);

}  // namespace hl
