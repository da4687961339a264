// Colours in messages: three numbers of 0..255 each.
#pragma once

#include <google/protobuf/repeated_field.h>

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "base/rgb.h"

namespace hl {

/// Throws hl::Error, without a place, for numbers above 255; what is left of the last three does not count.
inline std::vector<Rgb> coloursIn(const google::protobuf::RepeatedField<std::uint32_t>& in) {
  const auto byte = [&](int i) {
    if (in[i] > 255) throw Error("colours must be whole numbers from 0 to 255");
    return static_cast<std::uint8_t>(in[i]);
  };
  std::vector<Rgb> colours;
  colours.reserve(static_cast<std::size_t>(in.size()) / 3);
  for (int i = 0; i + 2 < in.size(); i += 3) colours.push_back({byte(i), byte(i + 1), byte(i + 2)});
  return colours;
}

}  // namespace hl
