// Objects and textures: definitions, calls, deletion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "client/fake_server.h"

namespace hl::client::test_objects {
namespace {

void expectError(HLenum error) { EXPECT_EQ(hlGetError(), error); }

void define(HLuint object, HLuint calls = 0) {
  hlNewObject(object);
  triangle();
  if (calls != 0) hlCallObject(calls);
  hlEndObject();
}

TEST_F(CallsTest, GeneratedNumbersAreNew) {
  define(3);
  HLuint objects[2];
  hlGenObjects(2, objects);
  EXPECT_GT(objects[0], 3U);
  EXPECT_NE(objects[0], objects[1]);
  EXPECT_EQ(hlIsObject(objects[0]), HL_FALSE);
  hlGenObjects(-1, objects), expectError(HL_INVALID_VALUE);
}

TEST_F(CallsTest, GeneratedNumbersPassThoseThatAreChosen) {
  for (const HLuint chosen : {2U, 3U, 0xffffffffU}) define(chosen);
  HLuint objects[3];
  hlGenObjects(3, objects);
  EXPECT_THAT(objects, testing::ElementsAre(1U, 4U, 5U));
  hlBindTexture(HL_TEXTURE_2D, 0xffffffffU);
  HLuint texture = 0;
  hlGenTextures(1, &texture);
  EXPECT_EQ(texture, 1U);
}

TEST_F(CallsTest, DefinitionIsSentAndDrawsNothing) {
  define(3);
  EXPECT_EQ(hlIsObject(3), HL_TRUE);
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.objects_size(), 1);
  EXPECT_EQ(frame.objects(0).id(), 3U);
  EXPECT_EQ(frame.objects(0).items_size(), 1);
  EXPECT_FALSE(frame.has_world());
}

TEST_F(CallsTest, DefinitionBeginsAfreshAndLeaksNothing) {
  hlTranslatef(1, 0, 0);
  hlMateriald(HL_STIFFNESS, 0.5);
  hlLoadName(4);
  hlNormal3f(0, 0, 1);
  hlPushMatrix();
  hlNewObject(1);
  EXPECT_EQ(integer(HL_CURRENT_OBJECT), 1);
  EXPECT_EQ(integer(HL_MODELVIEW_STACK_DEPTH), 1);
  triangle();
  hlPushMatrix();
  hlScalef(2, 2, 2);
  hlMateriald(HL_VISCOSITY, 3);
  hlPushName(8);
  hlMatrixMode(HL_TEXTURE);
  hlEndObject();
  EXPECT_EQ(integer(HL_CURRENT_OBJECT), 0);
  EXPECT_EQ(number(HL_MODELVIEW_MATRIX), 1);
  EXPECT_EQ(integer(HL_MODELVIEW_STACK_DEPTH), 2);
  EXPECT_EQ(number(HL_STIFFNESS), 0.5);
  EXPECT_EQ(number(HL_VISCOSITY), 0);
  EXPECT_EQ(integer(HL_CURRENT_NAME), 4);
  EXPECT_EQ(integer(HL_NAME_STACK_DEPTH), 0);
  EXPECT_EQ(integer(HL_MATRIX_MODE), HL_MODELVIEW);
  HLdouble normal[3];
  hlGetDoublev(HL_CURRENT_NORMAL, normal);
  EXPECT_EQ(normal[2], 1);
  const proto::Item item = flushed().objects(0).items(0);
  EXPECT_EQ(item.matrix_size(), 0);
  EXPECT_FALSE(item.has_material());
  EXPECT_FALSE(item.has_name());
  EXPECT_EQ(item.primitives().normals_size(), 0);
}

TEST_F(CallsTest, CallCarriesMatrixSurfaceAndName) {
  define(1);
  hlTranslatef(0, 5, 0);
  hlMateriald(HL_STATIC_FRICTION, 0.5);
  hlLoadName(6);
  hlCallObject(1);
  const proto::Item item = flushed().world().items(0);
  EXPECT_EQ(item.call(), 1U);
  EXPECT_EQ(item.matrix(13), 5);
  EXPECT_EQ(item.material().static_friction(), 0.5);
  EXPECT_EQ(item.name(), 6U);
}

TEST_F(CallsTest, MisuseOfDefinitionsIsAnError) {
  hlNewObject(0), expectError(HL_INVALID_VALUE);
  hlEndObject(), expectError(HL_INVALID_OPERATION);
  hlCallObject(0), expectError(HL_INVALID_VALUE);
  hlCallObject(5), expectError(HL_INVALID_VALUE);
  hlDeleteObjects(-1, nullptr), expectError(HL_INVALID_VALUE);
  const HLuint one = 1;
  hlNewObject(1);
  hlNewObject(2), expectError(HL_INVALID_OPERATION);
  hlFlush(), expectError(HL_INVALID_OPERATION);
  hlFinish(), expectError(HL_INVALID_OPERATION);
  hlClear(), expectError(HL_INVALID_OPERATION);
  hlDeleteObjects(1, &one), expectError(HL_INVALID_OPERATION);
  hlDeleteTextures(1, &one), expectError(HL_INVALID_OPERATION);
  hlEndObject();
  expectError(HL_NO_ERROR);
  EXPECT_EQ(hlIsObject(2), HL_FALSE);
}

TEST_F(CallsTest, CallsInACircleAreInvalidOperation) {
  define(1);
  define(2, 1);
  define(3, 2);
  hlNewObject(1);
  hlCallObject(1), expectError(HL_INVALID_OPERATION);
  hlCallObject(3), expectError(HL_INVALID_OPERATION);
  hlEndObject();
  hlNewObject(4);
  hlCallObject(4), expectError(HL_INVALID_OPERATION);
  hlCallObject(3);
  hlCallObject(2);
  hlEndObject();
  expectError(HL_NO_ERROR);
}

TEST_F(CallsTest, LaterDefinitionOverwritesInOneFrame) {
  define(1);
  hlNewObject(1);
  hlEndObject();
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.objects_size(), 1);
  EXPECT_EQ(frame.objects(0).items_size(), 0);
}

// Two items: a triangle, and a segment that is placed elsewhere.
void defineTwoItems(HLuint object) {
  hlNewObject(object);
  triangle();
  hlTranslatef(0, 1, 0);
  hlBegin(HL_LINES);
  hlVertex3d(0, 0, 0);
  hlVertex3d(1, 0, 0);
  hlVertex3d(2, 0, 0);  // fills no segment
  hlEnd();
  hlEndObject();
}

TEST_F(CallsTest, MovedVerticesAreSentItemByItem) {
  defineTwoItems(3);
  flushed();
  const HLdouble vertices[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  hlUpdateVertices(3, 1, 3, vertices, nullptr);
  const proto::Frame frame = flushed();
  EXPECT_EQ(frame.objects_size(), 0);
  ASSERT_EQ(frame.moved_size(), 2);
  EXPECT_EQ(frame.moved(0).object(), 3U);
  EXPECT_EQ(frame.moved(0).item(), 0U);
  EXPECT_EQ(frame.moved(0).first(), 1U);
  ASSERT_EQ(frame.moved(0).primitives().vertices_size(), 6);
  EXPECT_EQ(frame.moved(0).primitives().vertices(5), 6);
  EXPECT_EQ(frame.moved(0).primitives().normals_size(), 0);
  EXPECT_EQ(frame.moved(1).item(), 1U);
  EXPECT_EQ(frame.moved(1).first(), 0U);
  ASSERT_EQ(frame.moved(1).primitives().vertices_size(), 3);
  EXPECT_EQ(frame.moved(1).primitives().vertices(0), 7);
  EXPECT_EQ(flushed().number(), 0U) << "once";
}

TEST_F(CallsTest, MovingVerticesThatAreNotThereIsAnError) {
  defineTwoItems(3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const HLdouble good[] = {1, 2, 3, 4, 5, 6}, bad[] = {1, 2, 3, 4, nan, 6};
  hlUpdateVertices(4, 0, 1, good, nullptr), expectError(HL_INVALID_VALUE);
  hlUpdateVertices(3, -1, 1, good, nullptr), expectError(HL_INVALID_VALUE);
  hlUpdateVertices(3, 0, -1, good, nullptr), expectError(HL_INVALID_VALUE);
  hlUpdateVertices(3, 0, 1, nullptr, nullptr), expectError(HL_INVALID_VALUE);
  hlUpdateVertices(3, 4, 2, good, nullptr), expectError(HL_INVALID_VALUE);
  hlUpdateVertices(3, 0, 2, bad, nullptr), expectError(HL_INVALID_VALUE);
  hlUpdateVertices(3, 0, 2, good, good), expectError(HL_INVALID_OPERATION);
  hlNewObject(5);
  hlUpdateVertices(3, 0, 2, good, nullptr), expectError(HL_INVALID_OPERATION);
  hlEndObject();
  EXPECT_EQ(flushed().moved_size(), 0);
  hlUpdateVertices(3, 5, 0, nullptr, nullptr);
}

TEST_F(CallsTest, OfMovedVerticesTheLatestAreSent) {
  const HLdouble vertices[] = {1, 2, 3, 4, 5, 6};
  defineTwoItems(3);
  hlUpdateVertices(3, 0, 1, vertices, nullptr);
  hlUpdateVertices(3, 2, 1, vertices, nullptr);
  hlUpdateVertices(3, 0, 2, vertices, nullptr);
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.moved_size(), 2) << "the first is covered by the last";
  EXPECT_EQ(frame.moved(0).first(), 2U);
  hlUpdateVertices(3, 0, 1, vertices, nullptr);
  defineTwoItems(3);
  EXPECT_EQ(flushed().moved_size(), 0) << "defined anew";
  hlUpdateVertices(3, 0, 1, vertices, nullptr);
  const HLuint object = 3;
  hlDeleteObjects(1, &object);
  EXPECT_EQ(flushed().moved_size(), 0) << "deleted";
}

TEST_F(CallsTest, ManyMovedVerticesGoAheadOfTheirFrame) {
  std::vector<HLdouble> vertices(3 * 100'000, 0.5);
  hlNewObject(3);
  hlNormal3f(0, 0, 1);
  hlBegin(HL_POINTS);
  for (int i = 0; i < 100'000; ++i) hlVertex3d(i, 0, 0);
  hlEnd();
  hlEndObject();
  flushed();
  hlUpdateVertices(3, 0, 100'000, vertices.data(), vertices.data());
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.moved_size(), 1);
  const proto::Primitives uploaded = server->uploads()[frame.moved(0).upload()];
  EXPECT_EQ(uploaded.vertices_size(), 300'000);
  EXPECT_EQ(uploaded.normals_size(), 300'000);
}

TEST_F(CallsTest, DeletedObjectsGoWithTheNextFrame) {
  define(1);
  define(2);
  flushed();
  const HLuint objects[] = {0, 1, 99};
  hlDeleteObjects(3, objects);
  EXPECT_EQ(hlIsObject(1), HL_FALSE);
  const proto::Frame frame = flushed();
  EXPECT_EQ(listOf(frame.deleted_objects()), (std::vector<double>{1}));
  EXPECT_EQ(flushed().number(), 0U);
}

TEST_F(CallsTest, TheLastOfDefiningAndDeletingCounts) {
  define(1);
  const HLuint one = 1;
  hlDeleteObjects(1, &one);
  define(2);
  const proto::Frame frame = flushed();
  EXPECT_EQ(frame.objects_size(), 1);
  EXPECT_EQ(frame.objects(0).id(), 2U);
  hlDeleteObjects(1, &one);
  EXPECT_EQ(flushed().number(), 0U);
  const HLuint two = 2;
  hlDeleteObjects(1, &two);
  define(2);
  EXPECT_EQ(flushed().deleted_objects_size(), 0);
}

// ---- Textures ----

class Textures : public CallsTest {
 protected:
  // A texture of 2 x 1 texels, bound to the active unit.
  HLuint image() {
    HLuint texture = 0;
    hlGenTextures(1, &texture);
    hlBindTexture(HL_TEXTURE_2D, texture);
    const HLubyte texels[] = {0, 255};
    hlTexImage2D(HL_TEXTURE_2D, 0, HL_LUMINANCE, 2, 1, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE, texels);
    return texture;
  }
};

TEST_F(Textures, TextureIsOneOnceBound) {
  HLuint texture = 0;
  hlGenTextures(1, &texture);
  EXPECT_EQ(hlIsTexture(texture), HL_FALSE);
  hlBindTexture(HL_TEXTURE_2D, texture);
  EXPECT_EQ(hlIsTexture(texture), HL_TRUE);
  EXPECT_EQ(hlIsTexture(0), HL_FALSE);
}

TEST_F(Textures, ImageAndParametersAreSent) {
  image();
  hlTexParameteri(HL_TEXTURE_2D, HL_TEXTURE_WRAP, HL_CLAMP);
  hlTexParameteri(HL_TEXTURE_2D, HL_TEXTURE_FILTER, HL_NEAREST);
  const proto::TextureImage sent = flushed().textures(0);
  EXPECT_EQ(sent.texels().width(), 2U);
  EXPECT_EQ(sent.texels().height(), 1U);
  EXPECT_EQ(sent.texels().values(), std::string("\0\xff", 2));
  EXPECT_EQ(sent.wrap(), proto::CLAMP);
  EXPECT_EQ(sent.filter(), proto::NEAREST);
  EXPECT_EQ(flushed().number(), 0U);
  hlTexParameteri(HL_TEXTURE_2D, HL_TEXTURE_FILTER, HL_LINEAR);
  EXPECT_EQ(flushed().textures(0).texels().values(), sent.texels().values());
}

TEST_F(Textures, FloatTexelsAreClampedAndRounded) {
  hlBindTexture(HL_TEXTURE_2D, 1);
  const HLfloat texels[] = {-1, 0.5F, 2};
  hlTexImage2D(HL_TEXTURE_2D, 0, HL_LUMINANCE, 3, 1, 0, HL_LUMINANCE, HL_FLOAT, texels);
  EXPECT_EQ(flushed().textures(0).texels().values(), std::string("\0\x80\xff", 3));
  hlTexImage2D(HL_TEXTURE_2D, 0, HL_LUMINANCE, 1, 2, 0, HL_LUMINANCE, HL_FLOAT, nullptr);
  EXPECT_EQ(flushed().textures(0).texels().values(), std::string("\0\0", 2));
}

TEST_F(Textures, APartOfAnImageIsChanged) {
  hlBindTexture(HL_TEXTURE_2D, 1);
  const HLubyte part[] = {1, 2, 3, 4};
  const auto luminance = static_cast<HLint>(HL_LUMINANCE);
  hlTexSubImage2D(HL_TEXTURE_2D, 0, 0, 0, 2, 2, HL_LUMINANCE, HL_UNSIGNED_BYTE, part);
  expectError(HL_INVALID_OPERATION);
  hlTexImage2D(HL_TEXTURE_2D, 0, luminance, 4, 3, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE, nullptr);
  flushed();
  hlTexSubImage2D(HL_TEXTURE_2D, 0, 2, 1, 2, 2, HL_LUMINANCE, HL_UNSIGNED_BYTE, part);
  EXPECT_EQ(flushed().textures(0).texels().values(), std::string("\0\0\0\0\0\0\1\2\0\0\3\4", 12));
  const HLfloat one = 1;
  hlTexSubImage2D(HL_TEXTURE_2D, 0, 0, 2, 1, 1, HL_LUMINANCE, HL_FLOAT, &one);
  EXPECT_EQ(flushed().textures(0).texels().values(), std::string("\0\0\0\0\0\0\1\2\xff\0\3\4", 12));
  for (const auto& [x, y, width, height] : std::vector<std::array<HLint, 4>>{{-1, 0, 1, 1},
                                                                             {0, -1, 1, 1},
                                                                             {3, 0, 2, 1},
                                                                             {0, 2, 1, 2},
                                                                             {0, 0, -1, 1},
                                                                             {5, 0, 0, 1},
                                                                             {2147483647, 0, 2, 1}})
    hlTexSubImage2D(HL_TEXTURE_2D, 0, x, y, width, height, HL_LUMINANCE, HL_UNSIGNED_BYTE, part),
        expectError(HL_INVALID_VALUE);
  hlTexSubImage2D(HL_TEXTURE_2D, 1, 0, 0, 1, 1, HL_LUMINANCE, HL_UNSIGNED_BYTE, part), expectError(HL_INVALID_VALUE);
  hlTexSubImage2D(HL_TEXTURE_2D, 0, 0, 0, 1, 1, HL_FLOAT, HL_UNSIGNED_BYTE, part), expectError(HL_INVALID_ENUM);
  hlTexSubImage2D(HL_TEXTURE_2D, 0, 0, 0, 1, 1, HL_LUMINANCE, HL_DOUBLE, part), expectError(HL_INVALID_ENUM);
  hlTexSubImage2D(HL_TEXTURE_2D, 0, 0, 0, 1, 1, HL_LUMINANCE, HL_UNSIGNED_BYTE, nullptr);
  EXPECT_EQ(flushed().number(), 0U) << "nothing has changed";
}

TEST_F(Textures, EnabledUnitsReachTheItemHigherOnesFirst) {
  const HLuint texture = image();
  hlEnable(HL_TEXTURE_2D);
  hlActiveTexture(HL_TEXTURE0 + 1);
  hlBindTexture(HL_TEXTURE_2D, texture);
  hlTexEnvi(HL_TEXTURE_ENV, HL_TEXTURE_QUANTITY, HL_HEIGHT);
  hlTexEnvd(HL_TEXTURE_ENV, HL_TEXTURE_HIGH, -1e-3);
  hlEnable(HL_TEXTURE_2D);
  hlActiveTexture(HL_TEXTURE0 + 2);
  hlBindTexture(HL_TEXTURE_2D, texture);
  hlTexEnvf(HL_TEXTURE_ENV, HL_TEXTURE_LOW, 0.25F);
  hlEnable(HL_TEXTURE_2D);
  hlActiveTexture(HL_TEXTURE0 + 3);
  hlEnable(HL_TEXTURE_2D);  // nothing is bound there
  triangle();
  const proto::Item item = flushed().world().items(0);
  ASSERT_EQ(item.material().textures_size(), 2);
  const proto::MaterialTexture& stiffness = item.material().textures(0);
  EXPECT_EQ(stiffness.texture(), std::to_string(texture));
  EXPECT_EQ(stiffness.quantity(), proto::STIFFNESS);
  EXPECT_EQ(stiffness.low(), 0.25);
  EXPECT_EQ(stiffness.high(), 1);
  EXPECT_EQ(item.material().textures(1).quantity(), proto::HEIGHT);
  EXPECT_EQ(item.material().textures(1).high(), -1e-3);
  EXPECT_FALSE(item.untextured());
  EXPECT_EQ(item.primitives().texcoords_size(), 6);
}

TEST_F(Textures, DisabledMeansUntexturedAndUntouchedMeansAsTheCaller) {
  image();
  triangle(0);
  hlEnable(HL_TEXTURE_2D);
  hlDisable(HL_TEXTURE_2D);
  triangle(1);
  const proto::World world = flushed().world();
  EXPECT_FALSE(world.items(0).untextured());
  EXPECT_TRUE(world.items(1).untextured());
}

TEST_F(Textures, TextureWithoutImageIsNone) {
  hlBindTexture(HL_TEXTURE_2D, 8);
  hlEnable(HL_TEXTURE_2D);
  triangle();
  const proto::Item item = flushed().world().items(0);
  EXPECT_EQ(item.material().textures_size(), 0);
  EXPECT_TRUE(item.untextured());
}

TEST_F(Textures, DeletedTextureIsUnboundAndGone) {
  const HLuint texture = image();
  hlEnable(HL_TEXTURE_2D);
  flushed();
  triangle();
  const HLuint textures[] = {texture, 0, 99};
  hlDeleteTextures(3, textures);
  EXPECT_EQ(integer(HL_TEXTURE_BINDING_2D), 0);
  EXPECT_EQ(hlIsTexture(texture), HL_FALSE);
  const proto::Frame frame = flushed();
  EXPECT_EQ(frame.world().items(0).material().textures_size(), 0);
  ASSERT_EQ(frame.deleted_textures_size(), 1);
  EXPECT_EQ(frame.deleted_textures(0), std::to_string(texture));
}

TEST_F(Textures, DeletedTextureStaysWithTheServerWhileItIsInUseThere) {
  const HLuint texture = image();
  hlNewObject(1);
  hlEnable(HL_TEXTURE_2D);
  hlBindTexture(HL_TEXTURE_2D, texture);
  triangle();
  hlEndObject();
  hlEnable(HL_TEXTURE_2D);
  triangle();
  flushed();
  hlDeleteTextures(1, &texture);
  EXPECT_EQ(flushed().number(), 0U);
  triangle();
  EXPECT_EQ(flushed().deleted_textures_size(), 0);
  define(1);
  EXPECT_EQ(flushed().deleted_textures_size(), 1);
}

TEST_F(Textures, SettingTheQuantityResetsItsRange) {
  hlTexEnvi(HL_TEXTURE_ENV, HL_TEXTURE_QUANTITY, HL_VISCOSITY);
  hlTexEnvd(HL_TEXTURE_ENV, HL_TEXTURE_HIGH, 50);
  hlTexEnvi(HL_TEXTURE_ENV, HL_TEXTURE_QUANTITY, HL_STIFFNESS);
  image();
  hlEnable(HL_TEXTURE_2D);
  triangle();
  EXPECT_EQ(flushed().world().items(0).material().textures(0).high(), 1);
}

TEST_F(Textures, MisuseIsAnError) {
  const HLubyte texel = 1;
  const auto imageCall = [&](HLenum target, HLint level, HLint internal, HLsizei side, HLint border, HLenum format,
                             HLenum type) {
    hlTexImage2D(target, level, internal, side, 1, border, format, type, &texel);
  };
  const auto luminance = static_cast<HLint>(HL_LUMINANCE);
  imageCall(HL_TEXTURE_2D, 0, luminance, 1, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE), expectError(HL_INVALID_OPERATION);
  hlTexParameteri(HL_TEXTURE_2D, HL_TEXTURE_WRAP, HL_CLAMP), expectError(HL_INVALID_OPERATION);
  image();
  imageCall(HL_TEXTURE0, 0, luminance, 1, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE), expectError(HL_INVALID_ENUM);
  imageCall(HL_TEXTURE_2D, 1, luminance, 1, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE), expectError(HL_INVALID_VALUE);
  imageCall(HL_TEXTURE_2D, 0, 3, 1, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE), expectError(HL_INVALID_VALUE);
  imageCall(HL_TEXTURE_2D, 0, luminance, 0, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE), expectError(HL_INVALID_VALUE);
  imageCall(HL_TEXTURE_2D, 0, luminance, 10000, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE), expectError(HL_INVALID_VALUE);
  imageCall(HL_TEXTURE_2D, 0, luminance, 1, 1, HL_LUMINANCE, HL_UNSIGNED_BYTE), expectError(HL_INVALID_VALUE);
  imageCall(HL_TEXTURE_2D, 0, luminance, 1, 0, HL_FLOAT, HL_UNSIGNED_BYTE), expectError(HL_INVALID_ENUM);
  imageCall(HL_TEXTURE_2D, 0, luminance, 1, 0, HL_LUMINANCE, HL_DOUBLE), expectError(HL_INVALID_ENUM);
  const HLfloat nan = std::numeric_limits<HLfloat>::quiet_NaN();
  hlTexImage2D(HL_TEXTURE_2D, 0, luminance, 1, 1, 0, HL_LUMINANCE, HL_FLOAT, &nan), expectError(HL_INVALID_VALUE);
  hlTexImage2D(HL_TEXTURE_2D, 0, luminance, 8000, 8000, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE, nullptr);
  expectError(HL_OUT_OF_MEMORY);
  hlTexParameteri(HL_TEXTURE0, HL_TEXTURE_WRAP, HL_CLAMP), expectError(HL_INVALID_ENUM);
  hlTexParameteri(HL_TEXTURE_2D, HL_TEXTURE_WRAP, HL_LINEAR), expectError(HL_INVALID_ENUM);
  hlTexParameteri(HL_TEXTURE_2D, HL_CLAMP, HL_CLAMP), expectError(HL_INVALID_ENUM);
  hlBindTexture(HL_TEXTURE0, 1), expectError(HL_INVALID_ENUM);
  hlActiveTexture(HL_TEXTURE0 + 5), expectError(HL_INVALID_ENUM);
  hlActiveTexture(HL_TEXTURE0 - 1), expectError(HL_INVALID_ENUM);
  hlTexEnvi(HL_TEXTURE_2D, HL_TEXTURE_LOW, 0), expectError(HL_INVALID_ENUM);
  hlTexEnvi(HL_TEXTURE_ENV, HL_TEXTURE_QUANTITY, HL_STRIBECK), expectError(HL_INVALID_ENUM);
  hlTexEnvd(HL_TEXTURE_ENV, HL_TEXTURE_QUANTITY, HL_STIFFNESS), expectError(HL_INVALID_ENUM);
  hlTexEnvi(HL_TEXTURE_ENV, HL_TEXTURE_HIGH, 2), expectError(HL_INVALID_VALUE);
  hlTexEnvf(HL_TEXTURE_ENV, HL_TEXTURE_LOW, nan), expectError(HL_INVALID_VALUE);
  hlEnable(HL_VERTEX_ARRAY), expectError(HL_INVALID_ENUM);
  hlDisable(HL_SMOOTH), expectError(HL_INVALID_ENUM);
  hlIsEnabled(HL_SMOOTH), expectError(HL_INVALID_ENUM);
  hlGenTextures(-1, nullptr), expectError(HL_INVALID_VALUE);
  hlDeleteTextures(-1, nullptr), expectError(HL_INVALID_VALUE);
  EXPECT_EQ(flushed().textures(0).texels().values(), std::string("\0\xff", 2));
}

}  // namespace
}  // namespace hl::client::test_objects
