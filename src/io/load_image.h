// Images for textures: PNG and JPEG, as grey levels.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "scene/texture.h"

namespace hl {

/// Reads a .png, .jpg or .jpeg file; colours become their luminance, transparency is left out, 16-bit PNG keeps its
/// depth. The lowest row of the picture is v = 0. Decodes in a child process, like model files. Throws hl::Error.
/// `progress` is called with fractions of the decoding, 0..1.
Texture loadImage(const std::string& path, const std::function<void(double fraction)>& progress = nullptr);

/// Pixels.
struct ImageSize {
  std::size_t width = 0, height = 0;
};
/// By the header of a PNG or JPEG file, whatever its name. Throws hl::Error for other bytes.
ImageSize sizeOfImage(const std::string& bytes);

/// The bytes of such a file, for pages to show: at most 8192 pixels a side. Throws hl::Error for others.
std::shared_ptr<const std::string> checkedPicture(std::string bytes);
/// The same of a file, which a child process looks at.
std::shared_ptr<const std::string> loadPicture(const std::string& path);

/// The same as loadImage(), in a process that reads a foreign file already (isolated.h).
Texture readImage(const std::string& path, const std::function<void(double fraction)>& progress = nullptr);

}  // namespace hl
