// The manifest: a line for each task, so that two manifests can be compared by any tool for texts.
#include <fmt/core.h>

#include <boost/json.hpp>

#include "fleet/beside.h"
#include "fleet/fleet_report.h"
#include "io/output_file.h"
#include "io/sha256.h"

namespace hl {

namespace {

std::string quotedText(const std::string& text) { return boost::json::serialize(boost::json::string(text)); }

std::string sourcesText(const std::vector<FleetSource>& sources) {
  std::string text;
  for (const FleetSource& source : sources)
    text += fmt::format("{}\n    {{\"name\": {}, \"sha256\": \"{}\"}}", text.empty() ? "" : ",",
                        quotedText(source.name), source.sha256);
  return text;
}

std::string taskText(const FleetPlan& plan, const FleetTask& task, const FleetStore& store) {
  std::string options;
  for (const SweepOption& option : plan.options[task.options])
    options += fmt::format("{}{}: {}", options.empty() ? "" : ", ", quotedText(option.name), quotedText(option.value));
  std::string text =
      fmt::format(R"({{"task": "{}", "scene": {}, "path": {}, "options": {{{}}})", task.name,
                  quotedText(plan.scenes[task.scene].name), quotedText(plan.paths[task.path].name), options);
  if (task.seed >= 0) text += fmt::format(", \"seed\": {}", task.seed);
  if (const std::optional<StoredResult> stored = store.find(task.name))
    return text +
           fmt::format(R"(, "result_sha256": "{}", "rows_sha256": "{}"}})", stored->sha256, stored->result.rows_sha256);
  return text + fmt::format(", \"failure\": {}}}", quotedText(store.failureOf(task.name).value_or("was not run")));
}

}  // namespace

std::string writeManifest(const FleetPlan& plan, const FleetStore& store, const std::string& folder) {
  const std::string path = folder + "/manifest.json", beside = nameBeside(path);
  removeBeside(path);
  OutputFile file(beside);
  file.print("{{\n  \"program\": {},\n  \"sweep\": \"{}\",\n  \"rows\": {},\n", quotedText("hl " + plan.program),
             plan.name, plan.rows);
  file.print("  \"scenes\": [{}],\n  \"paths\": [{}],\n", sourcesText(plan.scenes), sourcesText(plan.paths));
  file.print("  \"tasks\": [");
  for (std::size_t i = 0; i < plan.tasks.size(); ++i)
    file.print("{}\n    {}", i == 0 ? "" : ",", taskText(plan, plan.tasks[i], store));
  file.write("]\n}\n");
  file.close();
  putInPlace(beside, path);
  return sha256OfFile(path);
}

}  // namespace hl
