// Idle settings: what a material says that nobody can feel on the surface that has it. It is harmless, but hardly
// meant, so it is a warning, the same for scene files, model files and frames of clients.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "scene/material.h"
#include "scene/model.h"
#include "scene/shape.h"
#include "scene/texture.h"

namespace hl {

/// What a surface has for the textures of its material.
struct TextureRoom {
  bool triangles = false;  ///< segments and points have no texture coordinates
  bool texcoords = false;
  Vec2 extent = Vec2::Zero();  ///< by how much the texture coordinates of its triangles differ, along u and v
};

/// Of the triangles that have the material of this number. Linear in triangles.
TextureRoom roomOn(const Model& model, std::size_t material);
/// Of all its triangles.
TextureRoom roomOn(const Model& model);
TextureRoom roomOn(const Shape& shape);

/// The texture of one quantity.
struct UsedTexture {
  std::string name;
  const Texture* image = nullptr;  ///< null: it is not known here
};

struct IdleSetting {
  std::optional<Quantity> texture{};  ///< the texture of this quantity is felt nowhere; none: it is of another setting
  std::string words;                  ///< such as "its height texture 'cloth' is not felt: low and high are equal"
};

/// `texture_of` is asked for the quantities that have a texture. Linear in the texels of a height map that is flat.
std::vector<IdleSetting> idleSettings(const Material& material, const TextureRoom& room,
                                      const std::function<UsedTexture(Quantity)>& texture_of);

/// The same for the textures of a list. Those that are felt nowhere are taken out of the material.
std::vector<IdleSetting> leaveIdleOut(Material& material, const TextureRoom& room,
                                      const std::vector<Texture>& textures);

/// Of a model of which each material is used by its own triangles; the words are added to its warnings.
void leaveIdleOut(Model& model);

}  // namespace hl
