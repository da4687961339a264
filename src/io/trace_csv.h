// The result of hl trace: one row a tick, 17 significant digits. The columns are a contract (docs/trace.md).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

#include "base/vec.h"
#include "io/output_file.h"

namespace hl {

/// World frame; seconds, metres, newtons, joules.
struct TraceRow {
  double t = 0;
  Vec3 finger = Vec3::Zero(), proxy = Vec3::Zero(), target = Vec3::Zero(), force = Vec3::Zero();
  int contacts = 0;  ///< active planes at the end of the tick
  int iterations = 0;
  double injected_J = 0;     ///< energy that the tick added to the spring (positive) or took (negative)
  std::int64_t tick_ns = 0;  ///< the one column that differs from run to run
};

/// Throws hl::Error when the file cannot be written.
class TraceWriter {
 public:
  /// `read`: files that it may not overwrite.
  explicit TraceWriter(const std::string& file, std::initializer_list<std::string> read = {});
  void write(const TraceRow& row);
  void close() { file_.close(); }  ///< without it, a failure of the last write goes unnoticed

 private:
  OutputFile file_;
};

}  // namespace hl
