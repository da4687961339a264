#include "io/volume_numbers.h"

#include <fmt/core.h>

#include <cmath>

#include "io/copy_samples.h"

namespace hl {

namespace {

std::uint64_t copyTyped(ByteFile& in, const NumberForm& form, std::uint64_t count, VolumeSink& sink) {
  switch (form.type) {
    case NumberType::kInt8:
      return copySamples<std::int8_t, std::int16_t>(in, count, false, sink);
    case NumberType::kUint8:
      return copySamples<std::uint8_t, std::uint16_t>(in, count, false, sink);
    case NumberType::kInt16:
      return copySamples<std::int16_t>(in, count, form.swap, sink);
    case NumberType::kUint16:
      return copySamples<std::uint16_t>(in, count, form.swap, sink);
    case NumberType::kInt32:
      return copySamples<std::int32_t, float>(in, count, form.swap, sink);
    case NumberType::kUint32:
      return copySamples<std::uint32_t, float>(in, count, form.swap, sink);
    case NumberType::kFloat32:
      return copySamples<float>(in, count, form.swap, sink);
    case NumberType::kFloat64:
      break;
  }
  return copySamples<double, float>(in, count, form.swap, sink);
}

}  // namespace

std::size_t sizeOf(NumberType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool canBe(NumberType type, double value) {
  if (type == NumberType::kFloat32 || type == NumberType::kFloat64) return true;
  const bool is_signed = type == NumberType::kInt8 || type == NumberType::kInt16 || type == NumberType::kInt32;
  const int bits = 8 * static_cast<int>(sizeOf(type));
  const double least = is_signed ? -std::ldexp(1, bits - 1) : 0;
  const double end = std::ldexp(1, is_signed ? bits - 1 : bits);
  return value >= least && value < end && value == std::floor(value);
}

SampleKind keptAs(NumberType type) {
  if (type == NumberType::kInt8 || type == NumberType::kInt16) return SampleKind::kInt16;
  if (type == NumberType::kUint8 || type == NumberType::kUint16) return SampleKind::kUint16;
  return SampleKind::kFloat32;
}

void copyNumbers(ByteFile& in, const NumberForm& form, std::uint64_t count, VolumeSink& sink) {
  const std::uint64_t rounded = copyTyped(in, form, count, sink);
  in.checkEnd();
  if (rounded > 0) sink.warn(fmt::format("{} of its {} numbers are rounded to single precision", rounded, count));
}

}  // namespace hl
