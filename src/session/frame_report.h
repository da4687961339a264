// FrameReport: what is to be said of a frame: what was skipped in its shapes, and how many were refitted.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/shape.h"

namespace hl {

class FrameReport {
 public:
  void warn(const std::string& where, const std::string& what) {
    if (warnings_.size() < kMaxWarnings)
      warnings_.push_back(where + ": " + what);
    else
      ++more_;
  }
  /// Of a shape that was made at `where`.
  std::shared_ptr<const Shape> noted(std::shared_ptr<const Shape> shape, const std::string& where) {
    if (shape->before != 0) ++refits_;
    for (const std::string& warning : shape->warnings) warn(where, warning);
    return shape;
  }
  /// Hierarchies that were refitted, not built.
  std::size_t refits() const { return refits_; }
  /// The first, and how many more there were.
  std::vector<std::string> warnings() const {
    std::vector<std::string> all = warnings_;
    if (more_ > 0) all.push_back("and " + std::to_string(more_) + " more lines about what was skipped");
    return all;
  }

 private:
  static constexpr std::size_t kMaxWarnings = 20;  // a frame may skip something in each of a million items

  std::size_t refits_ = 0;
  std::vector<std::string> warnings_;
  std::size_t more_ = 0;
};

}  // namespace hl
