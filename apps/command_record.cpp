// hl record: hl touch, and everything that the loops do into a file.
#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdint>
#include <limits>

#include "commands.h"
#include "touch_options.h"

namespace hl {

namespace {

// The session goes on without its recording, which was what the command is for.
void run(TouchOptions& options) {
  std::atomic<bool> lost{false};
  options.recorder.lost = [&lost] { lost = true; };
  runTouch(options);
  if (lost) throw CLI::RuntimeError(1);
}

}  // namespace

void addRecordCommand(CLI::App& app) {
  auto* command = app.add_subcommand("record", "as hl touch, and record the session into a file for hl replay");
  auto options = std::make_shared<TouchOptions>();
  addTouchOptions(*command, *options);
  RecorderSettings& recorder = options->recorder;
  command->add_option("--out", recorder.file, "the file; what was there is overwritten")
      ->required()
      ->option_text("FILE")
      ->group("Recording");
  command
      ->add_option("--max-size", recorder.most_bytes,
                   "the recording ends with the block that makes the file larger; the session goes on")
      ->transform(CLI::AsSizeValue(true))
      ->check(CLI::Range(std::uint64_t{1}, std::numeric_limits<std::uint64_t>::max() / 2))
      ->option_text("BYTES, or with kB, MB, GB (default: 4 GB)")
      ->group("Recording");
  command->callback([options] { run(*options); });
}

}  // namespace hl
