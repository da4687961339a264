// Inline nodes of an X3D file (ISO/IEC 19775-1, 9.4.2): each becomes a group of what the scene of its file has.
#pragma once

#include <string>
#include <vector>

#include "io/model_file.h"

namespace hl {

/// The same document without Inline nodes of X3D files that lie beside `file` or in a folder beneath; the text itself
/// where there are none. Those of other files, and all where the file comes alone, are left out with a warning. The
/// names of an inlined file are its own. Throws hl::Error, one line, for files that contain themselves or are nested
/// too deep, that are no XML, or make too many nodes.
std::string withInlines(const ModelFile& file, const std::string& text, std::vector<std::string>& warnings);

}  // namespace hl
