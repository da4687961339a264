#include "scene/idle_settings.h"

#include <algorithm>
#include <sstream>

#include "scene/bump_gain.h"

namespace hl {

namespace {

std::string nameOf(Quantity quantity) {
  return quantity == Quantity::kHeight ? "height" : plainName(kQuantityInfo[static_cast<std::size_t>(quantity)]);
}

template <typename Has>
TextureRoom roomOf(const Model& model, const Has& has) {
  TextureRoom room;
  room.texcoords = !model.texcoords.empty();
  Eigen::AlignedBox2d covered;
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    if (!has(i)) continue;
    room.triangles = true;
    for (const std::uint32_t vertex : model.triangles[i]) {
      if (vertex < model.texcoords.size()) covered.extend(model.texcoords[vertex]);  // of a skipped one it may not be
    }
  }
  if (!covered.isEmpty()) room.extent = covered.sizes();
  return room;
}

// Why nobody can feel a bump map on a surface that has texture coordinates; empty: it is felt.
std::string whyFlat(const TextureUse& use, const Texture* image, const Vec2& extent) {
  if (use.low == use.high) return "low and high are equal";
  if (extent == Vec2(0, 0)) return "the texture coordinates are all equal";
  if (image == nullptr) return "";
  const auto& texels = image->texels;
  if (std::all_of(texels.begin(), texels.end(), [&](float texel) { return texel == texels.front(); }))
    return "its texels are all equal";
  if (hasSlope(*image, extent)) return "";
  if (!hasSlope(*image, {1, 1})) return "its pattern is narrower than 2 texels, and comes out flat";
  return std::string("it changes only along ") + (extent.x() == 0 ? "u" : "v") + ", and the texture coordinates do not";
}

std::string whyIdle(Quantity quantity, const TextureUse& use, const Texture* image, const TextureRoom& room) {
  if (!room.triangles) return "only triangles have texture coordinates, and there are none";
  if (!room.texcoords) return "there are no texture coordinates";
  return quantity == Quantity::kHeight ? whyFlat(use, image, room.extent) : "";
}

std::string wordsOfLowStatic(double fixed, double dynamic) {
  std::ostringstream words;
  words << "its static friction of " << fixed << " is below its dynamic friction of " << dynamic
        << ", and counts as that";
  return words.str();
}

// Of what is no texture. `felt`: whether a texture of the quantity is.
template <typename Felt>
void addIdleNumbers(const Material& material, const Felt& felt, std::vector<IdleSetting>& idle) {
  const bool rough = felt(Quantity::kStaticFriction) || felt(Quantity::kDynamicFriction) || felt(Quantity::kViscosity);
  if (material.stribeck_m_s > 0 && rough)
    idle.push_back({{}, "its Stribeck speed has no effect beside a texture of friction or viscosity"});
  const double fixed = material.static_friction, dynamic = material.dynamic_friction;
  if (fixed > 0 && fixed < dynamic && !felt(Quantity::kStaticFriction) && !felt(Quantity::kDynamicFriction))
    idle.push_back({{}, wordsOfLowStatic(fixed, dynamic)});
  if (material.strength_N > 0 && material.stiffness == 0 && !felt(Quantity::kStiffness))
    idle.push_back({{}, "its strength has no effect: nothing presses on a surface of stiffness 0"});
}

}  // namespace

TextureRoom roomOn(const Model& model, std::size_t material) {
  const auto& numbers = model.triangle_materials;
  return roomOf(model, [&](std::size_t i) { return (numbers.empty() ? 0 : numbers[i]) == material; });
}

TextureRoom roomOn(const Model& model) {
  return roomOf(model, [](std::size_t) { return true; });
}

TextureRoom roomOn(const Shape& shape) {
  if (!shape.source) return roomOn(shape.model);
  return {true, shape.source->hasTexcoords(), shape.repeat.cwiseAbs()};
}

std::vector<IdleSetting> idleSettings(const Material& material, const TextureRoom& room,
                                      const std::function<UsedTexture(Quantity)>& texture_of) {
  std::vector<IdleSetting> idle;
  for (std::size_t i = 0; i < kQuantities; ++i) {
    const auto quantity = static_cast<Quantity>(i);
    const TextureUse& use = material.textureOf(quantity);
    if (!use.used()) continue;
    const UsedTexture used = texture_of(quantity);
    const std::string why = whyIdle(quantity, use, used.image, room);
    if (why.empty()) continue;
    idle.push_back({quantity, "its " + nameOf(quantity) + " texture '" + used.name + "' is not felt: " + why});
  }
  const auto felt = [&](Quantity quantity) {
    return material.textureOf(quantity).used() &&
           std::none_of(idle.begin(), idle.end(), [&](const IdleSetting& one) { return one.texture == quantity; });
  };
  addIdleNumbers(material, felt, idle);
  return idle;
}

std::vector<IdleSetting> leaveIdleOut(Material& material, const TextureRoom& room,
                                      const std::vector<Texture>& textures) {
  const std::vector<IdleSetting> idle = idleSettings(material, room, [&](Quantity quantity) {
    const Texture& texture = textures[material.textureOf(quantity).texture];
    return UsedTexture{texture.name, &texture};
  });
  for (const IdleSetting& one : idle) {
    if (one.texture) material.textureOf(*one.texture) = {};
  }
  return idle;
}

void leaveIdleOut(Model& model) {
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    Material& material = model.materials[i];
    const auto used = [](const TextureUse& use) { return use.used(); };
    if (std::none_of(material.textures.begin(), material.textures.end(), used)) continue;
    for (const IdleSetting& one : leaveIdleOut(material, roomOn(model, i), model.textures))
      model.warnings.push_back("material " + std::to_string(i) + ": " + one.words);
  }
}

}  // namespace hl
