// Height fields for tests, and the same triangles as a mesh.
#pragma once

#include <cstring>
#include <functional>
#include <memory>
#include <type_traits>
#include <vector>

#include "geometry/scenes.h"
#include "index_judge.h"
#include "surfaces/height_field.h"

namespace hl::test {

template <typename Sample>
std::shared_ptr<const HeightGrid> gridOf(std::uint32_t columns, std::uint32_t rows, const std::vector<Sample>& samples,
                                         std::optional<double> missing = {}) {
  const auto kept = std::make_shared<const std::vector<Sample>>(samples);
  GridSize size{columns, rows, SampleKind::kFloat32};
  if (std::is_same_v<Sample, std::int16_t>) size.kind = SampleKind::kInt16;
  if (std::is_same_v<Sample, std::uint16_t>) size.kind = SampleKind::kUint16;
  return std::make_shared<const HeightGrid>(size, std::shared_ptr<const void>(kept, kept->data()), missing);
}

/// Metres: columns east (x), rows south (z), heights up (y), with the first sample at the origin.
inline GridFrame uprightFrame(double spacing, double scale) {
  GridFrame frame;
  frame.axes.col(0) = Vec3(spacing, 0, 0);
  frame.axes.col(1) = Vec3(0, 0, spacing);
  frame.axes.col(2) = Vec3(0, scale, 0);
  return frame;
}

/// A field of float samples height(column, row), m.
inline std::shared_ptr<const HeightField> fieldOf(std::uint32_t columns, std::uint32_t rows, double spacing,
                                                  const std::function<double(double, double)>& height) {
  std::vector<float> samples;
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) samples.push_back(static_cast<float>(height(i, j)));
  }
  return std::make_shared<const HeightField>(gridOf(columns, rows, samples), uprightFrame(spacing, 1));
}

/// A field of random form: kind of samples, roughness, gaps, frame.
inline std::shared_ptr<const HeightField> randomField(Random& random) {
  const auto columns = static_cast<std::uint32_t>(2 + random.below(random.below(3) == 0 ? 3 : 60));
  const auto rows = static_cast<std::uint32_t>(2 + random.below(random.below(3) == 0 ? 3 : 60));
  const double rough = std::pow(10.0, random.uniform(-3, 0.5)), gaps = random.below(3) == 0 ? 0.15 : 0;
  const double slope_i = random.uniform(-1, 1), slope_j = random.uniform(-1, 1), waves = random.uniform(0, 5);
  const auto value = [&](std::uint32_t i, std::uint32_t j) {
    return slope_i * i + slope_j * j + waves * std::sin(0.3 * i + 0.2 * j) + rough * random.uniform(-1, 1);
  };
  GridFrame frame = uprightFrame(1, 1);
  const int form = random.below(4);
  if (form == 1) frame.axes.col(0) *= random.uniform(0.3, 3);
  if (form == 2)
    frame.axes = Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix() * frame.axes;
  if (form == 3) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) frame.axes.col(axis) += random.inCube(0.4);
  }
  const double scale = std::pow(10.0, random.below(3) == 0 ? random.uniform(-9, 5) : -3);
  frame = frame.placed(scale * Mat3::Identity(), random.below(2) * scale * random.inCube(1e4));
  const int kind = random.below(3);
  if (kind == 0) {
    std::vector<float> samples;
    for (std::uint32_t n = 0; n < columns * rows; ++n)
      samples.push_back(random.uniform(0, 1) < gaps ? NAN : static_cast<float>(value(n % columns, n / columns)));
    return std::make_shared<const HeightField>(gridOf(columns, rows, samples), frame);
  }
  frame.axes.col(2) *= 0.01;
  if (kind == 1) {
    std::vector<std::int16_t> samples;
    for (std::uint32_t n = 0; n < columns * rows; ++n)
      samples.push_back(random.uniform(0, 1) < gaps ? -32768
                                                    : static_cast<std::int16_t>(100 * value(n % columns, n / columns)));
    return std::make_shared<const HeightField>(gridOf(columns, rows, samples, -32768), frame);
  }
  std::vector<std::uint16_t> samples;
  for (std::uint32_t n = 0; n < columns * rows; ++n)
    samples.push_back(random.uniform(0, 1) < gaps
                          ? 65535
                          : static_cast<std::uint16_t>(20000 + 100 * value(n % columns, n / columns)));
  return std::make_shared<const HeightField>(gridOf(columns, rows, samples, 65535), frame);
}

}  // namespace hl::test
