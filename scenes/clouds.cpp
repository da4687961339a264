#include "clouds.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/plain_math.h"
#include "base/splitmix64.h"
#include "surfaces/cloud_maker.h"

namespace hl {

namespace {

constexpr double kStep_m = 0x1p-24;  // of the lattice: 60 nm
constexpr double kAcross_m = 0.2;

/// `point(i)` gives the place of a point, m, and its normal.
template <typename PointOf>
std::shared_ptr<const PointCloud> cloudFrom(std::size_t count, const PointOf& point) {
  CloudInput input;
  input.lattice = {Vec3::Constant(kStep_m), Vec3::Zero()};
  input.exact = true;  // the rounded places are the cloud
  input.points.resize(count);
  using Range = oneapi::tbb::blocked_range<std::size_t>;
  oneapi::tbb::parallel_for(Range(0, count), [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const std::pair<Vec3, Vec3> made = point(i);
      const auto step = [&](Eigen::Index axis) {
        return static_cast<std::int32_t>(std::floor(made.first[axis] / kStep_m + 0.5));
      };
      input.points[i] = {{step(0), step(1), step(2)}, packNormal(made.second)};
    }
  });
  return std::make_shared<const PointCloud>(makeCloud(std::move(input)), CloudLook{});
}

}  // namespace

// Each point lies the golden angle farther around the axis than the one before, on a ring of the same area.
std::shared_ptr<const PointCloud> makeSphereCloud(std::size_t points) {
  constexpr double kGoldenTurn = 0.6180339887498949;
  return cloudFrom(points, [&](std::size_t i) {
    const double y = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(points);
    const double turn = kGoldenTurn * static_cast<double>(i), angle = 2 * M_PI * (turn - std::floor(turn));
    const double ring = std::sqrt(1 - y * y);
    const Vec3 n(ring * plain::cos(angle), y, ring * plain::sin(angle));
    return std::pair<Vec3, Vec3>(0.5 * kAcross_m * n, n);
  });
}

std::shared_ptr<const PointCloud> makeTerrainCloud(std::size_t points) {
  return cloudFrom(points, [](std::size_t i) {
    const auto across = [](std::uint64_t seed) {
      return kAcross_m * (static_cast<double>(splitmix64(seed) >> 11) * 0x1p-53 - 0.5);
    };
    const double x = across(2 * i), z = across(2 * i + 1);
    const double y = 0.009 * plain::sin(40 * x + 0.4) * plain::cos(33 * z) + 0.004 * plain::sin(87 * x + 51 * z) +
                     0.0015 * plain::sin(190 * x - 0.8) * plain::sin(170 * z + 0.3);
    return std::pair<Vec3, Vec3>(Vec3(x, y, z), Vec3::Zero());
  });
}

}  // namespace hl
