// What every long run is given on its command line, and how it reports its faults.
#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

#include "soak/pieces.h"

namespace hl::soak {

struct RunOptions {
  std::uint64_t seed = 1;
  int threads = 1;
  std::int64_t piece = -1;  ///< this one alone; -1: all
};

/// `piece`: what the run calls its pieces, "piece" or "scene".
inline void addRunOptions(CLI::App& app, RunOptions& options, const std::string& piece = "piece") {
  app.add_option("--seed", options.seed, "Of all random numbers")->capture_default_str();
  app.add_option("--threads", options.threads, "They do not change the outcome")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--" + piece, options.piece, "Only the " + piece + " of this number");
}

/// Ends the program after --help, and after what it does not understand.
inline void parseOrExit(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : 2);
  }
}

/// Enough pieces for so much `work`.
inline Pieces piecesOf(const RunOptions& options, double work, double work_per_piece) {
  if (options.piece < 0) return {0, static_cast<std::uint64_t>(std::ceil(work / work_per_piece)), 1, options.threads};
  const auto piece = static_cast<std::uint64_t>(options.piece);
  return {piece, piece + 1, 1, 1};
}

/// By piece.
using Faults = std::map<std::uint64_t, std::string>;

/// Reports a fault immediately: a long run may be stopped.
inline void addFault(Faults& faults, std::uint64_t piece, std::string fault) {
  fmt::print(stderr, "{}\n", fault);
  faults[piece] = std::move(fault);
}

/// Prints them, and their number. Returns the exit code.
inline int report(const Faults& faults) {
  for (const auto& [piece, fault] : faults) fmt::print("{}\n", fault);
  fmt::print("{} faults\n", faults.size());
  return faults.empty() ? 0 : 1;
}

}  // namespace hl::soak
