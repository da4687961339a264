#include "surfaces/height_grid.h"

#include <string>
#include <utility>

#include "base/error.h"

namespace hl {

void checkGridSize(const GridSize& size) {
  const auto sound = [](std::uint32_t side) { return side >= 2 && side <= kMaxGridSide; };
  if (!sound(size.columns) || !sound(size.rows))
    throw Error("a height field of " + std::to_string(size.columns) + " x " + std::to_string(size.rows) +
                " samples: each side must have 2 to " + std::to_string(kMaxGridSide));
}

HeightGrid::HeightGrid(const GridSize& size, std::shared_ptr<const void> samples, std::optional<double> missing)
    : size_(size), samples_(size.kind, std::move(samples), missing) {
  checkGridSize(size);
}

}  // namespace hl
