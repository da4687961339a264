// Vectors as numbers in a row, for structures of hl_web.h.
#pragma once

#include <algorithm>

#include "base/vec.h"

namespace hl {

/// Behind the last of them.
inline double* put(double* out, const Vec3& v) { return std::copy(v.data(), v.data() + 3, out); }

}  // namespace hl
