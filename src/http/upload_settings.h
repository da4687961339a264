// UploadSettings: how a server takes files from its pages, and who opens them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace hl {

struct UploadSettings {
  std::uint64_t limit_bytes = 0;  ///< of one file; 0: none is taken
  double silence_s = 10;          ///< in which each 64 KiB must come
  double whole_s = 900;           ///< for the whole file
  /// Opens the file, an open descriptor at its end, which is closed afterwards; returns JSON for the page. In a thread
  /// of its own, one call at a time. Throws hl::Error, with one line, and then has changed nothing.
  std::function<std::string(int descriptor, const std::string& name)> open{};
};

}  // namespace hl
