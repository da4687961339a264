#include "io/decode_patches.h"

#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"

namespace hl {

namespace {

constexpr double kMinPatchError_m = 1e-9, kMaxPatchError_m = 1e9;

NurbsPatch patchOf(const proto::Patch& in) {
  const auto numbers = [](int count) { return std::to_string(count); };
  if (in.points_size() % 3 != 0) throw Error("points must hold 3 numbers each");
  const int count = in.points_size() / 3;
  if (in.weights_size() != 0 && in.weights_size() != count)
    throw Error("weights must be " + numbers(count) + ", one for each control point, not " +
                numbers(in.weights_size()));
  NurbsPatch patch{in.order_u(),
                   in.order_v(),
                   {},
                   {in.knots_u().begin(), in.knots_u().end()},
                   {in.knots_v().begin(), in.knots_v().end()}};
  patch.points.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    patch.points.push_back(
        {{in.points(3 * i), in.points(3 * i + 1), in.points(3 * i + 2)}, in.weights_size() == 0 ? 1 : in.weights(i)});
  return patch;
}

}  // namespace

PatchPlan planOf(const proto::Primitives& in) {
  const double error_m = in.patch_error();
  if (error_m != 0 && !(error_m >= kMinPatchError_m && error_m <= kMaxPatchError_m))
    throw Error("patchError must be from 1e-9 to 1e9");
  std::vector<NurbsPatch> patches;
  patches.reserve(static_cast<std::size_t>(in.patches_size()));
  for (int i = 0; i < in.patches_size(); ++i) {
    try {
      patches.push_back(patchOf(in.patches(i)));
    } catch (const Error& error) {
      throw Error("patches[" + std::to_string(i) + "]: " + error.what());
    }
  }
  return planPatches(patches, error_m);
}

Model modelOf(const PatchPlan& plan) {
  PatchMesh mesh = meshPatches(plan);
  Model model;
  model.positions = std::move(mesh.positions);
  model.normals = std::move(mesh.normals);
  model.texcoords = std::move(mesh.texcoords);
  model.triangles = std::move(mesh.triangles);
  model.reading.patch_error_m = mesh.error_m;
  return model;
}

}  // namespace hl
