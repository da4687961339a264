// Height fields: their triangles, normals and gaps.
#include "surfaces/height_field.h"

#include <gtest/gtest.h>

#include <map>

#include "base/error.h"
#include "cases.h"
#include "fields.h"

namespace hl::test_height_field {
namespace {

using test::Random;

TEST(HeightField, EveryInnerEdgeBelongsToTwoTrianglesBitByBit) {
  Random random(1);
  std::size_t triangles = 0;
  while (triangles < 100'000) {
    const auto field = test::randomField(random);
    std::map<std::array<double, 6>, int> edges;
    for (ElementId id = 0; id < field->count(); ++id) {
      const HeightCell cell = cellOf(id, field->grid().columns());
      ASSERT_EQ(idOf(cell, field->grid().columns()), id);
      if (!field->grid().hasCell(cell.column, cell.row)) continue;
      ++triangles;
      const Primitive triangle = primitiveOf(*field, id);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &a = triangle.vertex[(k + 1) % 3], &b = triangle.vertex[(k + 2) % 3];
        const bool ordered = std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
        const Vec3 &low = ordered ? a : b, &high = ordered ? b : a;
        ++edges[{low.x(), low.y(), low.z(), high.x(), high.y(), high.z()}];
      }
    }
    const std::uint32_t columns = field->grid().columns() - 1, rows = field->grid().rows() - 1;
    std::size_t inner = 0;
    const auto has = [&](std::uint32_t i, std::uint32_t j) {
      return i < columns && j < rows && field->grid().hasCell(i, j);
    };
    for (std::uint32_t j = 0; j < rows; ++j) {
      for (std::uint32_t i = 0; i < columns; ++i) {
        if (has(i, j)) inner += 1U + (has(i + 1, j) ? 1U : 0U) + (has(i, j + 1) ? 1U : 0U);
      }
    }
    std::size_t shared = 0;
    for (const auto& [edge, uses] : edges) {
      ASSERT_LE(uses, 2);
      shared += uses == 2 ? 1U : 0U;
    }
    ASSERT_EQ(shared, inner);
  }
}

TEST(HeightField, TrianglesAreValidAndFaceUp) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const auto field = test::randomField(random);
    for (ElementId id = 0; id < field->count(); ++id) {
      const HeightCell cell = cellOf(id, field->grid().columns());
      if (!field->grid().hasCell(cell.column, cell.row)) continue;
      const auto corner = field->corners(id);
      ASSERT_TRUE(isTriangle(corner[0], corner[1], corner[2]));
      const Primitive triangle = primitiveOf(*field, id);
      ASSERT_GT(triangle.normal.dot(field->frame().axes.col(2)), 0);
      const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3;
      ASSERT_GT(field->trueNormal(id, middle).dot(field->frame().axes.col(2)), 0);
      for (const Vec3& point : corner) {
        const Box box = field->bounds();
        const double room = 1e-12 * box.size().norm();
        ASSERT_TRUE((point.array() >= box.min.array() - room).all() && (point.array() <= box.max.array() + room).all());
      }
    }
  }
}

// Central differences are exact for a quadratic; between samples the normals are interpolated.
// The judge looks for the triangle above or below the point, along the axis of the heights, among all.
TEST(HeightField, MatterIsBelowItsTriangles) {
  test::Random random(11);
  int below = 0, open = 0;
  for (int i = 0; i < 40 * test::cases(5); ++i) {
    const auto field = test::randomField(random);
    const HeightGrid& grid = field->grid();
    const Vec3 up = field->frame().axes.col(2);
    for (int k = 0; k < 10; ++k) {
      const double column = random.uniform(-0.2, grid.columns() - 0.8), row = random.uniform(-0.2, grid.rows() - 0.8);
      const double height = random.uniform(field->pyramid().lowest(), field->pyramid().highest());
      const Vec3 point = field->frame().point(column, row, height);
      Site expected = Site::kOpen;
      bool sure = true;
      for (ElementId id = 0; id < field->count(); ++id) {
        const ElementId cell = id / 2;
        const auto across = static_cast<std::uint32_t>(cell % (grid.columns() - 1));
        const auto along = static_cast<std::uint32_t>(cell / (grid.columns() - 1));
        if (!grid.hasCell(across, along)) continue;
        const auto corner = field->corners(id);
        Mat3 axes;
        axes << corner[1] - corner[0], corner[2] - corner[0], up;
        const Vec3 at = axes.inverse() * (point - corner[0]);
        constexpr double kNear = 1e-7;  // to an edge or the triangle: rounding decides
        if (at.x() < -kNear || at.y() < -kNear || at.x() + at.y() > 1 + kNear) continue;
        expected = at.z() < 0 ? Site::kMatter : Site::kOpen;
        const double range = field->pyramid().highest() - field->pyramid().lowest();
        sure = std::min({std::abs(at.x()), std::abs(at.y()), std::abs(1 - at.x() - at.y())}) > kNear &&
               std::abs(at.z()) > kNear * range;
        if (sure) break;
      }
      if (!sure) continue;
      ASSERT_EQ(field->siteOf(point), expected) << i << " " << k;
      ++(expected == Site::kMatter ? below : open);
    }
  }
  EXPECT_GT(below, 100);
  EXPECT_GT(open, 100);
}

TEST(HeightField, NormalsAreThoseOfTheSurfaceThatWasSampled) {
  const double h = 1e-3, c = 4;
  const auto field =
      test::fieldOf(40, 40, h, [&](double i, double j) { return c * h * h * (i * i + 0.5 * j * j) / 2; });
  for (std::uint32_t j = 1; j + 2 < 40; ++j) {
    for (std::uint32_t i = 1; i + 2 < 40; ++i) {
      for (const unsigned half : {0U, 1U}) {
        const ElementId id = idOf({i, j, half}, 40);
        for (const Vec3& at : field->corners(id)) {
          const Vec3 normal = Vec3(-c * at.x(), 1, -0.5 * c * at.z()).normalized();
          ASSERT_LT((field->trueNormal(id, at) - normal).norm(), 1e-5);
        }
        const auto corner = field->corners(id);
        const Vec3 at = 0.2 * corner[0] + 0.5 * corner[1] + 0.3 * corner[2];
        ASSERT_LT((field->trueNormal(id, at) - Vec3(-c * at.x(), 1, -0.5 * c * at.z()).normalized()).norm(), 1e-5);
      }
    }
  }
}

TEST(HeightField, APlaceOfTheFieldSharesItsSamples) {
  Random random(5);
  const auto field = test::randomField(random);
  const auto copy = std::dynamic_pointer_cast<const HeightField>(field->placed(2 * Mat3::Identity(), Vec3(1, 2, 3)));
  ASSERT_TRUE(copy);
  EXPECT_EQ(&copy->grid(), &field->grid());
  EXPECT_EQ(&copy->pyramid(), &field->pyramid());
  const auto a = field->corners(0), b = copy->corners(0);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!a[k].allFinite()) continue;
    EXPECT_LT((2 * a[k] + Vec3(1, 2, 3) - b[k]).norm(), 1e-12 * b[k].norm());
  }
}

TEST(HeightField, WhatIsDrawnHasAtMostSoManyTrianglesAndTheSameRim) {
  const auto field = test::fieldOf(100, 61, 1, [](double i, double j) { return 0.01 * i * j; });
  for (const std::size_t most : {2U, 10U, 500U, 5000U, 100'000U}) {
    const DrawnMesh drawn = field->drawn(most);
    EXPECT_LE(drawn.triangles.size(), most);
    EXPECT_EQ(drawn.positions.size(), drawn.normals.size());
    Box box;
    for (const Vec3& p : drawn.positions) box.extend(p);
    EXPECT_EQ(box.max.x(), 99);
    EXPECT_EQ(box.max.z(), 60);
  }
  EXPECT_EQ(field->drawn(100'000).triangles.size(), field->count());
}

TEST(HeightField, WhatCannotBeAFieldIsRefused) {
  EXPECT_THROW(test::gridOf<float>(1, 5, std::vector<float>(5)), Error);
  const auto grid = test::gridOf<float>(2, 2, {0, 1, 2, 3});
  for (const double bad : {0.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    EXPECT_THROW(HeightField(grid, test::uprightFrame(1, bad)), Error) << bad;
    EXPECT_THROW(HeightField(grid, test::uprightFrame(bad, 1)), Error) << bad;
  }
  EXPECT_THROW(HeightField(grid, test::uprightFrame(1, 1e10)), Error);
  const HeightField steep(grid, test::uprightFrame(1e-7, 1));
  EXPECT_THROW(steep.makeIndex(), Error);
  EXPECT_NO_THROW(steep.placed(Vec3(1, 1e-6, 1).asDiagonal(), Vec3::Zero())->makeIndex());
  EXPECT_THROW(HeightField(test::gridOf<float>(2, 2, {0, 1, 2, 3e30F}), test::uprightFrame(1, 1)), Error);
}

TEST(HeightField, AFieldOfGapsHasNoTriangles) {
  const HeightField field(test::gridOf<float>(20, 20, std::vector<float>(400, NAN)), test::uprightFrame(1, 1));
  EXPECT_EQ(field.triangles(), 0U);
  int visited = 0;
  const auto index = field.makeIndex();
  index->overlap(Vec3(5, 0, 5), 100, [&](ElementId) { ++visited; });
  index->nearest(Vec3(5, 0, 5), INFINITY, [&](ElementId, double limit) { return ++visited, limit; });
  EXPECT_EQ(visited, 0);
}

}  // namespace
}  // namespace hl::test_height_field
