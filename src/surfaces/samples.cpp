#include "surfaces/samples.h"

#include <utility>

namespace hl {

const char* nameOf(SampleKind kind) {
  switch (kind) {
    case SampleKind::kInt16:
      return "int16";
    case SampleKind::kUint16:
      return "uint16";
    case SampleKind::kFloat32:
      break;
  }
  return "float32";
}

std::size_t sizeOf(SampleKind kind) { return kind == SampleKind::kFloat32 ? 4 : 2; }

Samples::Samples(SampleKind kind, std::shared_ptr<const void> data, std::optional<double> missing)
    : kind_(kind),
      data_(std::move(data)),
      missing_(missing),
      missing_value_(missing.value_or(std::numeric_limits<double>::quiet_NaN())) {
  if (kind == SampleKind::kFloat32) missing_value_ = static_cast<float>(missing_value_);
}

}  // namespace hl
