// The subcommands of hl. Each adds itself to the command line; its work runs when the line has been parsed.
#pragma once

#include <CLI/CLI.hpp>

namespace hl {

void addTouchCommand(CLI::App& app);
void addTraceCommand(CLI::App& app);
void addInfoCommand(CLI::App& app);
void addDoctorCommand(CLI::App& app);
void addBenchCommand(CLI::App& app);
void addRecordCommand(CLI::App& app);
void addReplayCommand(CLI::App& app);
void addStabilityCommand(CLI::App& app);
void addSweepCommand(CLI::App& app);
void addKeysCommand(CLI::App& app);

}  // namespace hl
