#include <fmt/core.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/machine_memory.h"
#include "base/plain_file.h"
#include "base/utf8.h"
#include "bodies/scene_world.h"
#include "builtin.h"
#include "commands.h"
#include "io/load_scene.h"

namespace hl {

namespace {

// A line that rewrites itself, on terminals only.
void showProgress(double fraction) {
  if (isatty(STDERR_FILENO) == 0) return;
  fmt::print(stderr, "\rreading: {:3.0f} %", 100 * fraction);
  if (fraction >= 1) fmt::print(stderr, "\r              \r");
  std::fflush(stderr);
}

template <typename Number>
bool parseNumber(const std::string& text, Number& value) {
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last;
}

}  // namespace

HierarchyKind hierarchyOf(const SceneOptions& options) {
  for (const HierarchyKind kind : {HierarchyKind::kSpheres, HierarchyKind::kNone}) {
    if (options.hierarchy == nameOf(kind)) return kind;
  }
  return HierarchyKind::kBvh;
}

void requireMemory(const SceneModel& scene, const std::string& name, std::uint64_t there_bytes) {
  const std::uint64_t needed = bytesToMake(scene);
  if (needed > there_bytes)
    throw Error(fmt::format("{}: this scene takes {:.1f} GB of memory, and there are {:.1f} GB", name,
                            1e-9 * static_cast<double>(needed), 1e-9 * static_cast<double>(there_bytes)));
}

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
  command.add_option("--hierarchy", options.hierarchy, "how primitives near the proxy are found")
      ->check(CLI::IsMember({"bvh", "spheres", "none"}))
      ->capture_default_str();
}

namespace {

void addCadOptions(CLI::App& command, CadMeshing& cad) {
  command
      .add_option("--deflection", cad.deflection_m,
                  "of a CAD file: distance in metres between its curved surfaces and the triangles made of them")
      ->check(within(kMinDeflection_m, kMaxDeflection_m))
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
  command.add_flag_function(
      "--below", [&options](std::int64_t said) { options.below = said > 0; },
      "the matter of a volume is where its values are below --iso, as of signed distances (--below=false: above, as in "
      "CT; default: what the file says, or above)");
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

void addSurfaceOptions(CLI::App& command, MaterialOverride& surfaces, LedgerMode& ledger) {
  const std::map<std::string, bool> shades{{"flat", false}, {"smooth", true}};
  const std::map<std::string, bool> switches{{"on", true}, {"off", false}};
  const std::map<std::string, LedgerMode> ledgers{
      {"tank", LedgerMode::kTank}, {"strict", LedgerMode::kStrict}, {"report", LedgerMode::kReport}};
  command.add_option("--shade", surfaces.smooth, "flat: true facets; smooth: forces along interpolated vertex normals")
      ->transform(oneOf(shades))
      ->option_text("flat|smooth (default: the scene's; flat for model files)");
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const QuantityInfo& info = kQuantityInfo[i];
    const std::string unit = *info.unit == 0 ? "" : std::string(" ") + info.unit;
    command.add_option(optionName(info), surfaces.number(i), info.words)
        ->check(within(0, std::min(info.most, kMaxNumber)))
        ->option_text(
            fmt::format("0..{:g}{} (default: the scene's; {:g} for model files)", info.most, unit, info.otherwise));
  }
  command.add_option("--textures", surfaces.textures, "read the scene's textures, or leave them out")
      ->transform(oneOf(switches))
      ->option_text("on|off (default: on)");
  command
      .add_option("--ledger", ledger, "energy that the surfaces may add: from a tank of 10 mJ, none, or any, counted")
      ->transform(oneOf(ledgers))
      ->option_text("tank|strict|report (default: tank)");
}

std::vector<std::string> warningsOf(const Snapshot& snapshot) {
  std::vector<std::string> warnings = snapshot.warnings, of_bodies = bodyWarnings(snapshot);
  warnings.insert(warnings.end(), of_bodies.begin(), of_bodies.end());
  return warnings;
}

std::uint64_t trianglesOf(const Shape& shape) {
  const bool counted = shape.source && shape.source->kind() == PrimitiveKind::kTriangle;
  return counted ? shape.elements() : shape.model.triangles.size();
}

void requireNoReading(const SceneOptions& options) {
  const SceneOptions defaults;
  const std::pair<bool, const char*> said[] = {
      {!options.grid.empty(), "--grid"},      {!options.iso.empty(), "--iso"},
      {options.below.has_value(), "--below"}, {options.vertical_scale > 0, "--vertical-scale"},
      {options.surfels, "--surfels"},         {!(options.cad == defaults.cad), "--deflection"}};
  for (const auto& [is_said, name] : said) {
    if (is_said) throw Error(std::string(name) + " says how a scene is read, and there is none: say it with --scene");
  }
}

namespace {

void requireCad(const Snapshot& snapshot, const std::string& name) {
  for (const Instance& instance : snapshot.instances) {
    if (instance.shape->model.reading.cad) return;
  }
  throw Error(name + ": there is no CAD file in it, which could have a deflection");
}

}  // namespace

std::shared_ptr<const Snapshot> loadSnapshot(const SceneOptions& options) {
  LoadOptions load;
  load.progress = showProgress;
  load.cad = options.cad;
  load.grid = options.grid;
  SceneModel scene = loadScene(options.scene, load);
  if (options.below) setSolidSide(scene, *options.below ? SolidSide::kBelow : SolidSide::kAbove);
  if (!options.iso.empty()) setIsoValues(scene, options.iso);  // a value may have a surface on one side only
  if (options.surfels) setSurfels(scene, options.surfel_reach);
  if (options.vertical_scale > 0) scaleHeights(scene, options.vertical_scale);
  if (options.scale > 0) scaleModel(scene, options.scale);
  if (options.fit > 0) fitModel(scene, options.fit);
  requireMemory(scene, options.scene, machineMemory_bytes());
  auto snapshot = makeSnapshot(std::move(scene), hierarchyOf(options));
  if (!options.opens_files && !(options.cad == CadMeshing{})) requireCad(*snapshot, options.scene);
  const std::string file = options.scene + ":";  // which those of a scene file begin with, and a line
  for (const std::string& warning : warningsOf(*snapshot))
    fmt::print(stderr, "{}\n", printable(warning.starts_with(file) ? warning : file + " " + warning));
  if (snapshot->primitives == 0) throw Error(options.scene + ": nothing in it can be touched");
  return snapshot;
}

CLI::Validator within(double least, double most) {
  const std::string range = fmt::format("{:g} to {:g}", least, most);
  return {[least, most, range](const std::string& text) {
            double value = 0;
            const bool good = parseNumber(text, value) && value >= least && value <= most;
            return good ? std::string() : "'" + text + "' is not a number from " + range;
          },
          range};
}

CLI::Validator whole(std::uint64_t least, std::uint64_t most) {
  const std::string range = fmt::format("{} to {}", least, most);
  return {[least, most, range](const std::string& text) {
            std::uint64_t value = 0;
            const bool good = parseNumber(text, value) && value >= least && value <= most;
            return good ? std::string() : "'" + text + "' is not a whole number from " + range;
          },
          most > std::numeric_limits<std::uint16_t>::max() ? fmt::format("from {}", least) : range};
}

std::string noneOf(const std::string& text, const std::string& words) { return "'" + text + "' is none of " + words; }

CLI::Validator passing(std::function<void(const std::string& text)> check) {
  return {[check = std::move(check)](const std::string& text) {
            try {
              check(text);
              return std::string();
            } catch (const Error& error) {
              return std::string(error.what());
            }
          },
          ""};
}

CLI::Validator plainFile() { return passing(checkPlainFile); }

std::string errorText(const CLI::ParseError& error) {
  constexpr std::string_view kTwice = ": At Most 1 required but received ", kNone = ": 1 required ",
                             kExtra = " not expected: ", kNoNumber = "Could not convert: ", kIs = " = ";
  const std::string text = error.what();
  if (const std::size_t at = text.find(kTwice); at != text.npos)
    return text.substr(0, at) + " is given " + text.substr(at + kTwice.size()) + " times: give it once";
  if (const std::size_t at = text.find(kNone); at != text.npos && text.ends_with(" missing"))
    return text.substr(0, at) + " needs a value";
  if (const std::size_t at = text.find(kIs); at != text.npos && text.starts_with(kNoNumber))
    return text.substr(kNoNumber.size(), at - kNoNumber.size()) + ": '" + text.substr(at + kIs.size()) +
           "' is not a number";
  const std::size_t at = text.find(kExtra);
  if (!text.starts_with("The following argument") || at == text.npos) return text;
  const std::string words = " " + text.substr(at + kExtra.size());  // the last one first
  const std::size_t option = words.find(" -");
  if (option == words.npos) return "'" + words.substr(1) + "' is too much here";
  return "there is no option '" + words.substr(option + 1, words.find(' ', option + 1) - option - 1) + "' here";
}

void refuseEmptyWords(CLI::App& app) {
  const auto check = [](const std::string& text) {
    return text.empty() ? std::string("it is empty: say what it is, or leave it out") : std::string();
  };
  for (CLI::Option* option : app.get_options()) option->check(CLI::Validator(check, ""));
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) refuseEmptyWords(*command);
}

CLI::Validator finite() {
  return {[](const std::string& text) {
            double value = 0;
            const bool good = parseNumber(text, value) && std::isfinite(value);
            return good ? std::string() : "'" + text + "' is not a number";
          },
          ""};
}

CLI::Validator positive() {
  return {[](const std::string& text) {
            double value = 0;
            const bool good = parseNumber(text, value) && std::isfinite(value) && value > 0;
            return good ? std::string() : "'" + text + "' is not a number above zero";
          },
          "POSITIVE"};
}

}  // namespace hl
