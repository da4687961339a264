// Patches in messages of proto/hl.proto, and the triangles that they make.
#pragma once

#include <hl.pb.h>

#include "scene/model.h"
#include "surfaces/patch_mesh.h"

namespace hl {

/// How the patches of these primitives are divided; an empty plan if there are none. Throws hl::Error, with the path of
/// what is wrong from "patches[2]" on.
PatchPlan planOf(const proto::Primitives& in);

/// Triangles with the normals of their surfaces and texture coordinates of 0..1 on each patch; its reading has the
/// error.
Model modelOf(const PatchPlan& plan);

}  // namespace hl
