// Images for textures: PNG and JPEG, as grey levels.
#pragma once

#include <cstddef>
#include <string>

#include "scene/texture.h"

namespace hl {

/// Reads a .png, .jpg or .jpeg file; colours become their luminance, transparency is left out, 16-bit PNG keeps its
/// depth. The lowest row of the picture is v = 0. Decodes in a child process, like model files. Throws hl::Error.
Texture loadImage(const std::string& path);

/// The same, in a process that reads a foreign file already (isolated.h).
Texture readImage(const std::string& path);

}  // namespace hl
