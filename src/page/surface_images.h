// What the page shows on the triangles of a mesh: textures that are felt, else the pictures and colours of its file.
#pragma once

#include <hl.pb.h>

#include <memory>
#include <optional>
#include <vector>

#include "scene/snapshot.h"

namespace hl {

/// The texture that each material of a shape shows, or none: of its textures the first of height, frictions, viscosity
/// and stiffness. Images of more than 16 million texels are not shown. Empty when no material shows any.
using Look = std::vector<std::shared_ptr<const Texture>>;
Look lookOf(const Shape& shape, const Surfaces& surfaces);

/// Adds texture coordinates, images and parts to a mesh that is sent to a page, where it has any.
void addSurfaceImages(const Model& model, const Look& look, proto::SceneMesh& mesh);

/// A model as its file colours it.
struct ColouredModel {
  std::optional<Model> model{};  ///< absent: as it was; else some vertices are there again, for other colours
  std::vector<Rgb> colours{};    ///< one for each vertex; empty: the file says none
};
ColouredModel colouredModel(const Model& model);

}  // namespace hl
