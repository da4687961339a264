#include "page/surface_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <map>
#include <utility>

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

/// A texture that is felt, or a picture, or nothing.
struct ShownImage {
  const Texture* texture = nullptr;
  const Picture* picture = nullptr;
  auto operator<=>(const ShownImage&) const = default;
};

/// What each triangle shows.
class ShownImages {
 public:
  ShownImages(const Model& model, const Look& look)
      : model_(model), look_(look), pictures_(!model.appearance.pictures.empty() && !model.texcoords.empty()) {}

  bool none() const { return look_.empty() && !pictures_; }
  ShownImage of(std::size_t triangle) const {
    const std::size_t material = model_.triangle_materials.empty() ? 0 : model_.triangle_materials[triangle];
    if (!look_.empty() && look_[material]) return {look_[material].get(), nullptr};
    const Appearance& appearance = model_.appearance;
    if (!pictures_ || appearance.triangle_paints.empty()) return {};
    const auto picture = appearance.paints[appearance.triangle_paints[triangle]].picture;
    return {nullptr, picture ? &appearance.pictures[*picture] : nullptr};
  }

 private:
  const Model& model_;
  const Look& look_;
  const bool pictures_;
};

void writeTexture(const Texture& texture, proto::SurfaceImage& image) {
  image.set_width(static_cast<std::uint32_t>(texture.width));
  image.set_height(static_cast<std::uint32_t>(texture.height));
  std::string& texels = *image.mutable_texels();
  texels.reserve(texture.texels.size());
  for (const float texel : texture.texels) texels.push_back(static_cast<char>(std::lround(255 * texel)));
  image.set_clamp(texture.wrap == Wrap::kClamp);
  image.set_nearest(texture.filter == Filter::kNearest);
}

std::uint32_t addImage(const ShownImage& shown, proto::SceneMesh& mesh) {
  proto::SurfaceImage& image = *mesh.add_images();
  if (shown.texture != nullptr) {
    writeTexture(*shown.texture, image);
  } else {
    image.set_file(*shown.picture->file);
    image.set_clamp(shown.picture->wrap == Wrap::kClamp);
  }
  return static_cast<std::uint32_t>(mesh.images_size() - 1);
}

Rgb multiplied(const Rgb& a, const Rgb& b) {
  const auto part = [&](std::size_t i) { return static_cast<std::uint8_t>((a[i] * b[i] + 127) / 255); };
  return {part(0), part(1), part(2)};
}

void repeatVertex(Model& model, std::uint32_t v) {
  const auto repeat = [v](auto& list) {
    if (list.empty()) return;
    const auto item = list[v];
    list.push_back(item);
  };
  repeat(model.positions);
  repeat(model.normals);
  repeat(model.texcoords);
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
  const ShownImages shown(model, look);
  if (shown.none()) return;
  std::map<ShownImage, std::uint32_t> number_of;
  proto::SurfacePart* part = nullptr;
  ShownImage of_part;
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    const ShownImage image = shown.of(i);
    if (part != nullptr && image == of_part) {
      part->set_triangles(part->triangles() + 1);
      continue;
    }
    part = nullptr;
    if (image == ShownImage{}) continue;
    const auto [number, fresh] = number_of.try_emplace(image);
    if (fresh) number->second = addImage(image, mesh);
    part = mesh.add_parts();
    part->set_first_triangle(static_cast<std::uint32_t>(i));
    part->set_triangles(1);
    part->set_image(number->second);
    of_part = image;
  }
  if (mesh.parts_size() > 0) addTexcoords(model, mesh);
}

// A vertex of triangles of several colours is there once for each.
ColouredModel colouredModel(const Model& model) {
  const Appearance& appearance = model.appearance;
  const auto& paints = appearance.paints;
  const bool painted = std::any_of(paints.begin(), paints.end(), [](const Paint& p) { return p.colour != kWhite; });
  ColouredModel result;
  result.colours = appearance.vertex_colours;
  if (!painted || appearance.triangle_paints.empty()) return result;
  const std::size_t vertices = model.positions.size();
  result.colours.resize(vertices, kWhite);
  const std::vector<Rgb> own = result.colours;
  std::vector<std::uint8_t> coloured(vertices, 0);
  std::map<std::pair<std::uint32_t, Rgb>, std::uint32_t> again;
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = model.triangles[i][k];
      const Rgb colour = multiplied(own[v], paints[appearance.triangle_paints[i]].colour);
      if (!coloured[v] || result.colours[v] == colour) {
        coloured[v] = 1;
        result.colours[v] = colour;
        continue;
      }
      if (!result.model) result.model = model;
      const auto [copy, fresh] = again.try_emplace({v, colour}, static_cast<std::uint32_t>(result.colours.size()));
      if (fresh) {
        result.colours.push_back(colour);
        repeatVertex(*result.model, v);
      }
      result.model->triangles[i][k] = copy->second;
    }
  }
  return result;
}

}  // namespace hl
