// hl trace: feels a scene along a recorded finger path, offline. The contract is docs/trace.md.
#include <fmt/core.h>

#include "commands.h"
#include "io/trace_csv.h"
#include "load_snapshot.h"
#include "standard_streams.h"
#include "trace_options.h"

namespace hl {

namespace {

struct TraceCall {
  TraceOptions options;
  std::string out;
};

void printEndings(const EndingCounts& ended) {
  const char* separator = "ticks that ended:";
  ended.each([&](Ending ending, std::uint64_t count) {
    if (count == 0) return;
    tell("{} {} {}", separator, nameOf(ending), count);
    separator = ",";
  });
  tell("\n");
}

void printLedger(const Ledger& ledger) {
  tell("energy: {:.6g} mJ injected, {:.6g} mJ dissipated", 1e3 * ledger.injected_J, 1e3 * ledger.dissipated_J);
  for (std::size_t i = 0; i < kEnergyCauses; ++i) {
    if (ledger.by_cause_J[i] > 0) tell("; {} {:.6g} mJ", kEnergyCauseNames[i], 1e3 * ledger.by_cause_J[i]);
  }
  tell("\n");
}

// How their energy has changed since the first row, and by what.
void printBodies(std::size_t bodies, const TraceTotals& totals) {
  const TracedWorld &before = totals.before, &after = totals.after;
  const EnergyBook& book = after.book;
  tell(
      "{} bodies: kinetic energy {:+.6g} mJ, gravity {:+.6g} mJ; by hand {:.6g} mJ; lost in contacts {:.6g} mJ, "
      "by friction {:.6g} mJ; by the finite step {:+.6g} mJ",
      bodies, 1e3 * (after.kinetic_J - before.kinetic_J), 1e3 * (after.gravity_J - before.gravity_J),
      1e3 * book.by_hand_J, 1e3 * book.contact_J, 1e3 * book.friction_J, 1e3 * book.solver_J);
  const double springs_J = after.spring_J - before.spring_J;
  if (springs_J != 0 || book.joint_J() != 0)
    tell("; springs {:+.6g} mJ; lost in joints {:.6g} mJ", 1e3 * springs_J, 1e3 * book.joint_J());
  tell("\n");
  if (totals.returned > 0) tell("{} times a body left the scene and was put back\n", totals.returned);
}

void run(const TraceCall& call) {
  const TraceOptions& options = call.options;
  const std::vector<PathSample> path = pathOf(options);
  const auto snapshot = loadSnapshot(options.scene);
  const std::vector<std::string> bodies = tracedBodies(*snapshot);
  const PathSample& first = path.front();
  const TraceColumns columns{bodies, tracedJoints(*snapshot), !snapshot->snaps.empty(), first.turned.has_value(),
                             first.gripper_rad.has_value()};
  TraceWriter writer(call.out, {options.scene.scene, options.path}, columns);
  const TraceTotals totals =
      runTrace(*snapshot, options.settings, path, [&](const TraceRow& row) { writer.write(row); });
  writer.close();
  tell("{} ticks, {} in contact, {} stopped at the iteration cap, {} without a clear place\n", totals.ticks,
       totals.contacts, totals.ended.capped(), totals.ended[Ending::kUnplaced]);
  printEndings(totals.ended);
  printLedger(totals.ledger);
  if (!bodies.empty()) printBodies(bodies.size(), totals);
}

}  // namespace

void addTraceCommand(CLI::App& app) {
  auto* command = app.add_subcommand("trace", "feel a scene along a recorded finger path, offline and deterministic");
  auto call = std::make_shared<TraceCall>();
  addTraceOptions(*command, call->options);
  command->add_option("--out", call->out, "CSV to write, one row for each row of the path")->required();
  command->callback([call] { run(*call); });
}

}  // namespace hl
