#include "surfaces/block_normals.h"

#include <algorithm>
#include <bit>

namespace hl {

BlockNormals::BlockNormals(std::span<const std::uint32_t> normals) {
  Parts high{};
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Point point = pointOf(normals[i]);
    if (i == 0) axis_ = largestOf(point);
    if (normalOf(point) != normals[i]) {
      keepWhole();
      return;
    }
    const Parts parts = partsOf(point);
    for (std::size_t k = 0; k < 3; ++k) {
      low_[k] = i == 0 ? parts[k] : std::min(low_[k], parts[k]);
      high[k] = i == 0 ? parts[k] : std::max(high[k], parts[k]);
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
    width_[k] = static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(high[k] - low_[k])));
  if (each() >= kWholeBits) keepWhole();
}

void BlockNormals::keepWhole() {
  axis_ = kWhole;
  low_ = {};
  width_ = {};
}

void BlockNormals::write(std::span<const std::uint32_t> normals, std::uint8_t* bytes, std::uint64_t first_bit) const {
  std::uint64_t bit = first_bit;
  const auto next = [&](unsigned width, std::uint32_t number) {
    writeBits(bytes, bit, width, number);
    bit += width;
  };
  next(kAxisBits, axis_);
  for (std::size_t k = 0; k < 3; ++k) {
    next(kPartBits[k], static_cast<std::uint32_t>(low_[k] + kOffset[k]));
    next(kWidthBits[k], width_[k]);
  }
  for (const std::uint32_t normal : normals) {
    if (axis_ == kWhole) {
      next(kWholeBits, normal);
      continue;
    }
    const Parts parts = partsOf(pointOf(normal));
    for (std::size_t k = 0; k < 3; ++k) next(width_[k], static_cast<std::uint32_t>(parts[k] - low_[k]));
  }
}

BlockNormals::Point BlockNormals::pointOf(std::uint32_t normal) {
  const std::int32_t u = static_cast<std::int32_t>(normal >> 16) - kZero;
  const std::int32_t v = static_cast<std::int32_t>(normal & 0xffff) - kZero;
  const std::int32_t w = kUnit - std::abs(u) - std::abs(v);
  if (w >= 0) return {u, v, w};
  return {(kUnit - std::abs(v)) * signOf(u), (kUnit - std::abs(u)) * signOf(v), w};
}

std::uint32_t BlockNormals::largestOf(const Point& point) {
  const Point size{std::abs(point[0]), std::abs(point[1]), std::abs(point[2])};
  return static_cast<std::uint32_t>(std::max_element(size.begin(), size.end()) - size.begin());
}

BlockNormals::Parts BlockNormals::partsOf(const Point& point) const {
  const std::int32_t sign = signOf(point[axis_]);
  return {sign > 0 ? 0 : 1, sign * point[(axis_ + 1) % 3], sign * point[(axis_ + 2) % 3]};
}

}  // namespace hl
