// What `hl trace` takes beside the file that it writes; each task of `hl sweep` takes the same.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene_options.h"
#include "tools/trace.h"

namespace hl {

/// The largest number up to which doubles, in which others may read a seed, have all.
inline constexpr std::int64_t kMaxSeed = std::int64_t{1} << 53;

struct TraceOptions {
  SceneOptions scene;
  std::string path;
  TraceSettings settings;
  double tremor_m = 0;
  std::int64_t seed = 0;  ///< 0 to kMaxSeed
};

/// SCENE, --path and all that changes the result. `options` must outlive `command`.
void addTraceOptions(CLI::App& command, TraceOptions& options);

/// Reads the words of traces, one after the other.
class TraceWords {
 public:
  TraceWords() : app_("", "hl trace") { addTraceOptions(app_, options_); }
  TraceWords(const TraceWords&) = delete;
  TraceWords& operator=(const TraceWords&) = delete;

  /// The scene and what follows; what they do not say is the default. Throws CLI::ParseError. Valid until the next
  /// call.
  const TraceOptions& read(const std::vector<std::string>& words);
  /// All options, without --.
  std::vector<std::string> names() const;

 private:
  CLI::App app_;
  TraceOptions options_;
};

/// The path with the tremor that is asked for.
std::vector<PathSample> withTremor(std::vector<PathSample> path, const TraceOptions& options);
/// The same of the file. Throws hl::Error.
std::vector<PathSample> pathOf(const TraceOptions& options);

}  // namespace hl
