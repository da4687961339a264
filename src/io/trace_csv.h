// The result of hl trace: one row a tick, 17 significant digits. The columns are a contract (docs/trace.md).
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "io/output_file.h"
#include "io/trace_row.h"

namespace hl {

/// What rows have beside the tick's own columns.
struct TraceColumns {
  std::vector<std::string> bodies{};  ///< their names
  std::vector<std::string> joints{};  ///< the same
  bool snap = false, turned = false, gripper = false;
};

/// Throws hl::Error when the file cannot be written.
class TraceWriter {
 public:
  /// `read`: files that it may not overwrite.
  explicit TraceWriter(const std::string& file, std::initializer_list<std::string> read = {},
                       const TraceColumns& columns = {});
  void write(const TraceRow& row);
  void close() { file_.close(); }  ///< without it, a failure of the last write goes unnoticed

 private:
  OutputFile file_;
};

/// What the columns of bodies and joints begin with: letters, digits and _, each once, and none as the tick's own
/// columns.
struct TraceColumnNames {
  std::vector<std::string> bodies, joints;
};
TraceColumnNames columnsOf(const TraceColumns& columns);

}  // namespace hl
