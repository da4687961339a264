#include "scene_options.h"

#include <utility>

#include "base/error.h"
#include "builtin.h"
#include "choice_option.h"
#include "value_checks.h"

namespace hl {

void addSceneArgument(CLI::App& command, SceneOptions& options, bool required) {
  auto* argument = command.add_option(
      "scene", options.scene,
      std::string("a model file (obj, ply, stl, gltf, glb, x3d, wrl, ...), of CAD (step, iges, "
                  "brep), of heights (tif, hgt, asc, png, npy), of a volume (nii, nrrd, dcm, vdb), of "
                  "points (las, pcd, xyz, ply without faces) or a built-in scene: ") +
          kBuiltinScenes);
  if (required) {
    argument->required();
  } else {
    argument->capture_default_str();
  }
}

void addHierarchyOption(CLI::App& command, SceneOptions& options) {
  addChoice(command, "--hierarchy", options.hierarchy,
            {{"bvh", HierarchyKind::kBvh}, {"spheres", HierarchyKind::kSpheres}, {"none", HierarchyKind::kNone}},
            "how primitives near the proxy are found");
}

namespace {

void addCadOptions(CLI::App& command, CadMeshing& cad) {
  command
      .add_option("--deflection", cad.deflection_m,
                  "of a CAD file: distance in metres between its curved surfaces and the triangles made of them")
      ->check(within(kMinDeflection_m, kMaxDeflection_m))
      ->each([&cad](const std::string&) { cad.asked = true; })
      ->capture_default_str();
  command
      .add_option("--deflection-angle", cad.angle_rad,
                  "of a CAD file: largest angle in radians between neighbouring pieces of a curve")
      ->check(within(kMinAngle_rad, kMaxAngle_rad))
      ->capture_default_str();
}

}  // namespace

void addReadingOptions(CLI::App& command, SceneOptions& options) {
  command.add_option("--grid", options.grid, "name of a grid of an OpenVDB file, where it has several");
  command
      .add_option("--iso", options.iso,
                  "value at the surface of a volume, or several as in --iso=-300,400: in CT the skin and the bones "
                  "(default: between what is empty and what is not)")
      ->delimiter(',')
      ->allow_extra_args(false)  // a file may follow
      ->check(finite())
      ->option_text("FLOAT[,FLOAT]...");
  command
      .add_flag_function(
          "--below",
          [&options](std::int64_t said) { options.solid = said > 0 ? SolidSide::kBelow : SolidSide::kAbove; },
          "the matter of a volume is where its values are below --iso, as of signed distances (--below=false: above, "
          "as "
          "in CT; default: what the file says, or above)")
      ->check(passing([](const std::string& text) {
        if (text != "true" && text != "false") throw Error("'" + text + "' is neither true nor false");
      }));
  command
      .add_option("--vertical-scale", options.vertical_scale,
                  "factor on the heights of a height field, before --scale or --fit (default 1)")
      ->check(positive());
  auto* surfels =
      command.add_flag("--surfels", options.surfels, "make each point of a cloud a small disc across its normal");
  command.add_option("--surfel-reach", options.surfel_reach, "radius of the discs in distances between neighbours")
      ->check(within(0.01, 10))
      ->needs(surfels)
      ->capture_default_str();
  addCadOptions(command, options.cad);
}

void addSizeOptions(CLI::App& command, SceneOptions& options) {
  addReadingOptions(command, options);
  auto* scale =
      command.add_option("--scale", options.scale, "metres for one unit of the file (default 1)")->check(positive());
  command.add_option("--fit", options.fit, "scale and centre the model so that its largest side has this many metres")
      ->check(positive())
      ->excludes(scale);
}

void requireNoReading(const SceneOptions& options) {
  const SceneOptions defaults;
  const std::pair<bool, const char*> said[] = {
      {!options.grid.empty(), "--grid"},      {!options.iso.empty(), "--iso"},
      {options.solid.has_value(), "--below"}, {options.vertical_scale.has_value(), "--vertical-scale"},
      {options.surfels, "--surfels"},         {!(options.cad == defaults.cad), "--deflection"}};
  for (const auto& [is_said, name] : said) {
    if (is_said) throw Error(std::string(name) + " says how a scene is read, and there is none: say it with --scene");
  }
}

}  // namespace hl
