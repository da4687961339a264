// Quantities: the table of what a surface is described by (quantities.def).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace hl {

/// kHeight is a bump map: no number, and always a texture; it turns the normal and moves nothing. m.
enum class Quantity : std::uint8_t {
#define HL_QUANTITY(quantity, ...) quantity,
#include "base/quantities.def"
#undef HL_QUANTITY
  kHeight
};

struct QuantityInfo {
  Quantity quantity;
  const char* field;  ///< of messages and recordings, with its unit
  const char* name;   ///< in capitals
  const char* unit;
  double most, otherwise, most_set, usual;
  bool texturable;
  const char* words;
};

/// All but kHeight, in the order of the enumeration.
inline constexpr std::array kQuantityInfo{
#define HL_QUANTITY(quantity, field, NAME, unit, most, otherwise, most_set, usual, texturable, words) \
  QuantityInfo{Quantity::quantity, #field, #NAME, unit, most, otherwise, most_set, usual, texturable, words},
#include "base/quantities.def"
#undef HL_QUANTITY
};
inline constexpr std::size_t kNumbers = kQuantityInfo.size();
inline constexpr std::size_t kQuantities = kNumbers + 1;

/// Of a bump map, m, either way.
inline constexpr double kMaxHeight_m = 1e9;

/// For people: "static friction".
std::string plainName(const QuantityInfo& info);
/// Of an option: "--static-friction".
std::string optionName(const QuantityInfo& info);

}  // namespace hl
