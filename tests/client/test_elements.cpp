// hlDrawElements: the primitives of immediate calls, with each vertex kept once.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <vector>

#include "client/fake_server.h"

namespace hl::client::test_elements {
namespace {

class Elements : public CallsTest {
 protected:
  static constexpr std::size_t kVertices = 70'000;  // more than 16 bits count

  Elements() {
    for (std::size_t i = 0; i < kVertices; ++i) {
      const auto x = static_cast<double>(i);
      vertices_.insert(vertices_.end(), {x, x * x, -x});
      normals_.insert(normals_.end(), {x, 1, 0});
    }
  }
  void point() {
    hlVertexPointer(3, HL_DOUBLE, 0, vertices_.data());
    hlNormalPointer(HL_DOUBLE, 0, normals_.data());
    hlEnableClientState(HL_VERTEX_ARRAY);
    hlEnableClientState(HL_NORMAL_ARRAY);
  }
  proto::Frame immediate(HLenum mode, const std::vector<HLuint>& indices) {
    hlBegin(mode);
    for (const HLuint i : indices) {
      hlNormal3dv(&normals_[3 * i]);
      hlVertex3dv(&vertices_[3 * i]);
    }
    hlEnd();
    return flushed();
  }
  proto::Frame elements(HLenum mode, const std::vector<HLuint>& indices) {
    hlDrawElements(mode, static_cast<HLsizei>(indices.size()), HL_UNSIGNED_INT, indices.data());
    return flushed();
  }

 private:
  std::vector<double> vertices_, normals_;
};

// Of primitives, one after the other: what each corner is, by its coordinates and normal.
std::vector<double> corners(const proto::Primitives& primitives) {
  std::vector<double> all;
  const auto add = [&](const auto& indices) {
    all.push_back(-1);
    for (const std::uint32_t index : indices) {
      for (int axis = 0; axis < 3; ++axis) {
        all.push_back(primitives.vertices(static_cast<int>(3 * index) + axis));
        all.push_back(primitives.normals(static_cast<int>(3 * index) + axis));
      }
    }
  };
  add(primitives.triangles());
  add(primitives.segments());
  add(primitives.points());
  return all;
}

std::vector<HLuint> randomIndices(std::mt19937& random) {
  const std::array<std::size_t, 3> ranges{5, 40, 70'000};  // many twice, some, far apart
  std::uniform_int_distribution<HLuint> index(0, static_cast<HLuint>(ranges[random() % 3] - 1));
  std::vector<HLuint> indices(random() % 40);
  for (HLuint& i : indices) i = index(random);
  return indices;
}

TEST_F(Elements, AreThePrimitivesOfImmediateCallsWithEachVertexOnce) {
  point();
  std::mt19937 random(7);
  int drawn = 0;
  for (int round = 0; round < 300; ++round) {
    const HLenum mode = HL_POINTS + random() % (HL_POLYGON + 1);
    const std::vector<HLuint> indices = randomIndices(random);
    const proto::Frame expected = immediate(mode, indices), found = elements(mode, indices);
    ASSERT_EQ(found.world().items_size(), expected.world().items_size()) << "mode " << mode;
    if (expected.world().items_size() == 0) continue;
    ++drawn;
    const proto::Primitives &one = expected.world().items(0).primitives(), &other = found.world().items(0).primitives();
    ASSERT_EQ(corners(other), corners(one)) << "mode " << mode;
    const std::size_t whole = static_cast<std::size_t>(one.vertices_size()) / 3;
    const std::set<HLuint> once(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(whole));
    ASSERT_EQ(static_cast<std::size_t>(other.vertices_size()), 3 * once.size());
    ASSERT_EQ(other.normals_size(), other.vertices_size());
  }
  EXPECT_GT(drawn, 200);
}

TEST_F(Elements, OfAllVerticesKeepTheirNumbersAndAreMovedByThem) {
  point();
  const std::vector<HLuint> quad{0, 1, 2, 2, 1, 3};
  hlNewObject(1);
  hlDrawElements(HL_TRIANGLES, 6, HL_UNSIGNED_INT, quad.data());
  hlDrawElements(HL_TRIANGLES, 3, HL_UNSIGNED_INT, quad.data() + 3);  // 1, 2, 3 again: vertices 4, 5, 6
  hlEndObject();
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.objects(0).items_size(), 1);
  const proto::Primitives& primitives = frame.objects(0).items(0).primitives();
  EXPECT_EQ(listOf(primitives.triangles()), (std::vector<double>{0, 1, 2, 2, 1, 3, 5, 4, 6}));
  EXPECT_EQ(primitives.vertices_size(), 3 * 7);
  const std::array<double, 6> moved{1, 2, 3, 4, 5, 6};
  hlUpdateVertices(1, 3, 2, moved.data(), nullptr);
  const proto::Frame update = flushed();
  ASSERT_EQ(update.moved_size(), 1);
  EXPECT_EQ(update.moved(0).first(), 3U);
  hlUpdateVertices(1, 6, 2, moved.data(), nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE) << "there are seven";
}

TEST_F(Elements, ThatFillNoPrimitiveKeepNoVertices) {
  point();
  const std::vector<HLuint> indices{4, 5, 6, 7};
  hlDrawElements(HL_TRIANGLES, 4, HL_UNSIGNED_INT, indices.data());
  EXPECT_EQ(flushed().world().items(0).primitives().vertices_size(), 9);
  hlDrawElements(HL_TRIANGLES, 2, HL_UNSIGNED_INT, indices.data());
  hlDrawElements(HL_QUADS, 0, HL_UNSIGNED_INT, nullptr);
  EXPECT_EQ(hlGetError(), HL_NO_ERROR);
  EXPECT_EQ(flushed().number(), 0U);
}

}  // namespace
}  // namespace hl::client::test_elements
