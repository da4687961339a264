#include "page/surface_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

namespace hl {

namespace {

constexpr std::size_t kMaxTexels = std::size_t{16} << 20;

std::shared_ptr<const Texture> shownTexture(const Material& material, const Surfaces& surfaces) {
  constexpr std::array<Quantity, kQuantities> kOrder{Quantity::kHeight, Quantity::kStaticFriction,
                                                     Quantity::kDynamicFriction, Quantity::kViscosity,
                                                     Quantity::kStiffness};
  for (const Quantity quantity : kOrder) {
    const TextureUse& use = material.textureOf(quantity);
    if (use.used() && surfaces.textures[use.texture]->texels.size() <= kMaxTexels)
      return surfaces.textures[use.texture];
  }
  return nullptr;
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

Look lookOf(const Shape& shape, const Surfaces& surfaces) {
  if (!shape.hasTexcoords() || surfaces.textures.empty()) return {};
  Look look;
  for (std::size_t i = 0; i < shape.model.materials.size(); ++i)
    look.push_back(shownTexture(surfaces.materials[i], surfaces));
  const bool plain = std::all_of(look.begin(), look.end(), [](const auto& texture) { return !texture; });
  return plain ? Look{} : look;
}

void addSurfaceImages(const Model& model, const Look& look, proto::SceneMesh& mesh) {
  if (look.empty()) return;
  std::map<const Texture*, std::uint32_t> image_of_texture;
  proto::SurfacePart* part = nullptr;
  std::size_t of_part = 0;  // material of the part in hand
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    const std::size_t material = model.triangle_materials.empty() ? 0 : model.triangle_materials[i];
    if (part != nullptr && material == of_part) {
      part->set_triangles(part->triangles() + 1);
      continue;
    }
    part = nullptr;
    const Texture* texture = look[material].get();
    if (texture == nullptr) continue;
    const auto [image, fresh] = image_of_texture.try_emplace(texture);
    if (fresh) image->second = addImage(*texture, mesh);
    part = mesh.add_parts();
    part->set_first_triangle(static_cast<std::uint32_t>(i));
    part->set_triangles(1);
    part->set_image(image->second);
    of_part = material;
  }
  if (mesh.parts_size() > 0) addTexcoords(model, mesh);
}

}  // namespace hl
