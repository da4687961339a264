#include "fleet/fleet_plan.h"

#include "io/scene_inputs.h"
#include "io/sha256.h"

namespace hl {

namespace {

// Whatever changes in what a result says changes this, so that older ones do not count.
constexpr const char* kOutcomeFormat = "hl sweep 1";

std::string textOf(const SweepOptions& options) {
  std::string text;
  for (const SweepOption& option : options) text += option.name + "=" + option.value + "\n";
  return text;
}

void addTasks(FleetPlan& plan, const std::vector<std::int64_t>& seeds) {
  Sha256 all;
  std::vector<std::string> options;
  for (const SweepOptions& each : plan.options) options.push_back(textOf(each));
  const std::string before = std::string(kOutcomeFormat) + (plan.rows ? " with rows\n" : "\n") + plan.program + "\n";
  for (std::size_t scene = 0; scene < plan.scenes.size(); ++scene) {
    for (std::size_t path = 0; path < plan.paths.size(); ++path) {
      const std::string sources = before + plan.scenes[scene].sha256 + "\n" + plan.paths[path].sha256 + "\n";
      for (std::size_t i = 0; i < options.size(); ++i) {
        for (const std::int64_t seed : seeds) {
          const std::string name = sha256Of(sources + options[i] + "seed " + std::to_string(seed) + "\n");
          all.add(name + "\n");
          plan.tasks.push_back({name, scene, path, i, seed});
        }
      }
    }
  }
  plan.name = hexOf(all.end());
}

}  // namespace

FleetSource sceneSource(const std::string& name) {
  const std::vector<SceneInput> inputs = sceneInputs(name);
  if (inputs.empty()) return {name, sha256Of("built-in " + name)};
  std::string all;
  for (const SceneInput& input : inputs) all += input.sha256 + " " + input.name + "\n";
  return {name, sha256Of(all)};
}

FleetSource pathSource(const std::string& name) { return {name, sha256OfFile(name)}; }

std::vector<std::string> FleetPlan::wordsOf(const FleetTask& task) const {
  std::vector<std::string> words{scenes[task.scene].name, "--path=" + paths[task.path].name};
  for (const SweepOption& option : options[task.options]) words.push_back("--" + option.name + "=" + option.value);
  if (task.seed >= 0) words.push_back("--seed=" + std::to_string(task.seed));
  return words;
}

FleetPlan makeFleetPlan(const SweepFile& sweep, const std::string& version) {
  FleetPlan plan;
  plan.program = version + " " + sha256OfFile("/proc/self/exe");
  for (const std::string& name : sweep.scenes) plan.scenes.push_back(sceneSource(name));
  for (const std::string& name : sweep.paths) plan.paths.push_back(pathSource(name));
  plan.options = sweep.options;
  plan.rows = sweep.rows;
  addTasks(plan, sweep.seeds.empty() ? std::vector<std::int64_t>{-1} : sweep.seeds);
  return plan;
}

}  // namespace hl
