// Zero fall-through: a soup of a million triangles with random gaps below the proxy's diameter, poked a million times.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "environment.h"
#include "proxy/judge.h"
#include "proxy/proxy.h"

namespace hl::test_proxy_fuzz {
namespace {

// HL_POKES=1000000 in the environment makes it the million; the suite takes fewer to be quick.
#ifdef HL_SANITIZED
constexpr int kUsualPokes = 2'000;
constexpr std::uint32_t kCells = 200;
#else
constexpr int kUsualPokes = 100'000;
constexpr std::uint32_t kCells = 707;
#endif

constexpr double kRadius = 1e-3;
constexpr double kSide = 0.2;

// A sheet of about a million triangles; every vertex of every triangle is moved by up to 0.45 radii, so that
// neighbours gape and cross; one triangle in ten is missing.
Model tornSheet(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Model sheet =
      judge::grid(kCells, kCells, [](double u, double v) { return Vec3((u - 0.5) * kSide, (v - 0.5) * kSide, 0); });
  std::vector<std::array<Vec3, 3>> soup;
  for (const auto& t : sheet.triangles) {
    if (random() % 10 == 0) continue;
    std::array<Vec3, 3> torn;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 away(uniform(random), uniform(random), uniform(random));
      torn[i] = sheet.positions[t[i]] + 0.45 * kRadius / std::max(1.0, away.norm()) * away;
    }
    soup.push_back(torn);
  }
  std::shuffle(soup.begin(), soup.end(), random);
  return judge::triangles(soup);
}

TEST(C02Fuzz, PokesIntoATornSheetOfAMillionTrianglesNeverFallThrough) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto snapshot = judge::scene(tornSheet(random));
  const ProxySettings settings{kRadius, 1000};
  int through = 0;
  int capped = 0;
  int inside = 0;
  const int count = test::numberIn("HL_POKES", kUsualPokes);
  for (int i = 0; i < count; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    const Vec3 above(0.09 * uniform(random), 0.09 * uniform(random), 3 * kRadius * side);
    ProxyState state = startProxy(*snapshot, settings, above);
    const Vec3 below = above + Vec3(4e-3 * uniform(random), 4e-3 * uniform(random),
                                    -side * (0.004 + 0.02 * std::abs(uniform(random))));
    capped += tick(state, *snapshot, settings, below).capped();
    through += state.position.z() * side < 0;
    if (i % 16 == 0) inside += judge::clearance(*snapshot, state.position, kRadius) < kRadius * (1 - 1e-6);
  }
  std::printf("%zu triangles, %d pokes: %d through, %d inside, %d capped\n", snapshot->primitives, count, through,
              inside, capped);
  EXPECT_EQ(through, 0);
  EXPECT_EQ(inside, 0);
  EXPECT_EQ(capped, 0);
}

}  // namespace
}  // namespace hl::test_proxy_fuzz
