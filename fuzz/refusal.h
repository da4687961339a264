// What every reader of bytes promises: it takes them, or throws hl::Error with one line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.h"
#include "require.h"
#include "temp_folder.h"

namespace hl::fuzz {

/// Whether `read` took it. Aborts when it refused with anything but one line.
template <typename Read>
bool takes(const Read& read) {
  try {
    read();
    return true;
  } catch (const Error& error) {
    const std::string_view line = error.what();
    require(!line.empty() && line.find('\n') == std::string_view::npos);
    return false;
  }
}

inline std::string textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A file with these bytes, in the fuzzer's own folder, where nothing else is.
inline std::string fileOf(const std::string& name, const std::uint8_t* data, std::size_t size) {
  return test::fileWith(name, textOf(data, size));
}

}  // namespace hl::fuzz
