// What the page shows of textures: an image for each material that has one, and which triangles show it.
#pragma once

#include <hl.pb.h>

#include "scene/model.h"

namespace hl {

/// Adds texture coordinates, images and parts to a scene that is sent to a page; nothing when no surface is textured.
/// Of a material's textures the first of height, frictions, viscosity and stiffness is shown; images of more than
/// 16 million texels are not.
void addSurfaceImages(const Model& model, proto::SceneMesh& mesh);

}  // namespace hl
