// Pictures of textures and models. The first byte chooses PNG or JPEG.
#include "io/load_image.h"
#include "refusal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string path = hl::fuzz::fileOf(data[0] % 2 == 0 ? "a.png" : "a.jpg", data + 1, size - 1);
  hl::fuzz::takes([&] {
    const hl::Texture texture = hl::readImage(path);
    hl::fuzz::require(texture.width > 0 && texture.texels.size() == texture.width * texture.height);
    for (const float texel : texture.texels) hl::fuzz::require(texel >= 0 && texel <= 1);
  });
  hl::fuzz::takes([&] {
    const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
    hl::fuzz::require(*hl::checkedPicture(bytes) == bytes);
  });
  return 0;
}
