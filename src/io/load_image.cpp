#include "io/load_image.h"

#include <boost/gil.hpp>
#include <boost/gil/extension/io/jpeg.hpp>
#include <boost/gil/extension/io/png.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "base/error.h"
#include "io/file_ending.h"
#include "io/isolated.h"

namespace hl {

namespace {

namespace gil = boost::gil;

constexpr std::size_t kMostTexels = std::size_t{64} << 20;

void checkSize(std::size_t width, std::size_t height, std::size_t most_texels) {
  if (width == 0 || height == 0) throw Error("has no pixels");
  if (width > most_texels / height) throw Error("has more than " + std::to_string(most_texels) + " pixels");
}

// Sixteen bits a grey level hold both an 8-bit and a 16-bit file. Pictures run from the top row down, textures up.
template <typename Tag>
Texture decode(const std::string& path, Tag tag, std::size_t most_texels) {
  const auto info = gil::read_image_info(path, tag)._info;
  checkSize(info._width, info._height, most_texels);
  gil::gray16_image_t image;
  gil::read_and_convert_image(path, image, tag);
  const auto view = gil::flipped_up_down_view(gil::const_view(image));
  Texture texture;
  texture.width = static_cast<std::size_t>(view.width());
  texture.height = static_cast<std::size_t>(view.height());
  texture.texels.reserve(view.size());
  for (const gil::gray16_pixel_t& pixel : view) texture.texels.push_back(static_cast<float>(pixel[0]) / 65535.0f);
  return texture;
}

// libjpeg fills up what is missing of a torn file with grey and says nothing. The end marker must be there, and not
// only that of a thumbnail near the beginning.
void checkJpegEnds(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::size_t end = bytes.rfind("\xff\xd9");
  if (end == std::string::npos || end < bytes.size() / 2) throw Error("is torn: the end of the JPEG is missing");
}

Texture decodeImage(const std::string& path, std::size_t most_texels) {
  const std::string ending = endingOf(path);
  try {
    if (ending != ".png") checkJpegEnds(path);
    return ending == ".png" ? decode(path, gil::png_tag{}, most_texels) : decode(path, gil::jpeg_tag{}, most_texels);
  } catch (const Error&) {
    throw;
  } catch (const std::exception&) {
    throw Error(ending == ".png" ? "is not a sound PNG file" : "is not a sound JPEG file");
  }
}

void checkIsImage(const std::string& path) {
  const std::string ending = endingOf(path);
  if (ending != ".png" && ending != ".jpg" && ending != ".jpeg")
    throw Error(path + ": images must end in .png, .jpg or .jpeg");
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw Error(path + ": there is no such file");
}

}  // namespace

Texture readImage(const std::string& path) {
  checkIsImage(path);
  Texture texture = decodeImage(path, kMostTexels);
  texture.name = std::filesystem::path(path).filename().string();
  return texture;
}

Texture loadImage(const std::string& path) {
  checkIsImage(path);
  Model model = runIsolated(
      path, {},
      [&](const auto&) {
        Model carrier;
        carrier.textures.push_back(readImage(path));
        return carrier;
      },
      nullptr);
  if (model.textures.size() != 1) throw Error(path + ": its reader gave no picture");
  return std::move(model.textures.front());
}

}  // namespace hl
