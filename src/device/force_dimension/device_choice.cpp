#include "device/force_dimension/device_choice.h"

#include <charconv>
#include <string_view>

#include "base/error.h"

namespace hl {

namespace {

// What fits in the library's ids and serial numbers.
constexpr int kMaxIndex = 15, kMaxSerial = 65535;

std::optional<int> wholeNumber(std::string_view text, int most) {
  int number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0 || number > most) return {};
  return number;
}

}  // namespace

ForceDimensionChoice ForceDimensionChoice::parse(const std::string& text) {
  constexpr std::string_view kSerial = "serial=";
  ForceDimensionChoice choice;
  if (text.empty()) return choice;
  if (text.starts_with(kSerial))
    choice.serial = wholeNumber(std::string_view(text).substr(kSerial.size()), kMaxSerial);
  else
    choice.index = wholeNumber(text, kMaxIndex);
  if (!choice.index && !choice.serial)
    throw Error("'" + text + "' is no Force Dimension device: write its index from 0 (dhd:1), or its serial number " +
                "(dhd:serial=1234)");
  return choice;
}

std::string ForceDimensionChoice::key() const {
  return serial ? "serial=" + std::to_string(*serial) : std::to_string(index.value_or(0));
}

}  // namespace hl
