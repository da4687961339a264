#include "soak/closed_surfaces.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/scene_model.h"
#include "soak/random_surfaces.h"
#include "surfaces/fields.h"
#include "surfaces/implicit/implicit_surface.h"

namespace hl::soak {

namespace {

// A square of samples 1 mm apart, of hills and noise, with a rim of 60 mm.
struct Basin {
  static constexpr int kSide = 40;
  static constexpr double kCell_m = 1e-3, kRim_m = 0.06;

  explicit Basin(test::Random& random) {
    const double high_m = std::pow(10.0, random.uniform(-4, -2)), noise_m = std::pow(10.0, random.uniform(-6, -2.5));
    const Vec3 waves = random.inCube(2);
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const bool rim = std::min(i, j) == 0 || std::max(i, j) == kSide - 1;
        const double hills_m = high_m * std::sin(waves.x() * i) * std::cos(waves.y() * j + waves.z());
        heights.push_back(static_cast<float>(rim ? kRim_m : hills_m + noise_m * random.uniform(-1, 1)));
      }
    }
  }
  // Beneath all four samples around it, or above them.
  Site siteOf(const Vec3& place) const {
    const auto cell = [](double at) { return static_cast<int>(std::floor(at / kCell_m)); };
    const int i = cell(place.x()), j = cell(place.z());
    if (std::min(i, j) < 0 || std::max(i, j) > kSide - 2) return Site::kUnknown;
    const auto at = [&](int a, int b) { return heights[static_cast<std::size_t>(b * kSide + a)]; };
    const auto [low, high] = std::minmax({at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    return place.y() < low ? Site::kMatter : place.y() > high ? Site::kOpen : Site::kBoundary;
  }

  std::vector<float> heights;
};

ClosedSurface drawBasin(test::Random& random) {
  const auto basin = std::make_shared<const Basin>(random);
  const Source source = std::make_shared<const HeightField>(test::gridOf(Basin::kSide, Basin::kSide, basin->heights),
                                                            test::uprightFrame(Basin::kCell_m, 1));
  ClosedSurface closed;
  SceneModel model;
  model.surfaces.push_back({"basin", source});
  closed.snapshot = makeSnapshot(std::move(model));
  closed.settings.radius = std::pow(10.0, random.uniform(-5, -2.5));
  closed.siteOf = [basin](const Vec3& place) { return basin->siteOf(place); };
  closed.confined = [](const Vec3& place) {
    const double far_m = (Basin::kSide - 1) * Basin::kCell_m;
    return Vec3(std::clamp(place.x(), 0.0, far_m), std::min(place.y(), 0.5 * Basin::kRim_m),
                std::clamp(place.z(), 0.0, far_m));
  };
  return closed;
}

// Its own siteOf() looks at samples or at the function alone.
ClosedSurface drawSolidOf(test::Random& random, const Source& source) {
  ClosedSurface closed;
  SceneModel model;
  model.surfaces.push_back({"solid", source});
  closed.snapshot = makeSnapshot(std::move(model));
  closed.settings.radius = source->bounds().size().norm() * std::pow(10.0, random.uniform(-4, -0.7));
  closed.siteOf = [source](const Vec3& place) { return source->siteOf(place); };
  return closed;
}

// Of more triangles a proxy that touches many at once takes milliseconds a tick.
Source drawModestSolid(test::Random& random) {
  constexpr std::uint64_t kMaxTriangles = 50'000;
  Source source = drawSolid(random);
  while (source->triangles() > kMaxTriangles) source = drawSolid(random);
  return source;
}

}  // namespace

ClosedSurface drawClosed(test::Random& random, std::size_t kind) {
  ClosedSurface closed = kind == 0   ? drawBasin(random)
                         : kind == 1 ? drawSolidOf(random, drawLump(random))
                                     : drawSolidOf(random, drawModestSolid(random));
  const Box& bounds = closed.snapshot->bounds;
  closed.centre = bounds.centre();
  closed.half = 0.5 * bounds.size().maxCoeff() / closed.settings.radius + 1;
  constexpr std::size_t kMarks = 2000;
  for (const Vec3& place : closed.snapshot->shape().source->drawn(kMarks).positions)
    closed.marks.emplace_back((place - closed.centre) / closed.settings.radius);
  closed.settings.ledger = static_cast<LedgerMode>(random.below(3));
  return closed;
}

}  // namespace hl::soak
