// hl trace: feels a scene along a recorded finger path, offline. The contract is docs/trace.md.
#include <fmt/core.h>

#include <map>

#include "commands.h"
#include "io/trace_csv.h"
#include "tools/trace.h"

namespace hl {

namespace {

struct TraceOptions {
  SceneOptions scene;
  std::string path;
  std::string out;
  TraceSettings settings;
};

void printEndings(const EndingCounts& ended) {
  const char* separator = "ticks that ended:";
  ended.each([&](Ending ending, std::uint64_t count) {
    if (count == 0) return;
    fmt::print(stderr, "{} {} {}", separator, nameOf(ending), count);
    separator = ",";
  });
  fmt::print(stderr, "\n");
}

void printLedger(const Ledger& ledger) {
  fmt::print(stderr, "energy: {:.6g} mJ injected, {:.6g} mJ dissipated", 1e3 * ledger.injected_J,
             1e3 * ledger.dissipated_J);
  for (std::size_t i = 0; i < kEnergyCauses; ++i) {
    if (ledger.by_cause_J[i] > 0)
      fmt::print(stderr, "; {} {:.6g} mJ", kEnergyCauseNames[i], 1e3 * ledger.by_cause_J[i]);
  }
  fmt::print(stderr, "\n");
}

// How their energy has changed since the first row, and by what.
void printBodies(std::size_t bodies, const TraceTotals& totals) {
  const TracedWorld &before = totals.before, &after = totals.after;
  const EnergyBook& book = after.book;
  fmt::print(stderr,
             "{} bodies: kinetic energy {:+.6g} mJ, gravity {:+.6g} mJ; by hand {:.6g} mJ; lost in contacts {:.6g} mJ, "
             "by friction {:.6g} mJ; by the finite step {:+.6g} mJ\n",
             bodies, 1e3 * (after.kinetic_J - before.kinetic_J), 1e3 * (after.gravity_J - before.gravity_J),
             1e3 * book.by_hand_J, 1e3 * book.contact_J, 1e3 * book.friction_J, 1e3 * book.solver_J);
  if (totals.returned > 0) fmt::print(stderr, "{} times a body left the scene and was put back\n", totals.returned);
}

void run(const TraceOptions& options) {
  const std::vector<PathSample> path = readPath(options.path);
  const auto snapshot = loadSnapshot(options.scene);
  const std::vector<std::string> bodies = tracedBodies(*snapshot);
  TraceWriter writer(options.out, {options.scene.scene, options.path}, bodies, !snapshot->snaps.empty());
  const TraceTotals totals =
      runTrace(*snapshot, options.settings, path, [&](const TraceRow& row) { writer.write(row); });
  writer.close();
  fmt::print(stderr, "{} ticks, {} in contact, {} stopped at the iteration cap, {} without a clear place\n",
             totals.ticks, totals.contacts, totals.ended.capped(), totals.ended[Ending::kUnplaced]);
  printEndings(totals.ended);
  printLedger(totals.ledger);
  if (!bodies.empty()) printBodies(bodies.size(), totals);
}

}  // namespace

void addTraceCommand(CLI::App& app) {
  auto* command = app.add_subcommand("trace", "feel a scene along a recorded finger path, offline and deterministic");
  auto options = std::make_shared<TraceOptions>();
  addSceneArgument(*command, options->scene, true);
  command->add_option("--path", options->path, "CSV with the header t,x,y,z: seconds and metres, one row a tick")
      ->required();
  command->add_option("--out", options->out, "CSV to write, one row for each row of the path")->required();
  command->add_option("--radius", options->settings.proxy.radius, "proxy radius in metres")
      ->check(within(kMinRadius_m, kMaxNumber))
      ->capture_default_str();
  command
      ->add_option("--work-cap", options->settings.proxy.work_cap,
                   "work after which a tick ends before its local minimum, for the next row to go on: in a live loop " +
                       std::to_string(ProxySettings{}.work_cap) + " (default: any)")
      ->check(CLI::Range(1, kNoWorkCap));
  command->add_option("--kp", options->settings.proxy.spring_N_m, "spring of the servo in N/m")
      ->check(within(kMinNumber, kMaxNumber))
      ->capture_default_str();
  addSurfaceOptions(*command, options->settings.proxy.surfaces, options->settings.proxy.ledger);
  const std::map<std::string, ShadingPasses> passes{{"converged", ShadingPasses::kConverged},
                                                    {"once", ShadingPasses::kOnce}};
  command
      ->add_option("--shading-passes", options->settings.proxy.shading,
                   "how often the two passes of shading run in one tick")
      ->transform(CLI::CheckedTransformer(passes))
      ->option_text("converged|once (default: converged)");
  addSizeOptions(*command, options->scene);
  addHierarchyOption(*command, options->scene);
  command->callback([options] { run(*options); });
}

}  // namespace hl
