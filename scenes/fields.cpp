#include "fields.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/huge_pages.h"
#include "base/plain_math.h"

namespace hl {

namespace {

constexpr double kSide_m = 0.2;

/// Sine and cosine at each step along a side.
struct Wave {
  std::vector<double> sine, cosine;

  Wave(std::uint32_t samples, double per_m, double shift) {
    for (std::uint32_t i = 0; i < samples; ++i) {
      const double angle = per_m * kSide_m * (static_cast<double>(i) / (samples - 1) - 0.5) + shift;
      sine.push_back(plain::sin(angle));
      cosine.push_back(plain::cos(angle));
    }
  }
};

}  // namespace

// Sines of sums are products of waves along each side, so no sample needs a sine.
std::shared_ptr<const HeightField> makeTerrainField(std::size_t triangles) {
  constexpr double kUnit_m = 0.0145 / 32'000;
  const double cells = std::max(1.0, std::round(std::sqrt(static_cast<double>(triangles) / 2)));
  const auto side = static_cast<std::uint32_t>(cells) + 1;
  const Wave x40(side, 40, 0.4), z33(side, 33, 0), x87(side, 87, 0), z51(side, 51, 0), x190(side, 190, -0.8),
      z170(side, 170, 0.3);
  auto samples = std::make_shared<HugeVector<std::int16_t>>(std::size_t{side} * side);
  using Range = oneapi::tbb::blocked_range<std::uint32_t>;
  oneapi::tbb::parallel_for(Range(0, side), [&](const Range& rows) {
    for (std::uint32_t j = rows.begin(); j < rows.end(); ++j) {
      std::int16_t* const row = samples->data() + std::size_t{j} * side;
      for (std::uint32_t i = 0; i < side; ++i) {
        const double y = 0.009 * x40.sine[i] * z33.cosine[j] +
                         0.004 * (x87.sine[i] * z51.cosine[j] + x87.cosine[i] * z51.sine[j]) +
                         0.0015 * x190.sine[i] * z170.sine[j];
        row[i] = static_cast<std::int16_t>(std::floor(y / kUnit_m + 0.5));
      }
    }
  });
  GridFrame frame;
  const double step = kSide_m / (side - 1);
  frame.axes << step, 0, 0, 0, 0, kUnit_m, 0, step, 0;
  frame.origin = {-0.5 * kSide_m, 0, -0.5 * kSide_m};
  const std::int16_t* const first = samples->data();
  const auto grid = std::make_shared<const HeightGrid>(GridSize{side, side, SampleKind::kInt16},
                                                       std::shared_ptr<const void>(std::move(samples), first));
  return std::make_shared<const HeightField>(grid, frame);
}

}  // namespace hl
