// hlBegin .. hlEnd and arrays: which primitives come out, and what is an error.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "client/fake_server.h"

namespace hl::client::test_geometry {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// `count` vertices at x = 0, 1, 2 ... with the mode; the primitives that come out.
class PrimitivesOf : public CallsTest {
 protected:
  proto::Primitives drawn(HLenum mode, int count) {
    hlBegin(mode);
    for (int i = 0; i < count; ++i) hlVertex2f(static_cast<HLfloat>(i), static_cast<HLfloat>(i * i));
    hlEnd();
    const proto::Frame frame = flushed();
    return frame.world().items_size() == 1 ? frame.world().items(0).primitives() : proto::Primitives{};
  }
  std::vector<double> triangles(HLenum mode, int count) { return listOf(drawn(mode, count).triangles()); }
  std::vector<double> segments(HLenum mode, int count) { return listOf(drawn(mode, count).segments()); }
  using List = std::vector<double>;
};

TEST_F(PrimitivesOf, Points) { EXPECT_EQ(listOf(drawn(HL_POINTS, 3).points()), (List{0, 1, 2})); }
TEST_F(PrimitivesOf, LinesDropTheLastVertex) { EXPECT_EQ(segments(HL_LINES, 5), (List{0, 1, 2, 3})); }
TEST_F(PrimitivesOf, LineStrip) { EXPECT_EQ(segments(HL_LINE_STRIP, 4), (List{0, 1, 1, 2, 2, 3})); }
TEST_F(PrimitivesOf, LineLoopIsClosed) { EXPECT_EQ(segments(HL_LINE_LOOP, 3), (List{0, 1, 1, 2, 2, 0})); }
TEST_F(PrimitivesOf, LineLoopOfTwoIsOneSegment) { EXPECT_EQ(segments(HL_LINE_LOOP, 2), (List{0, 1})); }
TEST_F(PrimitivesOf, TrianglesDropWhatIsIncomplete) {
  const proto::Primitives drawn = this->drawn(HL_TRIANGLES, 8);
  EXPECT_EQ(listOf(drawn.triangles()), (List{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(drawn.vertices_size(), 18);
}
TEST_F(PrimitivesOf, TriangleStripTurnsEveryOther) {
  EXPECT_EQ(triangles(HL_TRIANGLE_STRIP, 5), (List{0, 1, 2, 2, 1, 3, 2, 3, 4}));
}
TEST_F(PrimitivesOf, TriangleFan) { EXPECT_EQ(triangles(HL_TRIANGLE_FAN, 4), (List{0, 1, 2, 0, 2, 3})); }
TEST_F(PrimitivesOf, Polygon) { EXPECT_EQ(triangles(HL_POLYGON, 5), (List{0, 1, 2, 0, 2, 3, 0, 3, 4})); }
TEST_F(PrimitivesOf, Quads) { EXPECT_EQ(triangles(HL_QUADS, 9), (List{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7})); }
TEST_F(PrimitivesOf, QuadStripGoesRound) {
  EXPECT_EQ(triangles(HL_QUAD_STRIP, 7), (List{0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4}));
}
TEST_F(PrimitivesOf, TooFewVerticesAreNothingAndLeaveTheWorldAlone) {
  constexpr std::array<int, 10> kMin{1, 2, 2, 2, 3, 3, 3, 4, 4, 3};
  for (HLenum mode = HL_POINTS; mode <= HL_POLYGON; ++mode) {
    hlBegin(mode);
    for (int i = 1; i < kMin[mode]; ++i) hlVertex2f(0, 0);
    hlEnd();
  }
  EXPECT_EQ(flushed().number(), 0U);
}

TEST_F(CallsTest, VertexOutsideBeginIsIgnored) {
  hlVertex3f(1, 2, 3);
  hlVertex3d(kNaN, 2, 3);
  EXPECT_EQ(flushed().number(), 0U);
}

TEST_F(CallsTest, BeginInsideBeginIsInvalidOperation) {
  hlBegin(HL_POINTS);
  hlBegin(HL_LINES);
  hlVertex3f(1, 2, 3);
  hlEnd();
  EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
  EXPECT_EQ(flushed().world().items(0).primitives().points_size(), 1);
}

TEST_F(CallsTest, EndWithoutBeginIsInvalidOperation) {
  hlEnd();
  EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
}

TEST_F(CallsTest, UnknownModeIsInvalidEnumAndBeginsNothing) {
  hlBegin(HL_POLYGON + 1);
  EXPECT_EQ(hlGetError(), HL_INVALID_ENUM);
  hlEnd();
  EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
}

TEST_F(CallsTest, VertexThatIsNotFiniteIsInvalidValueAndDropped) {
  hlBegin(HL_POINTS);
  hlVertex3d(1, 2, 3);
  hlVertex3d(kNaN, 2, 3);
  hlVertex3f(0, std::numeric_limits<float>::infinity(), 0);
  hlVertex3d(1e308, 1e308, 1e308);
  hlEnd();
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  EXPECT_EQ(listOf(flushed().world().items(0).primitives().vertices()),
            (std::vector<double>{1, 2, 3, 1e308, 1e308, 1e308}));
}

TEST_F(CallsTest, NullPointerIsInvalidValue) {
  hlVertex3fv(nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  hlNormal3dv(nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  hlTexCoord2fv(nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  hlLoadMatrixd(nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  hlGetDoublev(HL_FORCE, nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  hlGenObjects(1, nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  hlDeleteTextures(2, nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  hlGetContacts(1, nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
}

TEST_F(CallsTest, EveryFormOfVertexGivesTheSameBits) {
  const HLfloat f[] = {0.1F, -2.5F, 3.7F};
  const HLdouble d[] = {double{f[0]}, double{f[1]}, double{f[2]}};
  hlBegin(HL_POINTS);
  hlVertex2f(f[0], f[1]);
  hlVertex2d(d[0], d[1]);
  hlVertex2fv(f);
  hlVertex2dv(d);
  hlVertex3f(f[0], f[1], f[2]);
  hlVertex3d(d[0], d[1], d[2]);
  hlVertex3fv(f);
  hlVertex3dv(d);
  hlEnd();
  std::vector<double> expected;
  for (int i = 0; i < 4; ++i) expected.insert(expected.end(), {d[0], d[1], 0});
  for (int i = 0; i < 4; ++i) expected.insert(expected.end(), d, d + 3);
  EXPECT_EQ(listOf(flushed().world().items(0).primitives().vertices()), expected);
}

TEST_F(CallsTest, VerticesTakeTheCurrentNormalAndHaveNoneBeforeTheFirst) {
  hlBegin(HL_POINTS);
  hlVertex2f(0, 0);
  hlNormal3f(0, 0, 2);
  hlVertex2f(1, 0);
  const HLdouble other[] = {1, 0, 0};
  hlNormal3dv(other);
  hlVertex2f(2, 0);
  hlEnd();
  EXPECT_EQ(listOf(flushed().world().items(0).primitives().normals()),
            (std::vector<double>{0, 0, 0, 0, 0, 2, 1, 0, 0}));
  // As in GL it stays current, until 0 0 0 takes it away.
  triangle();
  EXPECT_EQ(flushed().world().items(0).primitives().normals_size(), 9);
  hlNormal3f(0, 0, 0);
  triangle();
  EXPECT_EQ(flushed().world().items(0).primitives().normals_size(), 0);
}

TEST_F(CallsTest, TextureCoordinatesAreTurnedByTheTextureMatrix) {
  hlMatrixMode(HL_TEXTURE);
  hlTranslatef(0.5F, 0.25F, 0);
  hlScalef(2, 4, 1);
  hlBegin(HL_POINTS);
  hlVertex2f(0, 0);
  hlTexCoord2d(1, 1);
  hlVertex2f(1, 0);
  hlEnd();
  EXPECT_EQ(listOf(flushed().world().items(0).primitives().texcoords()), (std::vector<double>{0.5, 0.25, 2.5, 4.25}));
}

TEST_F(CallsTest, CurrentNormalAndCoordinatesMustBeFinite) {
  hlNormal3f(1, 0, 0);
  hlNormal3d(kNaN, 0, 0);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  hlTexCoord2d(3, 4);
  hlTexCoord2d(0, kNaN);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  EXPECT_EQ(number(HL_CURRENT_NORMAL), 1);
  EXPECT_EQ(number(HL_CURRENT_TEXTURE_COORDS), 3);
}

TEST_F(CallsTest, NeighboursOfOneKindMergeIntoOneItem) {
  triangle(0);
  triangle(1);
  hlMateriald(HL_STIFFNESS, 0.5);
  triangle(2);
  hlTranslated(1, 0, 0);
  triangle(3);
  hlLoadName(4);
  triangle(4);
  hlNormal3d(0, 0, 1);
  triangle(5);
  hlBegin(HL_LINES);
  hlVertex2f(0, 0);
  hlVertex2f(1, 0);
  hlEnd();
  const proto::World world = flushed().world();
  ASSERT_EQ(world.items_size(), 5);
  EXPECT_EQ(listOf(world.items(0).primitives().triangles()), (std::vector<double>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(listOf(world.items(4).primitives().segments()), (std::vector<double>{3, 4}));
  EXPECT_EQ(world.items(3).name(), 4U);
  EXPECT_FALSE(world.items(2).has_name());
}

// ---- Arrays ----

// Seven vertices with normals and texture coordinates, as an application has them.
struct Cloud {
  std::vector<HLfloat> vertices, normals, texcoords;
  Cloud() {
    for (int i = 0; i < 7; ++i) {
      const auto f = static_cast<HLfloat>(i);
      vertices.insert(vertices.end(), {std::sin(f), std::cos(f), f / 3});
      normals.insert(normals.end(), {f / 7, 1 - f / 7, 0.3F});
      texcoords.insert(texcoords.end(), {f / 5, f / 11});
    }
  }
  void point() const {
    hlVertexPointer(3, HL_FLOAT, 0, vertices.data());
    hlNormalPointer(HL_FLOAT, 0, normals.data());
    hlTexCoordPointer(2, HL_FLOAT, 0, texcoords.data());
    for (const HLenum array : {HL_VERTEX_ARRAY, HL_NORMAL_ARRAY, HL_TEXTURE_COORD_ARRAY}) hlEnableClientState(array);
  }
  void vertex(std::size_t i) const {
    hlNormal3fv(&normals[3 * i]);
    hlTexCoord2fv(&texcoords[2 * i]);
    hlVertex3fv(&vertices[3 * i]);
  }
};

class Arrays : public CallsTest {
 protected:
  const Cloud cloud;
  const std::vector<HLushort> indices{6, 0, 3, 3, 1, 5, 2};
};

// The same matrix and surface for all ways of drawing.
void setSurroundings() {
  hlRotated(30, 1, 2, 3);
  hlMateriald(HL_STATIC_FRICTION, 0.7);
}

TEST_F(Arrays, DrawArraysAndElementsAreImmediateCallsToTheBit) {
  setSurroundings();
  for (HLenum mode = HL_POINTS; mode <= HL_POLYGON; ++mode) {
    hlBegin(mode);
    for (std::size_t i = 1; i < 7; ++i) cloud.vertex(i);
    hlEnd();
    hlNormal3f(0, 0, 0);
    const std::string immediate = flushed().world().SerializeAsString();
    cloud.point();
    hlDrawArrays(mode, 1, 6);
    EXPECT_EQ(flushed().world().SerializeAsString(), immediate);
    const std::vector<HLubyte> bytes{1, 2, 3, 4, 5, 6};
    hlDrawElements(mode, 6, HL_UNSIGNED_BYTE, bytes.data());
    EXPECT_EQ(flushed().world().SerializeAsString(), immediate);
  }
}

TEST_F(Arrays, ObjectsHoldTheSameItemsAsTheWorld) {
  const auto draw = [this] {
    setSurroundings();
    cloud.point();
    hlDrawElements(HL_TRIANGLE_STRIP, 7, HL_UNSIGNED_SHORT, indices.data());
    hlBegin(HL_QUADS);
    for (std::size_t i = 0; i < 4; ++i) cloud.vertex(i);
    hlEnd();
  };
  hlNewObject(1);
  draw();
  hlEndObject();
  draw();
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.objects_size(), 1);
  ASSERT_EQ(frame.objects(0).items_size(), frame.world().items_size());
  for (int i = 0; i < frame.world().items_size(); ++i)
    EXPECT_EQ(frame.objects(0).items(i).SerializeAsString(), frame.world().items(i).SerializeAsString());
}

TEST_F(Arrays, StridesMayBeOddAndNumbersDouble) {
  struct __attribute__((packed)) Vertex {
    char tag;
    HLdouble position[3];
  };
  const Vertex vertices[] = {{'a', {1, 2, 3}}, {'b', {4, 5, 6}}};
  hlVertexPointer(3, HL_DOUBLE, sizeof(Vertex), reinterpret_cast<const char*>(vertices) + 1);
  hlEnableClientState(HL_VERTEX_ARRAY);
  hlDrawArrays(HL_POINTS, 0, 2);
  EXPECT_EQ(listOf(flushed().world().items(0).primitives().vertices()), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST_F(Arrays, TwoNumbersLieInThePlane) {
  const HLfloat vertices[] = {1, 2, 3, 4};
  hlVertexPointer(2, HL_FLOAT, 0, vertices);
  hlEnableClientState(HL_VERTEX_ARRAY);
  hlDrawArrays(HL_LINES, 0, 2);
  EXPECT_EQ(listOf(flushed().world().items(0).primitives().vertices()), (std::vector<double>{1, 2, 0, 3, 4, 0}));
}

TEST_F(Arrays, WithoutTheVertexArrayNothingIsDrawn) {
  hlDrawArrays(HL_TRIANGLES, 0, 3);
  hlDrawElements(HL_TRIANGLES, 3, HL_UNSIGNED_SHORT, indices.data());
  EXPECT_EQ(flushed().number(), 0U);
}

TEST_F(Arrays, CurrentNormalHoldsWhereThereIsNoArrayAndStays) {
  cloud.point();
  hlDisableClientState(HL_NORMAL_ARRAY);
  hlNormal3f(0, 1, 0);
  hlDrawArrays(HL_POINTS, 0, 2);
  EXPECT_EQ(listOf(flushed().world().items(0).primitives().normals()), (std::vector<double>{0, 1, 0, 0, 1, 0}));
  hlEnableClientState(HL_NORMAL_ARRAY);
  hlDrawArrays(HL_POINTS, 0, 2);
  HLdouble normal[3];
  hlGetDoublev(HL_CURRENT_NORMAL, normal);
  EXPECT_EQ(normal[1], 1);
}

TEST_F(Arrays, NaNInAnArrayIsInvalidValueAndDrawsNothing) {
  const HLdouble vertices[] = {0, 0, 0, kNaN, 0, 0};
  hlVertexPointer(3, HL_DOUBLE, 0, vertices);
  hlEnableClientState(HL_VERTEX_ARRAY);
  hlDrawArrays(HL_POINTS, 0, 2);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  EXPECT_EQ(flushed().number(), 0U);
}

TEST_F(Arrays, MisuseIsAnError) {
  const auto expect = [](HLenum error) { EXPECT_EQ(hlGetError(), error); };
  hlVertexPointer(4, HL_FLOAT, 0, nullptr), expect(HL_INVALID_VALUE);
  hlVertexPointer(3, HL_UNSIGNED_INT, 0, nullptr), expect(HL_INVALID_ENUM);
  hlVertexPointer(3, HL_FLOAT, -1, nullptr), expect(HL_INVALID_VALUE);
  hlNormalPointer(HL_UNSIGNED_BYTE, 0, nullptr), expect(HL_INVALID_ENUM);
  hlTexCoordPointer(3, HL_FLOAT, 0, nullptr), expect(HL_INVALID_VALUE);
  hlEnableClientState(HL_TEXTURE_2D), expect(HL_INVALID_ENUM);
  hlDisableClientState(0), expect(HL_INVALID_ENUM);
  hlDrawArrays(99, 0, 3), expect(HL_INVALID_ENUM);
  hlDrawArrays(HL_POINTS, -1, 3), expect(HL_INVALID_VALUE);
  hlDrawArrays(HL_POINTS, 0, -3), expect(HL_INVALID_VALUE);
  hlDrawElements(HL_POINTS, 1, HL_FLOAT, indices.data()), expect(HL_INVALID_ENUM);
  hlDrawElements(HL_POINTS, -1, HL_UNSIGNED_SHORT, indices.data()), expect(HL_INVALID_VALUE);
  hlDrawElements(HL_POINTS, 1, HL_UNSIGNED_SHORT, nullptr), expect(HL_INVALID_VALUE);
  hlEnableClientState(HL_VERTEX_ARRAY);
  hlDrawArrays(HL_POINTS, 0, 3), expect(HL_INVALID_OPERATION);
  EXPECT_EQ(flushed().number(), 0U);
}

TEST_F(Arrays, DrawingIsNotAllowedBetweenBeginAndEnd) {
  cloud.point();
  hlBegin(HL_POINTS);
  hlDrawArrays(HL_POINTS, 0, 2);
  hlEnd();
  EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
  EXPECT_EQ(flushed().number(), 0U);
}

}  // namespace
}  // namespace hl::client::test_geometry
