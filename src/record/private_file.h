// Private files: without a name, for this user alone, and gone with their last owner.
#pragma once

#include <memory>

#include "base/open_file.h"

namespace hl {

using FilePointer = std::shared_ptr<const OpenFile>;

/// A new file in the folder for temporary ones. Throws hl::Error.
FilePointer makePrivateFile();

}  // namespace hl
