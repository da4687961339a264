// What a sweep gives at its end: a table of all tasks in columns, for numpy, and a manifest, which says from what each
// result was made and which it is. Both are the same however the sweep was run.
#pragma once

#include <string>

#include "fleet/fleet_plan.h"
#include "fleet/fleet_store.h"

namespace hl {

/// How far a sweep is. Tasks that are the same count once each.
struct FleetProgress {
  std::size_t done = 0, failed = 0, left = 0;
  std::vector<std::pair<std::size_t, std::string>> failures;  ///< places of tasks in the plan, and why
};
FleetProgress progressOf(const FleetPlan& plan, const FleetStore& store);

/// Writes FOLDER/result.npz, beside first. Throws hl::Error where it cannot, or where a task has neither a result
/// nor a failure.
void writeFleetTable(const FleetPlan& plan, const FleetStore& store, const std::string& folder);

/// Writes FOLDER/manifest.json in the same way. Gives its SHA-256.
std::string writeManifest(const FleetPlan& plan, const FleetStore& store, const std::string& folder);

}  // namespace hl
