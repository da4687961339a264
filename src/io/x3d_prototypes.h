// Prototypes of an X3D file (ISO/IEC 19775-1, 4.4.4): each ProtoInstance becomes what its ProtoDeclare makes of it.
#pragma once

#include <string>
#include <vector>

namespace hl {

/// The same document without prototypes; the text itself where there are none. Instances of unknown ones, those of
/// other files too, are left out with a warning. Names of the body of a prototype become names of their own in each
/// instance. Throws hl::Error, one line, for prototypes in what is no XML, that are nested too deep or make too many
/// nodes.
std::string withoutPrototypes(const std::string& text, std::vector<std::string>& warnings);

}  // namespace hl
