// FleetStore: the results of tasks, a file each in a folder, by the names of the tasks. Several programs, on several
// machines, may write into one folder at once: a result is written beside and renamed, so it is there whole or not at
// all, and two that make the same write the same.
#pragma once

#include <optional>
#include <string>

#include "fleet/fleet_result.h"

namespace hl {

struct StoredResult {
  FleetResult result;
  std::string sha256;  ///< of what the file says
};

class FleetStore {
 public:
  explicit FleetStore(std::string folder) : folder_(std::move(folder)) {}

  /// None where there is no sound file: one that was cut or changed does not count.
  std::optional<StoredResult> find(const std::string& name) const;
  /// Keeps it; a failure of the same task is forgotten. Throws hl::Error where it cannot be written.
  void keep(const FleetResult& result) const;
  /// Why there is no result, in a line. Throws hl::Error where it cannot be written.
  void keepFailure(const std::string& name, const std::string& why) const;
  std::optional<std::string> failureOf(const std::string& name) const;
  /// Removes what killed programs have left beside their results.
  void removeRemains() const;

 private:
  std::string pathOf(const std::string& name, const char* ending) const;
  void write(const std::string& path, const std::string& bytes) const;

  std::string folder_;
};

}  // namespace hl
