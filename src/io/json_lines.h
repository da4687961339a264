// JsonLines: on which line of a JSON text each value begins, so that an error can say where to look.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hl {

class JsonLines {
 public:
  /// `text` must outlive this; `before_line`: what errors have before the number of a line, as "FILE:". Throws
  /// hl::Error for text that is not JSON, nested too deep, with a number out of range, or with a name that is twice in
  /// one object.
  JsonLines(const std::string& before_line, std::string_view text);

  /// Line of the value at a path such as "objects[2].material.stiffness", or of the nearest value around it; from 1.
  /// Reads the text again: it is for errors.
  std::size_t lineOf(const std::string& path) const;
  /// Whether there is a value at the path. Reads the text again.
  bool has(const std::string& path) const;

 private:
  std::string_view text_;
};

}  // namespace hl
