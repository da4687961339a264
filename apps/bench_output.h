// What hl bench prints: a table that grows row by row, and the same rows as CSV.
#pragma once

#include <fmt/os.h>

#include <optional>
#include <string>

#include "tick/suite.h"

namespace hl {

class BenchOutput {
 public:
  /// `csv` is a file name; empty: no CSV. Throws hl::Error when it cannot be written.
  explicit BenchOutput(const std::string& csv);

  /// Writes to stdout, the CSV and, progress only and on terminals only, stderr. Valid while this lives.
  bench::SuiteOutput sink();
  void note(const std::string& text);

 private:
  void row(const bench::Row& row);
  void growth(const bench::Growth& growth);
  void progress(const std::string& text);
  void clearProgress();

  std::optional<fmt::ostream> csv_;
  std::size_t progress_width_ = 0;
};

}  // namespace hl
