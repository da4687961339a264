// JsonLines: on which line of a JSON text each value begins, so that an error can say where to look.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>

namespace hl {

class JsonLines {
 public:
  /// Throws hl::Error "FILE:LINE: ..." for text that is not JSON, nested too deep, or with a number out of range.
  JsonLines(const std::string& file, std::string_view text);

  /// Line of the value at a path such as "objects[2].material.stiffness", or of the nearest value around it; from 1.
  std::size_t lineOf(std::string path) const;

 private:
  std::unordered_map<std::string, std::size_t> lines_;  // members and objects; not the elements of lists of numbers
};

}  // namespace hl
