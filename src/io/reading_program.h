// Programs of their own that read what few need and what takes large libraries: hl-cad, hl-vdb.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hl {

/// The first file of this name that may be run: beside this program, or where the shell would look. Throws hl::Error
/// with `otherwise` if there is none.
std::string readingProgram(const std::string& name, const std::string& otherwise);

}  // namespace hl
