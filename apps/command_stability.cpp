// hl stability: how stiff a simulated device lets a surface be, by rate, delay, grip and damping.
#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "io/output_file.h"
#include "stability_on_bodies.h"
#include "standard_streams.h"
#include "tools/stability.h"
#include "value_checks.h"

namespace hl {

namespace {

constexpr double kUsualRate_Hz = 1000;

struct StabilityOptions {
  std::vector<std::string> devices{"premium1.0"}, grips{"light", "firm"};
  std::vector<double> rates_Hz;
  std::vector<int> delays;
  std::vector<double> dampings_Ns_m{0}, bodies_kg;
  double jitter_us = 0;
  bool bends = false, quick = false, theory = false;
  std::string csv;
};

struct StabilityRow {
  StabilityCase loop;
  double one_by_one_N_m = 0, together_N_m = 0;
};

struct RateAndDelay {
  double rate_Hz;
  int delay;
};

// --rates and --delays, or the usual ones.
std::vector<double> ratesOf(const StabilityOptions& options) {
  return options.rates_Hz.empty() ? std::vector{kUsualRate_Hz} : options.rates_Hz;
}
std::vector<int> delaysOf(const StabilityOptions& options) {
  return options.delays.empty() ? std::vector{0} : options.delays;
}

// Without --rates and --delays every usual rate without delay, and every usual delay at the usual rate.
std::vector<RateAndDelay> ratesAndDelays(const StabilityOptions& options) {
  if (options.rates_Hz.empty() && options.delays.empty())
    return {{500, 0}, {1000, 0}, {2000, 0}, {4000, 0}, {1000, 1}, {1000, 2}, {1000, 4}};
  std::vector<RateAndDelay> all;
  for (const double rate_Hz : ratesOf(options)) {
    for (const int delay : delaysOf(options)) all.push_back({rate_Hz, delay});
  }
  return all;
}

std::vector<StabilityRow> rowsOf(const StabilityOptions& options) {
  std::vector<StabilityRow> rows;
  for (const std::string& device : options.devices) {
    for (const std::string& grip : options.grips) {
      for (const RateAndDelay& when : ratesAndDelays(options)) {
        for (const double damping_Ns_m : options.dampings_Ns_m) {
          StabilityRow& row = rows.emplace_back();
          row.loop.device.model = deviceModel(device);
          row.loop.device.firm = grip == "firm";
          row.loop.device.delay_steps = when.delay;
          row.loop.device.jitter_s = 1e-6 * options.jitter_us;
          row.loop.device.bends = options.bends;
          row.loop.device.current_lag_s = options.bends ? 0.25e-3 : 0;
          row.loop.rate_Hz = when.rate_Hz;
          row.loop.damping_Ns_m = damping_Ns_m;
        }
      }
    }
  }
  return rows;
}

// A line that rewrites itself, on terminals only.
void showProgress(std::size_t done, std::size_t all) {
  if (isatty(STDERR_FILENO) == 0) return;
  tell("\rmeasured: {} of {}", done, all);
  if (done == all) tell("\r                          \r");
  std::fflush(stderr);
}

void measure(std::vector<StabilityRow>& rows, bool quick) {
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
    StabilityRow& row = rows[i];
    row.one_by_one_N_m = highestStiffness_N_m(row.loop, Landings::kOneByOne);
    if (!quick) row.together_N_m = highestStiffness_N_m(row.loop, Landings::kTogether);
    showProgress(++done, rows.size());
  });
}

std::string stiffnessText(double stiffness_N_m) {
  if (stiffness_N_m == 0) return fmt::format("< {:.0f}", kStiffnessLow_N_m);
  if (stiffness_N_m == kStiffnessHigh_N_m) return fmt::format("> {:.0f}", kStiffnessHigh_N_m);
  return fmt::format("{:.0f}", stiffness_N_m);
}

void printTable(const std::vector<StabilityRow>& rows, bool quick) {
  fmt::print("{:<12}{:<7}{:>9}{:>7}{:>11}{:>14}{:>12}\n", "device", "grip", "rate Hz", "delay", "B N.s/m",
             "K one by one", "K together");
  for (const StabilityRow& row : rows) {
    fmt::print("{:<12}{:<7}{:>9}{:>7}{:>11}{:>14}{:>12}\n", row.loop.device.model.name,
               row.loop.device.firm ? "firm" : "light", row.loop.rate_Hz, row.loop.device.delay_steps,
               row.loop.damping_Ns_m, stiffnessText(row.one_by_one_N_m), quick ? "-" : stiffnessText(row.together_N_m));
  }
  fmt::print(
      "\nK in N/m: the highest stiffness at which the tip comes to rest on a floor (< 0.15 mm peak to peak), to 2 %.\n"
      "one by one: after impacts of 0.05 to 0.4 m/s under a push of 1 N, and of 0.05 m/s under pushes of 0.3 to 3 N;\n"
      "together: after every such impact under every such push. delay: servo steps from the sample to the motors,\n"
      "beyond the one they must wait for. B: damping of the servo.\n");
}

void writeCsv(OutputFile& csv, const std::vector<StabilityRow>& rows, bool quick) {
  csv.print("device,grip,rate_Hz,delay_steps,damping_Ns_m,bends,jitter_s,one_by_one_N_m,together_N_m\n");
  for (const StabilityRow& row : rows) {
    const SimulatedDeviceSettings& device = row.loop.device;
    csv.print("{},{},{},{},{},{},{},{:.0f},{}\n", device.model.name, device.firm ? "firm" : "light", row.loop.rate_Hz,
              device.delay_steps, row.loop.damping_Ns_m, device.bends ? 1 : 0, device.jitter_s, row.one_by_one_N_m,
              quick ? "" : fmt::format("{:.0f}", row.together_N_m));
  }
  csv.close();
}

// b / (T (1/2 + d)) against what the whole loop does with a device of mass and damper alone.
void printTheory() {
  constexpr double kMass_kg = 0.075, kDamping_Ns_m = 0.5;
  fmt::print("device of {} kg and {} N.s/m, no friction, no encoder steps, no hand: K at which it turns unstable\n",
             kMass_kg, kDamping_Ns_m);
  fmt::print("{:>9}{:>7}{:>12}{:>12}\n", "rate Hz", "delay", "theory", "found");
  for (const RateAndDelay& when : {RateAndDelay{1000, 0}, {1000, 1}, {1000, 2}, {4000, 0}, {4000, 1}}) {
    StabilityCase loop;
    loop.device.model = linearDevice(kMass_kg, kDamping_Ns_m);
    loop.device.delay_steps = when.delay;
    loop.rate_Hz = when.rate_Hz;
    const double theory_N_m = kDamping_Ns_m * when.rate_Hz / (0.5 + when.delay);
    fmt::print("{:>9}{:>7}{:>12.0f}{:>12.0f}\n", when.rate_Hz, when.delay, theory_N_m,
               criticalStiffness_N_m(loop, 0.5 * theory_N_m, 2 * theory_N_m));
  }
}

void run(const StabilityOptions& options) {
  if (options.theory) return printTheory();
  if (!options.bodies_kg.empty())
    return runStabilityOnBodies({options.bodies_kg, ratesOf(options), delaysOf(options), options.csv});
  std::optional<OutputFile> csv;  // opened first: what is measured for minutes can be written then
  if (!options.csv.empty()) csv.emplace(options.csv);
  std::vector<StabilityRow> rows = rowsOf(options);
  measure(rows, options.quick);
  printTable(rows, options.quick);
  if (csv) writeCsv(*csv, rows, options.quick);
}

}  // namespace

void addStabilityCommand(CLI::App& app) {
  auto* command = app.add_subcommand(
      "stability", "how stiff a simulated device lets a surface be, by rate, delay, grip and damping");
  auto options = std::make_shared<StabilityOptions>();
  std::vector<std::string> names;
  for (const DeviceModel& model : deviceModels()) names.emplace_back(model.name);
  command->add_option("--device", options->devices, "simulated devices, with commas")
      ->delimiter(',')
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  command->add_option("--grips", options->grips, "of the hand, with commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"light", "firm"}))
      ->capture_default_str();
  command->add_option("--rates", options->rates_Hz, "servo steps a second, with commas (default: 500 to 4000)")
      ->delimiter(',')
      ->check(within(100, 20'000));
  command->add_option("--delays", options->delays, "more servo steps until the force, with commas (default: 0 to 4)")
      ->delimiter(',')
      ->check(CLI::Range(0, SimulatedDeviceSettings::kMaxDelay));
  command->add_option("--damping", options->dampings_Ns_m, "B of the servo in N s/m, with commas")
      ->delimiter(',')
      ->check(within(0, 100))
      ->capture_default_str();
  command->add_option("--jitter", options->jitter_us, "how much later a sample may be taken than it says, in us")
      ->check(within(0, 1000))
      ->capture_default_str();
  command->add_flag("--bends", options->bends, "a stylus that bends, 3.5 N/mm, and motor currents that lag 0.25 ms");
  command->add_flag("--quick", options->quick, "leave out the column 'together'");
  auto* theory = command->add_flag("--theory", options->theory, "the linear device against theory instead");
  auto* body = command->add_option("--body", options->bodies_kg,
                                   "the linear device on free bodies of so many kg instead, with commas, beside other "
                                   "couplings and theory; of --rates (default: 1000) and --delays (default: 0)");
  body->delimiter(',')->check(within(1e-6, 1e6))->excludes(theory);
  for (const char* other : {"--device", "--grips", "--damping", "--jitter", "--bends", "--quick"})
    body->excludes(command->get_option(other));
  command->add_option("--csv", options->csv, "write the rows to this file too");
  for (const char* other :
       {"--device", "--grips", "--rates", "--delays", "--damping", "--jitter", "--bends", "--quick", "--csv"})
    theory->excludes(command->get_option(other));
  command->callback([options] { run(*options); });
}

}  // namespace hl
