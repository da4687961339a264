// Surfaces of expressions: their triangles, what finds them, and how they are felt.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "expressions.h"
#include "guard/realtime_guard.h"
#include "index_judge.h"
#include "proxy/proxy.h"
#include "scene/scene_model.h"
#include "surfaces/implicit/implicit_index.h"
#include "surfaces/implicit/sheet_list.h"
#include "surfaces/implicit/sheet_measure.h"

namespace hl::test_implicit_surface {
namespace {

using K = ExpressionKind;

std::shared_ptr<const Snapshot> sceneOf(std::shared_ptr<const PrimitiveSource> source) {
  Instance instance;
  instance.shape = makeShape(std::move(source));
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = 1;
  return makeSnapshot({std::move(instance)});
}

/// Coarse surfaces, so that all their triangles can be looked at; placed anyhow.
std::vector<std::shared_ptr<const PrimitiveSource>> coarseSurfaces() {
  test::Random random(11);
  const Expression box = turned(test::box(Vec3(0.012, 0.009, 0.01)), random),
                   other = turned(test::box(Vec3(0.02, 0.006, 0.005)), random);
  const Expression solids[] = {
      test::of(K::kUnion, {box, other}),
      test::changed(K::kShell, box, 0.002),
      test::of(K::kDifference, {box, test::sphere(0.004, Vec3(0.004, 0.004, 0))}),
      test::of(K::kIntersection,
               {other, turned(test::rod(K::kCylinder, 0.004, 0.03), random), test::halfSpace(Vec3(1, 2, 3))}),
      test::torus(0.01, 0.004),
      test::of(K::kUnion, {test::sphere(0.008), turned(test::rod(K::kCapsule, 0.005, 0.02), random)}, 0.004)};
  std::vector<std::shared_ptr<const PrimitiveSource>> surfaces;
  for (const Expression& solid : solids) {
    Mat3 linear = Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix();
    if (random.below(2) == 0) linear.col(1) *= -random.uniform(0.5, 2);
    surfaces.push_back(test::surfaceOf(solid, 1e-4)->placed(linear, random.inCube(0.01)));
  }
  return surfaces;
}

std::shared_ptr<const PrimitiveSource> coarseSurface(test::Random& random) {
  static const auto kSurfaces = coarseSurfaces();
  return kSurfaces[static_cast<std::size_t>(random.below(static_cast<int>(kSurfaces.size())))];
}

test::TestBall randomBall(test::Random& random, const PrimitiveSource& source) {
  const Box bounds = source.bounds();
  const Vec3 size = bounds.size();
  const Vec3 centre = bounds.centre() + 0.6 * random.inCube(1).cwiseProduct(size);
  return {centre, 0.003 * std::pow(10.0, random.uniform(-2, 0.5)), 1e-3};
}

TEST(ImplicitIndex, FirstImpactsAreThoseOfTheMesh) { test::expectImpactsOfMesh(coarseSurface, randomBall, 20, 8, 150); }

TEST(ImplicitIndex, WhatIsWithinADistanceIsWhatIsOfTheMesh) {
  test::expectDistancesOfMesh(coarseSurface, randomBall, 8, 60);
}

TEST(ImplicitIndex, TheNearestTriangleIsThatOfTheMesh) { test::expectNearestOfMesh(coarseSurface, randomBall, 8, 60); }

/// The numbers of all triangles of a sheet, of all its cells, without bricks and intervals.
std::vector<ElementId> allOf(const Sheet& sheet) {
  std::vector<ElementId> found;
  SheetPieces pieces;
  const auto& cells = sheet.grid().cells;
  for (std::uint64_t i = 0; i < std::uint64_t{cells[0]} * cells[1] * cells[2]; ++i) {
    const Sheet::Place at{static_cast<std::uint32_t>(i % cells[0]), static_cast<std::uint32_t>(i / cells[0] % cells[1]),
                          static_cast<std::uint32_t>(i / cells[0] / cells[1])};
    const IsoCell cell = sheet.cellAt(at);
    for (unsigned n = 0; cell.triangles != nullptr && n < cell.triangles->count; ++n) {
      sheet.pieces(sheet.corners(cell, n), pieces);
      for (unsigned piece = 0; piece < pieces.count; ++piece) {
        const auto& [a, b, c] = pieces.triangles[piece];
        if (isTriangle(a, b, c)) found.push_back(SheetTriangle{sheet.number(), at, n, piece}.id());
      }
    }
  }
  return found;
}

Expression machined(test::Random& random) {
  const Expression plates =
      test::of(K::kUnion,
               {turned(test::box(Vec3(0.02, 0.004, 0.01)), random), turned(test::box(Vec3(0.004, 0.018, 0.01)), random),
                test::of(K::kIntersection, {test::sphere(0.008), test::torus(0.006, 0.003)})});
  return test::of(K::kDifference, {plates, turned(test::rod(K::kCylinder, 0.003, 0.04), random)});
}

Vec3 placeIn(test::Random& random, const Box& box) {
  return {random.uniform(box.min.x(), box.max.x()), random.uniform(box.min.y(), box.max.y()),
          random.uniform(box.min.z(), box.max.z())};
}

// Known of boxes within each other, as a walk comes to them; the cuts are the same to the bit.
TEST(SheetSides, WhatIsKnownOfABoxChangesNoCutInIt) {
  test::Random random(8);
  int cut = 0, saved = 0;
  std::unique_ptr<const SheetList> solid;
  for (int i = 0; i < 3000 * test::longer(); ++i) {
    if (i % 100 == 0) solid = std::make_unique<SheetList>(ImplicitSpec{machined(random), test::cube(0.012), 1e-3});
    const SheetList& list = *solid;
    const Sheet& sheet = list.sheets[static_cast<std::size_t>(random.below(static_cast<int>(list.sheets.size())))];
    SheetSides sides;
    Box box = list.bounds;
    bool may = true;
    for (int depth = random.below(4); depth >= 0 && may; --depth) {
      const Vec3 low = placeIn(random, box), size = box.size() * std::pow(10.0, random.uniform(-1.5, 0));
      box = {low, (low + size).cwiseMin(box.max)};
      may = sides.mayHold(sheet.function(), sheet.conditions(), sheet.slack(), spaceOf(box, 0));
    }
    SheetPieces whole, known;
    for (int k = 0; k < 10; ++k) {
      const std::array<Vec3, 3> triangle{placeIn(random, box), placeIn(random, box), placeIn(random, box)};
      sheet.pieces(triangle, whole);
      sheet.pieces(triangle, known, sides);
      ASSERT_TRUE(may || whole.count == 0);
      ASSERT_EQ(known.count, whole.count);
      for (std::size_t piece = 0; piece < whole.count; ++piece)
        ASSERT_EQ(known.triangles[piece], whole.triangles[piece]);
      cut += whole.count > 0;
      saved += known.looks < whole.looks;
    }
  }
  EXPECT_GT(cut, 2000);
  EXPECT_GT(saved, 10'000);
}

TEST(ImplicitIndex, BricksLeaveNoCellOut) {
  test::Random random(7);
  std::size_t found = 0;
  for (const Expression& solid :
       {test::torus(0.007, 0.003), turned(test::box(Vec3(0.01, 0.012, 0.008)), random),
        test::of(K::kDifference, {test::sphere(0.01), turned(test::rod(K::kCylinder, 0.005, 0.04), random)}),
        test::of(K::kIntersection, {test::sphere(0.01), test::gyroid(0.02, 0.002)}),
        test::of(K::kUnion, {test::sphere(0.007), test::sphere(0.006, Vec3(0.005, 0.002, 0))}, 0.004),
        machined(random)}) {
    const SheetList list({solid, test::cube(0.012), 1e-3});
    const std::vector<Sheet> sheets = list.coarser(5);
    std::vector<ElementId> one, other;
    for (const Sheet& sheet : sheets) {
      for (const ElementId id : allOf(sheet)) one.push_back(id);
    }
    const ImplicitIndex index(sheets, GridFrame(), list.bounds, 1e-3);
    index.overlap(Vec3::Zero(), 1, [&](ElementId id) { other.push_back(id); });
    std::sort(one.begin(), one.end());
    std::sort(other.begin(), other.end());
    ASSERT_EQ(one, other);
    found += one.size();
  }
  EXPECT_GT(found, 10'000U);
}

// Of 20 periods it needs the cells that one needs, and as many more triangles as it is larger.
TEST(ImplicitSurface, AGyroidIsMeasuredByOnePeriod) {
  constexpr double kPeriod = 0.01;
  for (const double thickness : {0.0, 0.001}) {
    test::Random random(3);
    for (const bool turn : {false, true}) {
      const Expression wave = test::gyroid(kPeriod, thickness);
      const Expression gyroid = turn ? turned(wave, random) : wave;
      const SheetList small({gyroid, test::cube(1.2 * kPeriod), 1e-5}), large({gyroid, test::cube(10 * kPeriod), 1e-5});
      const double step = small.sheets[0].grid().step;
      EXPECT_GT(large.sheets[0].grid().step, 0.6 * step);
      EXPECT_LT(large.sheets[0].grid().step, 1.6 * step);
      const double cells = std::pow(large.sheets[0].grid().step / step, 2);
      const double larger = large.triangles * cells / small.triangles / std::pow(10 / 1.2, 3);
      EXPECT_GT(larger, 0.3);
      EXPECT_LT(larger, 3);
    }
  }
}

TEST(ImplicitSurface, TrianglesAreWithinTheStatedError) {
  test::Random random(8);
  int surfaces = 0;
  for (int i = 0; i < 12; ++i) {
    try {
      const auto surface = test::surfaceOf(test::randomSolid(random), 2e-4);
      if (surface->triangles() > 300'000) continue;
      const ImplicitFunction function(surface->spec().expression);
      const DrawnMesh mesh = surface->drawn(~std::size_t{0});
      double worst = 0;
      for (const auto& t : mesh.triangles) {
        const Vec3 p = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
        worst = std::max(worst, std::abs(function.at(p)));
      }
      // Values are distances, but for a gyroid's, which are up to sqrt(2) as large, and in blends, where less.
      EXPECT_LT(worst, 1.5 * surface->error_m()) << i;
      EXPECT_LE(surface->error_m(), 2e-4 + 1e-12);
      ++surfaces;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(surfaces, 3);
}

Vec3 ontoZero(const SmoothFunction& smooth, const Vec3& p) {
  const Vec3 gradient = smooth.gradient(p);
  return p - smooth.at(p) / std::max(gradient.squaredNorm(), 1e-6) * gradient;
}

double distanceFrom(const ImplicitFunction& function, const Vec3& p) {
  constexpr double kStep_m = 1e-8;
  Vec3 gradient;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vec3 step = kStep_m * Vec3::Unit(axis);
    gradient[axis] = (function.at(p + step) - function.at(p - step)) / (2 * kStep_m);
  }
  return std::abs(function.at(p)) / gradient.norm();
}

/// How far what is left of the triangles around a place is from the surface.
double worstAround(const SheetList& list, const Sheet& sheet, const Vec3& p) {
  const Vec3 place = (p - sheet.grid().origin) / sheet.grid().step;
  double worst = 0;
  for (int n = 0; n < 27; ++n) {
    const Vec3 at = place + Vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    const auto& cells = sheet.grid().cells;
    if (!(at.array() >= 0).all() || !(at.array() < Vec3(cells[0], cells[1], cells[2]).array()).all()) continue;
    const IsoCell cell = sheet.cellAt(
        {static_cast<std::uint32_t>(at.x()), static_cast<std::uint32_t>(at.y()), static_cast<std::uint32_t>(at.z())});
    for (unsigned triangle = 0; cell.triangles != nullptr && triangle < cell.triangles->count; ++triangle) {
      SheetPieces pieces;
      sheet.pieces(sheet.corners(cell, triangle), pieces);
      for (std::size_t i = 0; i < pieces.count; ++i) {
        for (const Vec3& corner : pieces.triangles[i]) worst = std::max(worst, distanceFrom(list.function, corner));
      }
    }
  }
  return worst;
}

/// At the edges between two sheets, as a multiple of the stated error.
double worstAtEdges(const SheetList& list, test::Random& random) {
  double worst = 0;
  for (int i = 0; i < 600; ++i) {
    const Sheet& sheet = list.sheets[static_cast<std::size_t>(random.below(static_cast<int>(list.sheets.size())))];
    const auto& functions = list.function.sheets();
    const SmoothFunction& other = functions[static_cast<std::size_t>(random.below(static_cast<int>(functions.size())))];
    Vec3 p = list.bounds.centre() + random.inCube(0.5).cwiseProduct(list.bounds.size());
    for (int step = 0; step < 12; ++step) p = ontoZero(step % 2 == 0 ? other : sheet.smooth(), p);
    worst = std::max(worst, worstAround(list, sheet, p));
  }
  return worst / list.error_m;
}

// Where a blend is less steep than a distance, a value stands for a longer way.
TEST(ImplicitSurface, SharpEdgesAreWithinTheStatedError) {
  test::Random random(21);
  const Expression block = test::box(Vec3(0.046, 0.057, 0.038)),
                   dent = test::sphere(0.009, Vec3(0.0135, 0.0164, 0.013));
  EXPECT_LE(worstAtEdges(SheetList({test::of(K::kDifference, {block, dent}, 0.0023), {}, 1e-5}), random), 1.001);
  int surfaces = 0;
  for (int i = 0; i < 12; ++i) {
    const Expression box = turned(test::box(Vec3(0.02, 0.03, 0.025)), random);
    Expression other = i % 3 == 0   ? test::sphere(random.uniform(0.006, 0.012))
                       : i % 3 == 1 ? turned(test::rod(K::kCapsule, 0.006, 0.04), random)
                                    : turned(test::torus(0.012, 0.004), random);
    other.place = random.inCube(0.015);
    const K kinds[] = {K::kUnion, K::kIntersection, K::kDifference};
    const double smooth = i < 3 ? 0 : random.uniform(0.001, 0.006);
    try {
      const SheetList list({test::of(kinds[random.below(3)], {box, other}, smooth), {}, 5e-5});
      EXPECT_LE(list.error_m, 5e-5 + 1e-12);
      EXPECT_LE(worstAtEdges(list, random), 1.001) << i;
      ++surfaces;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(surfaces, 6);
}

bool isKept(const Expression& expression, double error_m) {
  try {
    const SheetList list({expression, {}, error_m});
    return list.error_m <= (1 + 1e-6) * error_m;
  } catch (const Error&) {
    return false;
  }
}

// The sheets of the box look out of the capsule by so little that only boxes as small as a cell prove it of some.
TEST(ImplicitSurface, ABoxThatJustLooksOutOfACapsuleIsKept) {
  Expression box = test::box(Vec3(65.42323852184755, 20.044731430524514, 33.80604329786732));
  box.axis = Vec3(0.7744488483540374, 0.5329830646314784, -0.3397358350394477);
  box.degrees = -63.03057497149619;
  Expression whole = test::of(K::kUnion, {box, test::rod(K::kCapsule, 41.813604233269594, 14.930482072592154)});
  whole.axis = Vec3(-1.1056878881008791, -0.5460374360907722, -0.3955944754292397);
  whole.degrees = 19.27652608839128;
  whole.place = Vec3(12.998356876669137, -37.17047428116749, -1.8453245289256324);
  whole.scale = 2.3583436739929136;
  EXPECT_TRUE(isKept(whole, 0.013951248759856823));
}

TEST(ImplicitSurface, ReportsItsCellsAndItsErrorAsTheyArePlaced) {
  const auto surface = test::surfaceOf(test::torus(3, 1), 0.01);
  const auto placed = surface->placed(0.005 * Mat3::Identity(), Vec3::Zero());
  const auto& small = dynamic_cast<const ImplicitSurface&>(*placed);
  EXPECT_NEAR(small.steps()[0], 0.005 * surface->steps()[0], 1e-12);
  EXPECT_NEAR(small.steps()[1], 0.005 * surface->steps()[1], 1e-12);
  EXPECT_NEAR(small.error_m(), 0.005 * surface->error_m(), 1e-12);
}

TEST(ImplicitSurface, RefusesWhatItCannotKeep) {
  const auto refusal = [](const Expression& expression, double error_m, std::optional<Box> bounds = {}) -> std::string {
    try {
      test::surfaceOf(expression, error_m, bounds);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(
      refusal(test::sphere(1e4), 1e-9)
          .find(", in its own lengths before transform and units, its surface is too sharp, too thin or too large "
                "for an error of 1e-09: "),
      std::string::npos);
  EXPECT_NE(refusal(test::gyroid(1, 0), 1e-3).find("it has no end"), std::string::npos);
  EXPECT_EQ(refusal(test::sphere(1), 0), "error must be from 1e-9 to 1");
  EXPECT_EQ(refusal(test::sphere(1), NAN), "error must be from 1e-9 to 1");
  EXPECT_EQ(refusal(test::sphere(1, Vec3(5, 0, 0)), 1e-3, test::cube(1)), "there is no surface within its bounds");
  EXPECT_NE(refusal(test::sphere(1), 1e-3, Box{Vec3::Ones(), Vec3::Zero()}).find("bounds must be a box"),
            std::string::npos);
  // Two spheres blended until they just touch: their surface has a point there.
  EXPECT_NE(
      refusal(test::of(K::kUnion, {test::sphere(1, Vec3(-1.25, 0, 0)), test::sphere(1, Vec3(1.25, 0, 0))}, 1), 1e-3)
          .find("near ("),
      std::string::npos);
}

TEST(ImplicitSurface, KnowsWhereMatterIs) {
  const auto surface = test::surfaceOf(test::of(K::kDifference, {test::sphere(0.02), test::sphere(0.01)}));
  EXPECT_EQ(surface->siteOf(Vec3(0.015, 0, 0)), Site::kMatter);
  EXPECT_EQ(surface->siteOf(Vec3(0.005, 0, 0)), Site::kOpen);
  EXPECT_EQ(surface->siteOf(Vec3(0.0201, 0, 0)), Site::kOpen);
  EXPECT_EQ(surface->siteOf(Vec3(0.02, 0, 0)), Site::kBoundary);
  EXPECT_EQ(surface->siteOf(Vec3(1, 0, 0)), Site::kOpen);
}

/// The finger pulled from `outside` to `inside`; where the proxy comes to rest.
Vec3 restOf(const Snapshot& scene, double radius, const Vec3& outside, const Vec3& inside) {
  ProxySettings settings;
  settings.radius = radius;
  ProxyState state = startProxy(scene, settings, outside);
  for (int i = 0; i < 60; ++i) tick(state, scene, settings, inside);
  return state.position;
}

TEST(ImplicitTouch, ATorusIsRoundAllAround) {
  const auto torus = test::surfaceOf(test::torus(0.03, 0.01));
  const auto scene = sceneOf(torus);
  for (int i = 0; i < 72; ++i) {
    const double around = 0.3 + i * M_PI / 9, tube = 0.1 + i * M_PI / 36;
    const Vec3 out(std::cos(around), std::sin(around), 0), ring = 0.03 * out;
    const Vec3 away = std::cos(tube) * out + std::sin(tube) * Vec3::UnitZ();
    const Vec3 rest = restOf(*scene, 1e-3, ring + 0.013 * away, ring + 0.009 * away);
    const double from_tube = (rest - 0.03 * Vec3(rest.x(), rest.y(), 0).normalized()).norm();
    EXPECT_NEAR(from_tube, 0.011, torus->error_m()) << i;
  }
  const Vec3 inner = restOf(*scene, 1e-3, Vec3(0.01, 0, 0), Vec3(0.03, 0, 0));
  EXPECT_NEAR(inner.norm(), 0.019, torus->error_m()) << "on the inner equator";
}

TEST(ImplicitTouch, TwoSpheresAreNeverMerged) {
  const auto pair = test::surfaceOf(
      test::of(K::kUnion, {test::sphere(0.01, Vec3(-0.01005, 0, 0)), test::sphere(0.01, Vec3(0.01005, 0, 0))}), 1e-6);
  EXPECT_GT(pair->steps()[0], 5e-5) << "cells are about as wide as the gap";
  const auto scene = sceneOf(pair);
  const Vec3 above(0, 0.012, 0), below(0, -0.012, 0);
  EXPECT_LT((restOf(*scene, 0.04e-3, above, below) - below).norm(), 1e-9) << "0.08 mm through 0.1 mm";
  const auto index = pair->makeIndex();
  const auto impact = [&](double radius, FirstImpact& out) {
    Primitive last;
    const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(*pair, id); };
    return firstImpact(*index, read, above, below - above, radius, 0, out);
  };
  FirstImpact out;
  EXPECT_FALSE(impact(0.0495e-3, out));
  ASSERT_TRUE(impact(0.06e-3, out)) << "0.12 mm through 0.1 mm";
  const double y = std::sqrt(0.01006 * 0.01006 - 0.01005 * 0.01005);  // where 0.12 mm are between them
  EXPECT_NEAR((above + out.impact.t * (below - above)).y(), y, 2e-6 * 0.01006 / y);
}

// A block that a cylinder cuts: the ball on the sharp edge between them.
TEST(ImplicitTouch, AnEdgeIsWithinTheError) {
  const auto cut = test::surfaceOf(
      test::of(K::kIntersection, {test::halfSpace(Vec3::UnitZ()), test::rod(K::kCylinder, 0.01, 0.04)}));
  const auto scene = sceneOf(cut);
  for (int i = 0; i < 20; ++i) {
    const Vec3 out(std::cos(0.3 * i + 0.05), std::sin(0.3 * i + 0.05), 0);
    const Vec3 edge = 0.01 * out, away = (out + Vec3::UnitZ()).normalized();
    const Vec3 rest = restOf(*scene, 1e-3, edge + 0.002 * away, edge + 0.0002 * away);
    EXPECT_NEAR((rest - 0.01 * Vec3(rest.x(), rest.y(), 0).normalized()).norm(), 1e-3, 2 * cut->error_m()) << i;
  }
}

/// The way of a ball toward a surface, against its way on the function itself.
struct WayError {
  double early = 0, late = 0;  // largest, m along the normal
  int hits = 0;
};

// Where the distance of a point from a solid of exact distances is the radius, by bisection.
WayError sweepsAgainst(const Expression& expression, double error_m, int sweeps) {
  const auto surface = test::surfaceOf(expression, error_m);
  const ImplicitFunction function(expression);
  const auto index = surface->makeIndex();
  const auto read = [&](ElementId id) { return primitiveOf(*surface, id); };
  test::Random random(9);
  WayError worst;
  for (int i = 0; i < sweeps; ++i) {
    const double radius = std::pow(10.0, random.uniform(-4, -2.5));
    const Vec3 from = random.inCube(0.05), motion = random.inCube(0.05);
    if (function.at(from) < radius + 1e-4) continue;
    double begin = 0, end = 1;
    for (double t = 0; t < 1 && end == 1;) {  // by steps that cannot pass the surface
      const double gap = function.at(from + t * motion) - radius;
      if (gap < 1e-9) end = t;
      t += std::max(gap, 1e-7) / motion.norm();
      if (end == 1) begin = std::min(t, 1.0);
    }
    Primitive last;
    FirstImpact out;
    const auto keep = [&](ElementId id) -> const Primitive& { return last = read(id); };
    const bool hit = firstImpact(*index, keep, from, motion, radius, 0, out);
    const double at = hit ? out.impact.t : 1;
    const double gap = function.at(from + at * motion) - radius;  // of the ball that has stopped
    worst.hits += hit ? 1 : 0;
    worst.late = std::max(worst.late, -gap);
    if (hit) worst.early = std::max(worst.early, gap);
    if (!hit && end < 1) worst.late = std::max(worst.late, begin >= 1 ? 0 : -gap);
  }
  return worst;
}

// The distance function of a torus is exact outside, so a ball may go until its value is the radius.
TEST(ImplicitTouch, SweepsEndWhereTheFunctionSays) {
  const double error_m = 1e-6;
  const WayError torus = sweepsAgainst(test::torus(0.03, 0.01), error_m, 3000 * test::longer());
  EXPECT_GT(torus.hits, 300);
  EXPECT_LE(torus.late, error_m);
  EXPECT_LE(torus.early, error_m);
}

TEST(ImplicitTouch, TicksAllocateNothing) {
  const auto scene = sceneOf(test::surfaceOf(test::of(
      K::kUnion,
      {test::of(K::kDifference, {test::box(Vec3(0.03, 0.03, 0.03)), test::sphere(0.018)}), test::torus(0.02, 0.004)})));
  ProxySettings settings;
  settings.radius = 1e-3;
  settings.surfaces.smooth = true;
  test::Random random(3);
  Vec3 finger(0, 0.05, 0);
  ProxyState state = startProxy(*scene, settings, finger);
  const RealtimeGuard guard;
  int touched = 0;
  for (int i = 0; i < 300; ++i) {
    finger += 4e-4 * random.inCube(1) - 0.01 * (finger - Vec3(0, 0.015, 0));
    touched += tick(state, *scene, settings, finger).contacts.empty() ? 0 : 1;
  }
  EXPECT_GT(touched, 30);
}

}  // namespace
}  // namespace hl::test_implicit_surface
