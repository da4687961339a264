// SweepFile: what `hl sweep` is asked for, as a TOML file says it: scenes x paths x options x seeds. docs/sweeps.md has
// the format.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace hl {

/// An option of `hl trace` as text: --name=value.
struct SweepOption {
  std::string name, value;
  bool operator==(const SweepOption&) const = default;
};

using SweepOptions = std::vector<SweepOption>;  ///< by name, each once

struct SweepFile {
  std::vector<std::string> scenes, paths;
  std::vector<SweepOptions> options;  ///< each of these with each scene, path and seed; one at least
  std::vector<std::int64_t> seeds;    ///< empty: tasks have no seed
  bool rows = false;                  ///< keep all rows of the traces
};

/// What the options of a trace may be.
struct SweepRules {
  std::vector<std::string> names;  ///< without --
  /// Why a trace cannot have these, in a line that names the option; empty: it can.
  std::function<std::string(const SweepOptions& options)> fault;
  std::int64_t most_seed;
};

inline constexpr std::size_t kMaxTasks = 1'000'000;

/// Throws hl::Error "FILE:LINE: ..." for a file that is no TOML or asks for what is not there.
SweepFile readSweepFile(const std::string& path, const SweepRules& rules);

}  // namespace hl
