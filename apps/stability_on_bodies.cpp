#include "stability_on_bodies.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <optional>

#include "io/output_file.h"
#include "tools/body_stability.h"

namespace hl {

namespace {

struct FoundAndTheory {
  double found_N_m = 0, theory_N_m = 0;
};

struct BodyRow {
  BodyOnDevice on;
  FoundAndTheory session, force_before, force_late;
};

std::vector<BodyRow> bodyRowsOf(const BodyStabilityPlan& plan) {
  std::vector<BodyRow> rows;
  for (const double rate_Hz : plan.rates_Hz) {
    for (const int delay : plan.delays) {
      for (const double body_kg : plan.bodies_kg) {
        BodyOnDevice& on = rows.emplace_back().on;
        on.body_kg = body_kg;
        on.rate_Hz = rate_Hz;
        on.delay_steps = delay;
      }
    }
  }
  return rows;
}

void measureOnBodies(std::vector<BodyRow>& rows) {
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
    BodyRow& row = rows[i];
    const auto both = [&](const Coupling& coupling) {
      return FoundAndTheory{highestStiffnessOnBody_N_m(row.on, coupling), mostStiffness_N_m(row.on, coupling)};
    };
    row.session = {highestStiffnessOnBody_N_m(row.on), mostStiffness_N_m(row.on, kOneSolve)};
    row.force_before = both(kForceBefore);
    row.force_late = both(kForceOneLate);
  });
}

std::string foundText(double stiffness_N_m) {
  if (stiffness_N_m == kBodyStiffnessHigh_N_m) return fmt::format("> {:.0f}", stiffness_N_m);
  return fmt::format("{:.{}f}", stiffness_N_m, stiffness_N_m < 10 ? 2 : 0);
}

std::string theoryText(double stiffness_N_m) { return std::isinf(stiffness_N_m) ? "any" : foundText(stiffness_N_m); }

void printBodyTable(const std::vector<BodyRow>& rows) {
  const BodyOnDevice device;
  fmt::print("{:>9}{:>7}{:>10}{:>20}{:>20}{:>20}\n", "rate Hz", "delay", "body kg", "HL", "force before",
             "one step late");
  fmt::print("{:>26}", "");
  for (int i = 0; i < 3; ++i) fmt::print("{:>11}{:>9}", "found", "theory");
  fmt::print("\n");
  for (const BodyRow& row : rows) {
    fmt::print("{:>9}{:>7}{:>10}", row.on.rate_Hz, row.on.delay_steps, row.on.body_kg);
    for (const FoundAndTheory& both : {row.session, row.force_before, row.force_late})
      fmt::print("{:>11}{:>9}", foundText(both.found_N_m), theoryText(both.theory_N_m));
    fmt::print("\n");
  }
  fmt::print(
      "\nK in N/m: the highest stiffness at which no swing grows between a device of {} kg and {} N.s/m, without hand "
      "and\n"
      "friction, and the body that rests on it; to 0.5 %, up to {:.0f}. HL: in a session, the proxy a node of the "
      "solve\n"
      "that moves the bodies. The others are two masses on a spring, as an engine moves them that gets the hand's "
      "force\n"
      "from outside: that of the begin of its step, or of the step before. theory: b / (T (1 + r) (1/2 + d + r d')),\n"
      "r = mass of the device / mass of the body, d the delay, d' = -1 for HL, 0 and 1; of first order in T.\n",
      device.device_kg, device.damping_Ns_m, kBodyStiffnessHigh_N_m);
}

void writeBodyCsv(OutputFile& csv, const std::vector<BodyRow>& rows) {
  csv.print(
      "rate_Hz,delay_steps,body_kg,session_N_m,session_theory_N_m,force_before_N_m,force_before_theory_N_m,"
      "force_late_N_m,force_late_theory_N_m\n");
  for (const BodyRow& row : rows) {
    csv.print("{},{},{}", row.on.rate_Hz, row.on.delay_steps, row.on.body_kg);
    for (const FoundAndTheory& both : {row.session, row.force_before, row.force_late})
      csv.print(",{:.5g},{:.5g}", both.found_N_m, both.theory_N_m);
    csv.print("\n");
  }
  csv.close();
}

}  // namespace

void runStabilityOnBodies(const BodyStabilityPlan& plan) {
  std::optional<OutputFile> csv;
  if (!plan.csv.empty()) csv.emplace(plan.csv);
  std::vector<BodyRow> rows = bodyRowsOf(plan);
  measureOnBodies(rows);
  printBodyTable(rows);
  if (csv) writeBodyCsv(*csv, rows);
}

}  // namespace hl
