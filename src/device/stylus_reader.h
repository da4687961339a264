// StylusReader: the stylus as the loops know it, whatever a driver reports of it.
#pragma once

#include <cstdint>
#include <optional>

#include "device/stylus.h"

namespace hl {

/// One thread; RT-safe.
class StylusReader {
 public:
  /// What is no orientation, or not finite, is left as it was. The spin is that between readings, of which only some
  /// devices report; through a low pass of kSpinFilter_s, as encoders count in steps.
  Stylus read(const Stylus& reported, std::int64_t now_ns);
  /// What it returned last.
  const Stylus& last() const { return last_; }

  static constexpr double kSpinFilter_s = 0.01;

 private:
  Stylus last_;
  std::optional<std::int64_t> last_ns_;
};

}  // namespace hl
