// JsonLines: on which line of a JSON text each value begins, so that an error can say where to look.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hl {

class JsonLines {
 public:
  /// `text` must outlive this; `before_line`: what errors have before the number of a line, as "FILE:". Throws
  /// hl::Error for text that is not JSON, nested too deep, with a number out of range, or with a name that is twice in
  /// one object.
  JsonLines(const std::string& before_line, std::string_view text);

  /// Lines of the values at paths such as "objects[2].material.stiffness", or of the nearest values around them; from
  /// 1. Reads the text again, once: it is for errors and warnings.
  std::vector<std::size_t> linesOf(const std::vector<std::string>& paths) const;
  /// Whether there is a value at the path. Reads the text again.
  bool has(const std::string& path) const { return have({path}).front(); }
  /// The same for each of them. Reads the text again, once.
  std::vector<bool> have(const std::vector<std::string>& paths) const;

 private:
  std::string_view text_;
};

}  // namespace hl
