// What hl bench prints: a table that grows row by row, and the same rows as CSV.
#pragma once

#include <optional>
#include <string>

#include "io/output_file.h"
#include "tick/suite.h"

namespace hl {

class BenchOutput {
 public:
  /// `csv` is a file name, not that of the `scene`; empty: no CSV. Throws hl::Error when it cannot be written.
  BenchOutput(const std::string& csv, const std::string& scene);

  /// Writes to stdout, the CSV and, progress only and on terminals only, stderr. Valid while this lives.
  bench::SuiteOutput sink();
  void note(const std::string& text);

 private:
  void row(const bench::Row& row);
  void growth(const bench::Growth& growth);
  void progress(const std::string& text);
  void clearProgress();

  std::optional<OutputFile> csv_;
  std::size_t progress_width_ = 0;
};

}  // namespace hl
