// LZF, the packing of PCD files: runs of bytes as they are, and copies of what came before (M. Lehmann, LibLZF).
#pragma once

#include <span>

namespace hl {

/// Unpacks all of `packed` into all of `out`. Throws hl::Error if one does not fit the other.
void unpackLzf(std::span<const char> packed, std::span<char> out);

}  // namespace hl
