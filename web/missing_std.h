// What the C++20 library of Debian 12's emscripten lacks and HL uses; included before every source of the web module.
#pragma once

#include <bit>

#if !defined(__cpp_lib_bit_cast)
namespace std {

template <typename To, typename From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

}  // namespace std
#endif
