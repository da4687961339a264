// How far a sweep is, on standard error: a line that rewrites itself on a terminal, elsewhere one now and then.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hl {

class SweepProgress {
 public:
  explicit SweepProgress(std::size_t tasks);
  void taskDone() { ++done_; }
  void report();  ///< if it is time to
  /// For good: the line goes. Seconds since the beginning.
  double end();

 private:
  double seconds() const;

  const std::size_t tasks_;
  const std::int64_t begin_ns_;
  const bool terminal_;
  std::size_t done_ = 0;
  double reported_s_ = 0;
};

}  // namespace hl
