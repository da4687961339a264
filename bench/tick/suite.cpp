#include "tick/suite.h"

#include <cmath>
#include <map>
#include <utility>

#include "tick/round.h"

namespace hl::bench {

namespace {

constexpr std::size_t kGrowthFrom = 10'000;  // asked for; smaller scenes lie in the first caches

struct Point {
  std::size_t primitives;
  double median_us;
};

// Least squares of lg median against lg primitives.
double slopeOf(const std::vector<Point>& points) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Point& point : points) {
    const double u = std::log(static_cast<double>(point.primitives)), v = std::log(point.median_us);
    n += 1;
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

void runScene(const SuitePlan& plan, const SuiteOutput& output, const BenchScene& scene) {
  std::map<std::pair<RadiusMode, FingerMotion>, std::vector<Point>> medians;
  for (const std::size_t size : scene.sizes) {
    Round round(plan, output, scene, size);
    round.run();
    if (size < kGrowthFrom) continue;
    for (const Case& of : round.cases()) {
      medians[{of.mode, of.motion}].push_back({round.primitives(), of.plain.median_us()});
    }
  }
  for (const auto& [what, points] : medians) {
    if (points.size() < 2) continue;
    output.growth({scene.name, nameOf(what.second), nameOf(what.first), slopeOf(points), points.front().primitives,
                   points.back().primitives});
  }
}

}  // namespace

const char* nameOf(RadiusMode mode) {
  constexpr std::array<const char*, kRadiusModes.size()> kNames{"fixed", "scaled", "zoomed"};
  return kNames[static_cast<std::size_t>(mode)];
}

void runSuite(const SuitePlan& plan, const SuiteOutput& output) {
  for (const BenchScene& scene : plan.scenes) runScene(plan, output, scene);
}

}  // namespace hl::bench
