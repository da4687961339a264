// What the page shows of textures: an image for each material that has one, and which triangles show it.
#pragma once

#include <hl.pb.h>

#include <memory>
#include <vector>

#include "scene/snapshot.h"

namespace hl {

/// The texture that each material of a shape shows, or none: of its textures the first of height, frictions, viscosity
/// and stiffness. Images of more than 16 million texels are not shown. Empty when no material shows any.
using Look = std::vector<std::shared_ptr<const Texture>>;
Look lookOf(const Shape& shape, const Surfaces& surfaces);

/// Adds texture coordinates, images and parts to a mesh that is sent to a page; nothing for an empty look.
void addSurfaceImages(const Model& model, const Look& look, proto::SceneMesh& mesh);

}  // namespace hl
