// ReadingCache: scenes as they were read from files that take long to read, kept in files of their own. An entry is the
// messages of io/model_parts.h with their SHA-256 at the end: one that was cut, changed or is another's does not count,
// and what is in it is checked as what a reading process gives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/isolated.h"
#include "scene/scene_model.h"

namespace hl {

/// $XDG_CACHE_HOME/hl or ~/.cache/hl; empty where there is none.
std::string cacheFolder();

class ReadingCache {
 public:
  /// Made when something is kept. An empty name: nothing is ever kept. `most_bytes`: of all entries; the oldest go.
  explicit ReadingCache(std::string folder, std::uint64_t most_bytes = kMax_bytes)
      : folder_(std::move(folder)), most_bytes_(most_bytes) {}

  /// Of the file that is open as `descriptor`, whose place is not changed, and how it is read. Empty: it cannot be
  /// read.
  std::string keyOf(int descriptor, const std::string& options) const;
  /// None where there is no sound entry.
  std::optional<SceneModel> find(const std::string& key, const IsolationLimits& limits) const;
  /// Written beside and renamed, so that no half one is found. Nothing happens where that fails: it is kept for speed
  /// alone.
  void keep(const std::string& key, const SceneModel& scene) const;

 private:
  static constexpr std::uint64_t kMax_bytes = std::uint64_t{4} << 30;

  std::string pathOf(const std::string& key) const { return folder_ + "/" + key + ".reading"; }
  void makeRoom() const;

  std::string folder_;
  std::uint64_t most_bytes_;
};

}  // namespace hl
