// hl sweep: many traces, scenes x paths x options x seeds, here or by Slurm. docs/sweeps.md describes it.
#include <fmt/core.h>
#include <unistd.h>

#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <thread>
#include <unordered_set>

#include "base/error.h"
#include "commands.h"
#include "fleet/fleet_report.h"
#include "fleet/slurm.h"
#include "fleet/worker_pool.h"
#include "standard_streams.h"
#include "sweep_progress.h"
#include "sweep_worker.h"
#include "trace_options.h"

namespace hl {

namespace {

namespace fs = std::filesystem;

/// Every `of`-th task from the `number`-th on.
struct SweepPart {
  std::size_t number = 0, of = 1;
};

struct SweepCall {
  std::string file, out, expect;
  std::optional<int> jobs;  // at a time; absent: as many as there are processors
  bool dry_run = false, status = false, finish = false, slurm = false;
  std::optional<SweepPart> part;
  std::string slurm_options;
  std::size_t parts = 100;  // below the 1001 that Slurm allows in an array unless it is set otherwise
};

// A sweep that has been read, with its places; the current folder is that of its file.
struct SweepRun {
  SweepCall call;
  std::string file, folder;  // absolute
  FleetPlan plan;
  std::vector<std::size_t> tasks;  // of those that are the same the first

  FleetStore store() const { return FleetStore(folder + "/results"); }
};

SweepRules sweepRules() {
  SweepRules rules;
  const auto words = std::make_shared<TraceWords>();
  for (const std::string& name : words->names()) {
    if (name != "help" && name != "path" && name != "seed") rules.names.push_back(name);
  }
  rules.fault = [words](const SweepOptions& options) -> std::string {
    std::vector<std::string> trace{"scene", "--path=path"};
    for (const SweepOption& option : options) trace.push_back("--" + option.name + "=" + option.value);
    try {
      words->read(trace);
    } catch (const CLI::ParseError& error) {
      return error.what();
    }
    return {};
  };
  rules.most_seed = kMaxSeed;
  return rules;
}

std::string defaultFolder(const fs::path& file) { return fs::path(file).replace_extension(".sweep").string(); }

SweepRun planned(const SweepCall& call) {
  const SweepFile sweep = readSweepFile(call.file, sweepRules());
  SweepRun run{call, fs::absolute(call.file).lexically_normal().string(), "", {}, {}};
  run.folder = fs::absolute(call.out.empty() ? defaultFolder(call.file) : call.out).lexically_normal().string();
  fs::current_path(fs::path(run.file).parent_path());
  run.plan = makeFleetPlan(sweep, HL_VERSION);
  if (!call.expect.empty() && call.expect != run.plan.name)
    throw Error(call.file +
                ": is another sweep here: its files, or hl itself, are not those that it was submitted with");
  std::unordered_set<std::string> seen;
  for (std::size_t i = 0; i < run.plan.tasks.size(); ++i) {
    if (seen.insert(run.plan.tasks[i].name).second) run.tasks.push_back(i);
  }
  return run;
}

std::string traceLine(const SweepRun& run, const FleetTask& task) {
  std::string line = "hl trace";
  for (const std::string& word : run.plan.wordsOf(task)) line += " " + word;
  return line;
}

void printFailures(const SweepRun& run, const FleetProgress& progress) {
  constexpr std::size_t kMaxListed = 10;
  for (std::size_t i = 0; i < std::min(kMaxListed, progress.failures.size()); ++i) {
    const auto& [task, why] = progress.failures[i];
    tell("failed: {}: {}\n", traceLine(run, run.plan.tasks[task]), why);
  }
  if (progress.failed > kMaxListed)
    tell("and {} more: the column failure of the table has all\n", progress.failed - kMaxListed);
}

void listTasks(const SweepRun& run) {
  for (const std::size_t i : run.tasks) {
    const FleetTask& task = run.plan.tasks[i];
    fmt::print("{:.12} {}\n", task.name, traceLine(run, task));
  }
  fmt::print("{} tasks; sweep {}\n", run.tasks.size(), run.plan.name);
}

void printStatus(const SweepRun& run) {
  const FleetProgress progress = progressOf(run.plan, run.store());
  fmt::print("{} tasks: {} done, {} failed, {} left\n", run.plan.tasks.size(), progress.done, progress.failed,
             progress.left);
  printFailures(run, progress);
}

// The table and the manifest of tasks that have all come to their end.
void finish(const SweepRun& run) {
  const FleetProgress progress = progressOf(run.plan, run.store());
  if (progress.left > 0)
    throw Error(fmt::format("{} of {} tasks are not done: run the sweep again, it goes on from here", progress.left,
                            run.plan.tasks.size()));
  run.store().removeRemains();
  writeFleetTable(run.plan, run.store(), run.folder);
  const std::string hash = writeManifest(run.plan, run.store(), run.folder);
  printFailures(run, progress);
  fmt::print("{} tasks: {} done, {} failed\n", run.plan.tasks.size(), progress.done, progress.failed);
  fmt::print("table: {}/result.npz\nmanifest: {}/manifest.json sha256 {}\n", run.folder, run.folder, hash);
  if (progress.failed > 0) throw CLI::RuntimeError(1);
}

// Within a job of Slurm as many as it has given.
int jobsOf(const SweepCall& call) {
  if (call.jobs) return *call.jobs;
  if (std::getenv("SLURM_JOB_ID") == nullptr)
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const char* const given = std::getenv("SLURM_CPUS_PER_TASK");
  return given == nullptr ? 1 : std::max(1, std::atoi(given));
}

void runTasks(const SweepRun& run) {
  const FleetStore store = run.store();
  const SweepPart part = run.call.part.value_or(SweepPart{});
  std::vector<std::size_t> todo;
  std::size_t mine = 0;
  for (std::size_t i = part.number; i < run.tasks.size(); i += part.of, ++mine) {
    if (!store.find(run.plan.tasks[run.tasks[i]].name)) todo.push_back(run.tasks[i]);
  }
  const auto task_of = [&](std::size_t i) -> const FleetTask& { return run.plan.tasks[todo[i]]; };
  SweepProgress progress(todo.size());
  FleetCallbacks callbacks;
  callbacks.order = [&](std::size_t i) {
    const FleetTask& task = task_of(i);
    return FleetOrderText{task.name, run.plan.wordsOf(task), run.plan.rows, run.plan.scenes[task.scene].sha256,
                          run.plan.paths[task.path].sha256};
  };
  callbacks.done = [&](std::size_t i, const std::string& failure) {
    if (!failure.empty()) store.keepFailure(task_of(i).name, failure);
    progress.taskDone();
  };
  callbacks.wait = [&] { progress.report(); };
  const std::string self = fs::read_symlink("/proc/self/exe").string();
  if (!todo.empty())
    runWorkers({self, {"hl", kSweepWorker, run.folder + "/results"}}, jobsOf(run.call), todo.size(), callbacks);
  const double seconds = progress.end();
  tell("{} tasks run in {:.1f} s, {:.0f} a second; {} were done before\n", todo.size(), seconds,
       static_cast<double>(todo.size()) / std::max(seconds, 1e-9), mine - todo.size());
}

SlurmSweep slurmOf(const SweepRun& run) {
  SlurmSweep slurm;
  slurm.command = {
      fs::read_symlink("/proc/self/exe").string(), "sweep", run.file, "--out", run.folder, "--expect", run.plan.name};
  if (run.call.jobs) slurm.command.insert(slurm.command.end(), {"--jobs", std::to_string(*run.call.jobs)});
  slurm.name = "hl-" + fs::path(run.file).stem().string();
  slurm.folder = run.folder;
  slurm.options = run.call.slurm_options;
  slurm.parts = std::min(run.call.parts, run.tasks.size());
  return slurm;
}

void submit(const SweepRun& run) {
  const SlurmSweep slurm = slurmOf(run);
  if (run.call.dry_run) {
    for (const std::string& command : slurmCommands(slurm)) fmt::print("{}\n", command);
    return;
  }
  const SlurmJobs jobs = submitToSlurm(slurm);
  fmt::print("{} tasks in {} parts: array job {}, then job {} writes the table; logs in {}/slurm\n", run.tasks.size(),
             slurm.parts, jobs.array, jobs.last, run.folder);
}

void run(const SweepCall& call) {
  const SweepRun sweep = planned(call);
  if (call.slurm) return submit(sweep);
  if (call.dry_run) return listTasks(sweep);
  if (call.status) return printStatus(sweep);
  if (!call.finish) runTasks(sweep);
  if (!call.part) finish(sweep);
}

SweepPart partOf(const std::string& text) {
  SweepPart part;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, part.number);
  const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, part.of) : first;
  if (!slash || second.ec != std::errc() || second.ptr != end || part.number >= part.of)
    throw CLI::ValidationError("--part", "'" + text + "' is not K/N with K from 0 to N - 1");
  return part;
}

constexpr int kMaxJobs = 4096, kMaxParts = 1'000'000;

void addSlurmOptions(CLI::App& command, SweepCall& call) {
  constexpr const char* kGroup = "Slurm";
  auto* slurm = command.add_flag("--slurm", call.slurm, "submit it as an array job, and return")->group(kGroup);
  command.add_option("--slurm-options", call.slurm_options, "for sbatch, as \"--partition=short --time=10\"")
      ->needs(slurm)
      ->group(kGroup);
  command.add_option("--parts", call.parts, "jobs in the array, at most")
      ->check(CLI::Range(1, kMaxParts))
      ->needs(slurm)
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option_function<std::string>(
          "--part", [&call](const std::string& text) { call.part = partOf(text); },
          "run every N-th task from the K-th on, and write no table: what a job of the array does")
      ->option_text("K/N")
      ->group(kGroup);
  command.add_flag("--finish", call.finish, "run nothing, write the table: what the last job does")->group(kGroup);
  command.add_option("--expect", call.expect, "refuse if the sweep has another name, as --dry-run tells it: jobs do")
      ->group(kGroup);
}

}  // namespace

void addSweepCommand(CLI::App& app) {
  auto* command = app.add_subcommand("sweep", "many traces: scenes x paths x options x seeds, here or by Slurm");
  auto call = std::make_shared<SweepCall>();
  command->add_option("sweep", call->file, "TOML: what to run (docs/sweeps.md)")->required();
  command->add_option("--out", call->out, "folder of results (default: SWEEP.sweep beside SWEEP.toml)");
  command->add_option("--jobs", call->jobs, "traces at a time (default: as many as there are processors)")
      ->check(CLI::Range(1, kMaxJobs));
  auto* dry_run = command->add_flag("--dry-run", call->dry_run, "list the tasks, or the calls of sbatch; run nothing");
  auto* status = command->add_flag("--status", call->status, "tell how many tasks are done; run nothing");
  addSlurmOptions(*command, *call);
  CLI::Option* const slurm = command->get_option("--slurm");
  CLI::Option* const part = command->get_option("--part");
  CLI::Option* const finish = command->get_option("--finish");
  status->excludes(dry_run)->excludes(slurm)->excludes(part)->excludes(finish);
  finish->excludes(dry_run)->excludes(slurm)->excludes(part);
  part->excludes(dry_run)->excludes(slurm);
  command->callback([call] { run(*call); });
}

}  // namespace hl
