#include "surfaces/height_grid.h"

#include <string>
#include <utility>

#include "base/error.h"

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

void checkGridSize(const GridSize& size) {
  const auto sound = [](std::uint32_t side) { return side >= 2 && side <= kMaxGridSide; };
  if (!sound(size.columns) || !sound(size.rows))
    throw Error("a height field of " + std::to_string(size.columns) + " x " + std::to_string(size.rows) +
                " samples: each side must have 2 to " + std::to_string(kMaxGridSide));
}

HeightGrid::HeightGrid(const GridSize& size, std::shared_ptr<const void> samples, std::optional<double> missing)
    : size_(size),
      samples_(std::move(samples)),
      missing_(missing),
      missing_value_(missing.value_or(std::numeric_limits<double>::quiet_NaN())) {
  if (size.kind == SampleKind::kFloat32) missing_value_ = static_cast<float>(missing_value_);
  checkGridSize(size);
}

}  // namespace hl
