// Prototypes of an X3D file (ISO/IEC 19775-1, 4.4.4): each ProtoInstance becomes what its ProtoDeclare makes of it.
#pragma once

#include <string>
#include <vector>

#include "io/x3d_document.h"

namespace hl {

/// Instances of unknown prototypes, those of other files too, are left out with a warning. Names of the body of a
/// prototype become names of their own in each instance. Throws hl::Error where prototypes are nested too deep or make
/// too many nodes.
void expandPrototypes(X3dTree& tree, std::vector<std::string>& warnings);

}  // namespace hl
