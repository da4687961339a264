// hl bench: the time of a tick on this machine, by scene, size, motion and radius; on request beside other libraries.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "bench_output.h"
#include "body_bench.h"
#include "builtin.h"
#include "camera_bench.h"
#include "commands.h"
#include "io/load_scene.h"
#include "surface_bench.h"
#include "tick/interruptions.h"
#include "tick/peers/peers.h"
#include "tick/suite.h"
#include "value_checks.h"

namespace hl {

namespace {

constexpr double kSide_m = 0.2;  // of a scene from a file, as of the built-in ones
constexpr std::size_t kMin = 1000, kMaxMesh = 10'000'000, kMaxStored = 100'000'000'000;

struct SceneName {
  const char* name;
};
constexpr std::array<SceneName, 5> kScenes{{{"terrain"}, {"rough"}, {"sphere"}, {"soup"}, {"pits"}}};
const char* nameOf(SceneName scene) { return scene.name; }

constexpr std::array kHierarchies{HierarchyKind::kBvh, HierarchyKind::kSpheres, HierarchyKind::kNone};

constexpr const char* kNoPeers = "this hl was built without the libraries to compare with: run scripts/build --peers";

constexpr const char* kFooter =
    "Times in microseconds, each with the reading of the clock; every tick counts but those of the first approach.\n"
    "All is done three times, and of each tick or question the middle time counts; 1x: every single time, with what\n"
    "else the machine did then. tick: a whole tick of the proxy; near: the nearest primitive within 1.01 radii of\n"
    "where the proxy was; nearest: at any distance; finger: of the finger in place of the proxy;\n"
    "impact: the first impact of the sphere from one radius above the proxy to where the finger goes next.\n"
    "build 1, all: to build the hierarchy on one thread and on all, in ns for one primitive; bytes: of the hierarchy\n"
    "and of all, for one primitive; x plain: mean tick over that without effects; x tick, x query: median over that\n"
    "of HL's tick, and of HL's own query; wrong: answers more than 10 um from HL's, of those compared.\n";

struct BenchOptions {
  std::vector<std::string> scenes, motions, radii;  ///< empty: the usual ones
  std::vector<std::string> hierarchies{"bvh", "spheres", "none"};
  std::string file;
  double radius = 1e-3;
  double radius_edges = 1;
  std::size_t ticks = 20'000, most = 1'000'000, members = 1;
  bool all = false, peers = false, effects = true, bodies = false;
  std::optional<std::size_t> depth;   ///< pictures of a depth camera for each row; absent: not of a camera
  std::vector<std::string> surfaces;  ///< names of kSurfaceKinds; empty: meshes
  std::string csv;
};

// Those of `all` whose names were asked for; without a name the first, or with --all every one.
template <typename T, std::size_t N>
std::vector<T> chosen(const std::array<T, N>& all, const std::vector<std::string>& names, bool every) {
  if (names.empty()) return {all.begin(), every ? all.end() : all.begin() + 1};
  std::vector<T> result;
  for (const T& one : all) {
    if (std::find(names.begin(), names.end(), nameOf(one)) != names.end()) result.push_back(one);
  }
  return result;
}

bench::BenchScene builtinScene(const std::string& name, const std::string& member, const BenchOptions& options) {
  bench::BenchScene scene;
  scene.name = name + member;
  for (std::size_t size = kMin; size <= options.most; size *= 10) scene.sizes.push_back(size);
  scene.make = [name, member](std::size_t size) {
    return makeBuiltinScene(name + ":" + std::to_string(size) + member);
  };
  scene.effects = options.effects && name == "terrain";
  return scene;
}

// Read at once, so that a bad file is known before anything is measured.
bench::BenchScene fileScene(const std::string& file) {
  const auto model = std::make_shared<Model>(loadScene(file).model);
  if (model->elements() == 0) throw Error(file + ": nothing in it can be touched");
  fitModel(*model, kSide_m);
  bench::BenchScene scene;
  scene.name = file.substr(file.rfind('/') + 1);
  std::replace(scene.name.begin(), scene.name.end(), ',', '_');  // it becomes a field of the CSV
  scene.sizes = {model->elements()};
  scene.make = [model](std::size_t) { return *model; };
  return scene;
}

std::vector<bench::BenchScene> scenesOf(const BenchOptions& options) {
  std::vector<bench::BenchScene> scenes;
  // A file alone is measured alone.
  if (!options.scenes.empty() || options.all || options.file.empty()) {
    for (const SceneName name : chosen(kScenes, options.scenes, options.all)) {
      if (name.name != std::string_view("rough")) {
        scenes.push_back(builtinScene(name.name, "", options));
        continue;
      }
      for (std::size_t member = 1; member <= options.members; ++member)
        scenes.push_back(builtinScene(name.name, ":" + std::to_string(member), options));
    }
  }
  if (!options.file.empty()) scenes.push_back(fileScene(options.file));
  return scenes;
}

// What the machine itself adds to single times, and so to the longest of them.
std::string interruptionsNote() {
  const bench::Interruptions found = bench::measureInterruptions(1);
  const bench::Timing& gaps = found.gaps;
  if (gaps.count() == 0) return "this machine did not interrupt a busy thread for a second";
  return fmt::format(
      "this machine interrupts a busy thread {:.0f} times a second, for {:.0f} us in the median and {:.0f} us at most: "
      "that is in the columns 1x",
      static_cast<double>(gaps.count()) / found.seconds, gaps.median_us(), gaps.max_us());
}

void run(const BenchOptions& options) {
  const bool built_in = !bench::peers().empty();
  if (options.peers && !built_in) throw Error(kNoPeers);
  if (options.bodies) return runBodyBench(options.peers, options.csv);
  if (options.depth) return runCameraBench({*options.depth, options.csv});
  if (!options.surfaces.empty())
    return runSurfaceBench({options.surfaces, options.most, options.ticks, options.radius, options.csv});
  if (options.most > kMaxMesh) throw Error(fmt::format("--most: meshes are measured up to {} triangles", kMaxMesh));
  bench::SuitePlan plan;
  plan.scenes = scenesOf(options);
  plan.motions = chosen(bench::kFingerMotions, options.motions, options.all);
  plan.radii = chosen(bench::kRadiusModes, options.radii, options.all);
  plan.hierarchies = chosen(kHierarchies, options.hierarchies, true);
  plan.radius_m = options.radius;
  plan.radius_edges = options.radius_edges;
  plan.ticks = options.ticks;
  plan.peers = built_in && (options.peers || options.all);
  BenchOutput output(options.csv, options.file);
  output.note(interruptionsNote());
  if (options.all && !built_in) output.note(std::string("peers left out: ") + kNoPeers);
  runSuite(plan, output.sink());
}

template <typename T, std::size_t N>
void addListOption(CLI::App& command, const std::string& name, std::vector<std::string>& list,
                   const std::array<T, N>& all, const std::string& text) {
  std::vector<std::string> names(N);
  std::transform(all.begin(), all.end(), names.begin(), [](const T& one) { return nameOf(one); });
  command.add_option(name, list, text + ": " + fmt::format("{}", fmt::join(names, ",")))
      ->delimiter(',')
      ->check(CLI::IsMember(names))
      ->option_text("LIST");
}

void addWhatOptions(CLI::App& command, BenchOptions& options) {
  command.add_flag("--all", options.all, "every scene, motion and radius that is not chosen otherwise, and the peers");
  addListOption(command, "--scenes", options.scenes, kScenes,
                "built-in scenes, each in sizes of 1e3, 1e4, ... triangles (default: terrain)");
  command
      .add_option("--scene", options.file, "a model file, fitted to 0.2 m (alone, unless --scenes or --all are there)")
      ->option_text("FILE");
  command.add_option("--members", options.members, "how many of the terrains rough:N:1, rough:N:2, ... rough means")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  addListOption(command, "--motions", options.motions, bench::kFingerMotions,
                "how the finger moves, at 0.15 m/s and 1000 ticks a second (default: sliding)");
  addListOption(
      command, "--radii", options.radii, bench::kRadiusModes,
      "the radius of the proxy: --radius, or scaled with the mesh as --radius-edges says; zoomed: the finger's "
      "motion with it (default: fixed)");
  addListOption(command, "--hierarchies", options.hierarchies, kHierarchies,
                "beside the bvh for sliding with the fixed radius; none up to 10 000 triangles (default: all)");
  addListOption(command, "--surfaces", options.surfaces, kSurfaceKinds,
                "surfaces that are no meshes instead, up to --most; takes --radius, --ticks and --csv");
  command
      .add_option(
          "--depth", options.depth,
          "pictures of a depth camera instead, so many for each size and radius, with 33 ticks each; takes --csv")
      ->check(CLI::Range(std::size_t{10}, std::size_t{1'000'000}));
  command.add_flag("!--no-effects", options.effects,
                   "leave out the surface effects, which are measured for sliding on terrain with the fixed radius");
  command.add_flag(
      "--peers", options.peers,
      "Embree, CGAL, FCL and Bullet, on the same mesh and the same places; with --bodies Bullet, ODE and MuJoCo; built "
      "in by scripts/build --peers");
}

}  // namespace

void addBenchCommand(CLI::App& app) {
  auto* command = app.add_subcommand("bench", "the time of a tick on this machine against the number of primitives");
  auto options = std::make_shared<BenchOptions>();
  addWhatOptions(*command, *options);
  command->add_option("--radius", options->radius, "the fixed proxy radius in metres")
      ->check(within(kMinRadius_m, kMaxNumber))
      ->capture_default_str();
  command->add_option("--radius-edges", options->radius_edges, "the scaled proxy radius in mean edges of the mesh")
      ->check(within(kMinNumber, kMaxNumber))
      ->capture_default_str();
  command->add_option("--ticks", options->ticks, "ticks for each row")
      ->check(CLI::Range(100, 10'000'000))
      ->capture_default_str();
  command->add_option("--most", options->most, "largest number of triangles, samples or points")
      ->check(CLI::Range(kMin, kMaxStored))
      ->capture_default_str();
  command->add_option("--csv", options->csv, "also write the table to this file")->option_text("FILE");
  auto* bodies = command->add_flag("--bodies", options->bodies,
                                   "steps of bodies instead: a stack, a pile and a cube that a finger pushes");
  for (const CLI::Option* other : command->get_options()) {
    const std::string name = other->get_name();
    if (name != "--help" && name != "--csv" && name != "--peers" && name != "--bodies")
      bodies->excludes(command->get_option(name));
  }
  command->footer(kFooter);
  command->callback([options] { run(*options); });
}

}  // namespace hl
