// Surfaces, cut by planes into pieces: nothing is lost, and the work has an end.
#include "bodies/convex_cuts.h"

#include <gtest/gtest.h>

#include "draws.h"

namespace hl::test_convex_cuts {
namespace {

using namespace test;

CutSurface crossingSheets(Draws& draws, int count) {
  const auto place = [&] { return Vec3(draws.between(-1, 1), draws.between(-1, 1), draws.between(-1, 1)); };
  CutSurface sheets;
  for (int i = 0; i < count; ++i) sheets.push_back({place(), place(), place()});
  return sheets;
}

double areaOf(const CutSurface& surface) {
  double area = 0;
  for (const auto& [a, b, c] : surface) area += (b - a).cross(c - a).norm() / 2;
  return area;
}

struct Sum {
  double area_m2 = 0;
  std::size_t triangles = 0;
};

Sum sumOf(const std::vector<NearPiece>& pieces) {
  Sum sum;
  for (const NearPiece& one : pieces) {
    sum.area_m2 += areaOf(one.piece.surface());
    sum.triangles += one.piece.surface().size();
  }
  return sum;
}

// Each cut of sheets that cross makes more of them: without an end 36 triangles became half a million.
TEST(ConvexCuts, OfSheetsThatCrossAreAsLargeAndNotTooMany) {
  Draws draws(3);
  for (const int count : {5, 30}) {
    for (const bool is_shell : {false, true}) {
      const CutSurface sheets = crossingSheets(draws, count);
      const auto pieces = cutPieces(CutPiece(sheets), {is_shell, 0.02, 64});
      const Sum sum = sumOf(pieces);
      EXPECT_GT(pieces.size(), 4u);
      EXPECT_NEAR(sum.area_m2, areaOf(sheets), 1e-9 * areaOf(sheets)) << count;
      EXPECT_LT(sum.triangles, 10'000u) << count;
    }
  }
}

TEST(ConvexCuts, EndAfterSoManyLooks) {
  Draws draws(4);
  const CutSurface sheets = crossingSheets(draws, 30);
  CutRules rules{false, 0.02, 64};
  const std::size_t all = cutPieces(CutPiece(sheets), rules).size();
  rules.looks_of_each = 3'000;
  const auto some = cutPieces(CutPiece(sheets), rules);
  EXPECT_GT(some.size(), 1u);
  EXPECT_LT(some.size(), all);
  EXPECT_NEAR(sumOf(some).area_m2, areaOf(sheets), 1e-9 * areaOf(sheets));
  rules.looks_of_each = 0;
  EXPECT_EQ(cutPieces(CutPiece(sheets), rules).size(), 1u);
}

// What is known of two pieces is what is known of both together.
TEST(CutPiece, OfTwoIsThatOfTheirTriangles) {
  Draws draws(5);
  for (int i = 0; i < 20; ++i) {
    const CutSurface a = crossingSheets(draws, 7), b = crossingSheets(draws, 4);
    CutSurface all = a;
    all.insert(all.end(), b.begin(), b.end());
    const CutPiece both{CutPiece(a), CutPiece(b)}, whole(all);
    EXPECT_EQ(both.corners(), whole.corners());
    EXPECT_EQ(both.extremes(), whole.extremes());
    EXPECT_EQ(both.bounds().min, whole.bounds().min);
    EXPECT_EQ(both.bounds().max, whole.bounds().max);
    EXPECT_EQ(both.primitives().size(), whole.primitives().size());
    EXPECT_EQ(both.slab().thickness, whole.slab().thickness);
  }
}

}  // namespace
}  // namespace hl::test_convex_cuts
