#include "server/surface_images.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>

namespace hl {

namespace {

constexpr std::size_t kMostTexels = std::size_t{16} << 20;

std::uint32_t shownTexture(const Model& model, const Material& material) {
  constexpr std::array<Quantity, kQuantities> kOrder{Quantity::kHeight, Quantity::kStaticFriction,
                                                     Quantity::kDynamicFriction, Quantity::kViscosity,
                                                     Quantity::kStiffness};
  for (const Quantity quantity : kOrder) {
    const TextureUse& use = material.textureOf(quantity);
    if (use.used() && model.textures[use.texture].texels.size() <= kMostTexels) return use.texture;
  }
  return TextureUse::kNone;
}

std::uint32_t addImage(const Texture& texture, proto::SceneMesh& mesh) {
  proto::SurfaceImage& image = *mesh.add_images();
  image.set_width(static_cast<std::uint32_t>(texture.width));
  image.set_height(static_cast<std::uint32_t>(texture.height));
  std::string& texels = *image.mutable_texels();
  texels.reserve(texture.texels.size());
  for (const float texel : texture.texels) texels.push_back(static_cast<char>(std::lround(255 * texel)));
  image.set_clamp(texture.wrap == Wrap::kClamp);
  image.set_nearest(texture.filter == Filter::kNearest);
  return static_cast<std::uint32_t>(mesh.images_size() - 1);
}

void addTexcoords(const Model& model, proto::SceneMesh& mesh) {
  std::string& bytes = *mesh.mutable_texcoords();
  bytes.reserve(2 * sizeof(float) * model.texcoords.size());
  for (const Vec2& uv : model.texcoords) {
    const std::array<float, 2> pair{static_cast<float>(uv.x()), static_cast<float>(uv.y())};
    bytes.append(reinterpret_cast<const char*>(pair.data()), sizeof pair);
  }
}

}  // namespace

void addSurfaceImages(const Model& model, proto::SceneMesh& mesh) {
  if (model.texcoords.empty()) return;
  std::map<std::uint32_t, std::uint32_t> image_of_texture;
  proto::SurfacePart* part = nullptr;
  std::size_t of_part = 0;  // material of the part in hand
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    const std::size_t material = model.triangle_materials.empty() ? 0 : model.triangle_materials[i];
    if (part != nullptr && material == of_part) {
      part->set_triangles(part->triangles() + 1);
      continue;
    }
    part = nullptr;
    const std::uint32_t texture = shownTexture(model, model.materials[material]);
    if (texture == TextureUse::kNone) continue;
    const auto [image, fresh] = image_of_texture.try_emplace(texture);
    if (fresh) image->second = addImage(model.textures[texture], mesh);
    part = mesh.add_parts();
    part->set_first_triangle(static_cast<std::uint32_t>(i));
    part->set_triangles(1);
    part->set_image(image->second);
    of_part = material;
  }
  if (mesh.parts_size() > 0) addTexcoords(model, mesh);
}

}  // namespace hl
