// hl: the command. Bad input gives one line on stderr and exit code 2.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/utf8.h"
#include "commands.h"
#include "file_opener.h"
#include "io/load_sent.h"
#include "option_errors.h"
#include "standard_streams.h"
#include "sweep_worker.h"

namespace {

std::string unknownCommand(const CLI::App& app, const std::string& word) {
  std::string names;
  for (const CLI::App* command : app.get_subcommands({})) names += (names.empty() ? "" : ", ") + command->get_name();
  return "there is no command '" + word + "'; there are " + names;
}

int run(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == hl::kReadSent) hl::readSent(argv[2]);
  if (argc == 3 && std::string_view(argv[1]) == hl::kSweepWorker) return hl::runSweepWorker(argv[2]);
  CLI::App app("HL, the haptic library: makes 3-D worlds touchable.", "hl");
  app.set_version_flag("--version", std::string("hl ") + HL_VERSION);
  app.require_subcommand(1);
  hl::addTouchCommand(app);
  hl::addTraceCommand(app);
  hl::addInfoCommand(app);
  hl::addDoctorCommand(app);
  hl::addBenchCommand(app);
  hl::addRecordCommand(app);
  hl::addReplayCommand(app);
  hl::addStabilityCommand(app);
  hl::addSweepCommand(app);
  hl::addKeysCommand(app);
  hl::refuseEmptyWords(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::RuntimeError& failed) {  // reported already
    return failed.get_exit_code();
  } catch (const CLI::ParseError& error) {
    const bool unknown = argc > 1 && app.get_subcommands().empty();
    hl::tell("hl: {} (try --help)\n", hl::printable(unknown ? unknownCommand(app, argv[1]) : hl::errorText(error)));
    return 2;
  } catch (const hl::Error& error) {
    hl::tell("hl: {}\n", hl::printable(error.what()));
    return 2;
  } catch (const std::bad_alloc&) {
    hl::tell("hl: not enough memory for this scene\n");
    return 2;
  } catch (const std::exception& error) {
    hl::tell("hl: unexpected failure: {}\n", hl::printable(error.what()));
    return 1;
  }
  return 0;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only when there is no memory for a line
int main(int argc, char** argv) {
  hl::prepareStreams();
  return hl::codeWithOutput(run(argc, argv), "hl");
}
