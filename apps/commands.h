// The subcommands of hl. Each adds itself to the command line; its work runs when the line has been parsed.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "io/cad_file.h"
#include "proxy/proxy.h"
#include "scene/scene_model.h"

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

/// Options that every command with a SCENE shares.
struct SceneOptions {
  std::string scene = "teapot";
  std::string hierarchy = "bvh";
  double scale = 0;            ///< metres per file unit; 0: as it is
  double fit = 0;              ///< m, largest side; 0: as it is
  std::string grid;            ///< of a file with several grids, by its name
  std::vector<double> iso;     ///< of volumes; empty: one that is chosen
  std::optional<bool> below;   ///< whether the matter of volumes is below iso; nothing: as the scene says
  double vertical_scale = 0;   ///< of the heights of height fields; 0: as they are
  bool surfels = false;        ///< of clouds, in place of points
  double surfel_reach = 0.75;  ///< in spacings
  CadMeshing cad;              ///< of CAD files
  bool opens_files = false;    ///< others, later on
  bool operator==(const SceneOptions&) const = default;
};

void addSceneArgument(CLI::App& command, SceneOptions& options, bool required);
void addHierarchyOption(CLI::App& command, SceneOptions& options);
/// --vertical-scale, --grid, --iso, --below, --surfels and --deflection: how files become surfaces. addSizeOptions()
/// adds them too.
void addReadingOptions(CLI::App& command, SceneOptions& options);
void addSizeOptions(CLI::App& command, SceneOptions& options);

/// Options of the surfaces, over what the scene says: --shade, --stiffness, frictions, --viscosity, --textures; and
/// --ledger.
void addSurfaceOptions(CLI::App& command, MaterialOverride& surfaces, LedgerMode& ledger);

/// What was skipped, and shapes of bodies that are far from their meshes; one line each. Throws hl::Error.
std::vector<std::string> warningsOf(const Snapshot& snapshot);
/// Those of a mesh, or of a surface whose primitives are triangles.
std::uint64_t trianglesOf(const Shape& shape);
/// Throws hl::Error if there is no scene, and an option says how it is to be read.
void requireNoReading(const SceneOptions& options);
/// Loads, scales and builds; progress of long loads and warnings go to stderr. Throws hl::Error.
std::shared_ptr<const Snapshot> loadSnapshot(const SceneOptions& options);
/// Throws hl::Error, with `name` in front, for a model that takes more than `there_bytes` of memory to make.
void requireMemory(const SceneModel& scene, const std::string& name, std::uint64_t there_bytes);
HierarchyKind hierarchyOf(const SceneOptions& options);

/// No option of the program or of its commands takes an empty word, as an unset variable of a shell makes it.
void refuseEmptyWords(CLI::App& app);

/// CLI check: a number from `least` to `most`. NaN is none, which CLI::Range lets pass.
CLI::Validator within(double least, double most);
/// The same: a whole number.
CLI::Validator whole(std::uint64_t least, std::uint64_t most);
/// The same: any finite number.
CLI::Validator finite();
/// The same: a finite number above zero.
CLI::Validator positive();
/// What this throws hl::Error for is refused, with its words.
CLI::Validator passing(std::function<void(const std::string& text)> check);
/// A plain file that may be read.
CLI::Validator plainFile();
/// What is wrong with a text that is none of these words.
std::string noneOf(const std::string& text, const std::string& words);
/// CLI transform: one of these words, for its value. CLI::CheckedTransformer takes the numbers of an enumeration too.
template <typename Value>
CLI::Validator oneOf(const std::map<std::string, Value>& values) {
  return {[values](std::string& text) {
            const auto found = values.find(text);
            if (found == values.end())
              return noneOf(text, CLI::detail::join(
                                      values, [](const auto& v) { return v.first; }, ", "));
            text = CLI::detail::value_string(found->second);
            return std::string();
          },
          ""};
}
/// What CLI11 says of a wrong option, in words that say what to do.
std::string errorText(const CLI::ParseError& error);

// What numbers on the command line may be, so that no product of them, lengths and speeds leaves the range of doubles.
inline constexpr double kMinNumber = 1e-9, kMaxNumber = 1e9, kMinRadius_m = 1e-12;

}  // namespace hl
