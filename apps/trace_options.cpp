#include "trace_options.h"

#include <map>

#include "surface_options.h"
#include "tools/tremor.h"
#include "value_checks.h"

namespace hl {

namespace {

void addPathOptions(CLI::App& command, TraceOptions& options) {
  command
      .add_option("--path", options.path,
                  "CSV with the header t,x,y,z[,qw,qx,qy,qz][,gripper_rad]: seconds, metres, radians; one row a tick")
      ->required();
  command
      .add_option("--tremor", options.tremor_m,
                  "root mean square in metres of a hand's tremor, 8 to 12 Hz, that is added to the path on each axis")
      ->check(within(0, kMaxTremor_m))
      ->capture_default_str();
  command.add_option("--seed", options.seed, "which tremor: each number draws another")
      ->check(CLI::Range(std::int64_t{0}, kMaxSeed))
      ->capture_default_str();
}

}  // namespace

void addTraceOptions(CLI::App& command, TraceOptions& options) {
  addSceneArgument(command, options.scene, true);
  addPathOptions(command, options);
  ProxySettings& proxy = options.settings.proxy;
  command.add_option("--radius", proxy.radius, "proxy radius in metres")
      ->check(within(kMinRadius_m, kMaxNumber))
      ->capture_default_str();
  command
      .add_option("--work-cap", proxy.work_cap,
                  "work after which a tick ends before its local minimum, for the next row to go on: in a live loop " +
                      std::to_string(ProxySettings{}.work_cap) + " (default: any)")
      ->check(CLI::Range(1, kNoWorkCap));
  command.add_option("--kp", proxy.spring_N_m, "spring of the servo in N/m")
      ->check(within(kMinNumber, kMaxNumber))
      ->capture_default_str();
  addSurfaceOptions(command, proxy.surfaces, proxy.ledger);
  const std::map<std::string, ShadingPasses> passes{{"converged", ShadingPasses::kConverged},
                                                    {"once", ShadingPasses::kOnce}};
  command.add_option("--shading-passes", proxy.shading, "how often the two passes of shading run in one tick")
      ->transform(oneOf(passes))
      ->option_text("converged|once (default: converged)");
  addSizeOptions(command, options.scene);
  addHierarchyOption(command, options.scene);
}

const TraceOptions& TraceWords::read(const std::vector<std::string>& words) {
  options_ = {};
  std::vector<std::string> last_first(words.rbegin(), words.rend());  // as CLI11 wants them
  app_.parse(last_first);
  return options_;
}

std::vector<std::string> TraceWords::names() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : app_.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  return names;
}

std::vector<PathSample> withTremor(std::vector<PathSample> path, const TraceOptions& options) {
  addTremor(path, options.tremor_m, static_cast<std::uint64_t>(options.seed));
  return path;
}

std::vector<PathSample> pathOf(const TraceOptions& options) { return withTremor(readPath(options.path), options); }

}  // namespace hl
