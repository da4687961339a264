// The result of hl trace: one row a tick, 17 significant digits. The columns are a contract (docs/trace.md).
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "base/vec.h"

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
  explicit TraceWriter(const std::string& file);
  ~TraceWriter();
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;
  void write(const TraceRow& row);
  void close();  ///< flushes; without it, a failure of the last write goes unnoticed

 private:
  std::string name_;
  std::FILE* file_;
};

}  // namespace hl
