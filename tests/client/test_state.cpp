// Matrices, surfaces, attribute and name stacks.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "client/fake_server.h"

namespace hl::client::test_state {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
using Matrix = std::array<double, 16>;
constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix matrix(HLenum name = HL_MODELVIEW_MATRIX) {
  Matrix m{};
  hlGetDoublev(name, m.data());
  return m;
}

void expectError(HLenum error) { EXPECT_EQ(hlGetError(), error); }

// ---- Matrices ----

TEST_F(CallsTest, MatrixAtBeginBecomesTheItemsAndIdentityIsLeftOut) {
  triangle();
  hlTranslated(1, 2, 3);
  triangle();
  const proto::World world = flushed().world();
  ASSERT_EQ(world.items_size(), 2);
  EXPECT_EQ(world.items(0).matrix_size(), 0);
  EXPECT_EQ(listOf(world.items(1).matrix()), (std::vector<double>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}));
}

TEST_F(CallsTest, MatricesMultiplyFromTheRight) {
  hlTranslatef(1, 0, 0);
  hlRotatef(90, 0, 0, 1);
  hlScaled(2, 3, 4);
  // The x axis of the object is 2 along y of the world.
  EXPECT_NEAR(matrix()[0], 0, 1e-15);
  EXPECT_NEAR(matrix()[1], 2, 1e-15);
  EXPECT_NEAR(matrix()[4], -3, 1e-15);
  EXPECT_EQ(matrix()[10], 4);
  EXPECT_EQ(matrix()[12], 1);
}

TEST_F(CallsTest, RotationTakesAnyLengthOfAxis) {
  hlRotated(50, 0, 0, 1e-200);
  EXPECT_NEAR(matrix()[0], std::cos(50 * M_PI / 180), 1e-15);
  EXPECT_NEAR(matrix()[1], std::sin(50 * M_PI / 180), 1e-15);
}

TEST_F(CallsTest, LoadAndMultTakeColumns) {
  Matrix m = kIdentity;
  m[12] = 5;
  hlLoadMatrixd(m.data());
  hlMultMatrixd(m.data());
  EXPECT_EQ(matrix()[12], 10);
  std::array<HLfloat, 16> f{};
  for (int i = 0; i < 16; ++i) f[i] = static_cast<HLfloat>(m[i]);
  hlMultMatrixf(f.data());
  EXPECT_EQ(matrix()[12], 15);
  hlLoadMatrixf(f.data());
  EXPECT_EQ(matrix()[12], 5);
  hlLoadIdentity();
  EXPECT_EQ(matrix(), kIdentity);
}

TEST_F(CallsTest, StacksOfBothModesAreTheirOwn) {
  hlPushMatrix();
  hlTranslatef(1, 0, 0);
  hlMatrixMode(HL_TEXTURE);
  EXPECT_EQ(matrix(HL_TEXTURE_MATRIX), kIdentity);
  EXPECT_EQ(integer(HL_MODELVIEW_STACK_DEPTH), 2);
  EXPECT_EQ(integer(HL_TEXTURE_STACK_DEPTH), 1);
  hlScalef(0, 1, 1);  // a texture may be stretched without end
  hlMatrixMode(HL_MODELVIEW);
  hlPopMatrix();
  EXPECT_EQ(matrix(), kIdentity);
  EXPECT_EQ(integer(HL_MATRIX_MODE), HL_MODELVIEW);
}

TEST_F(CallsTest, PushOnFullStackIsStackOverflow) {
  for (const HLenum mode : {HL_MODELVIEW, HL_TEXTURE}) {
    hlMatrixMode(mode);
    const int most = integer(mode == HL_MODELVIEW ? HL_MAX_MODELVIEW_STACK_DEPTH : HL_MAX_TEXTURE_STACK_DEPTH);
    for (int i = 1; i < most; ++i) hlPushMatrix();
    expectError(HL_NO_ERROR);
    hlPushMatrix();
    expectError(HL_STACK_OVERFLOW);
    EXPECT_EQ(integer(mode == HL_MODELVIEW ? HL_MODELVIEW_STACK_DEPTH : HL_TEXTURE_STACK_DEPTH), most);
  }
}

TEST_F(CallsTest, PopOnEmptyStackIsStackUnderflow) {
  hlPopMatrix();
  expectError(HL_STACK_UNDERFLOW);
  hlPopAttrib();
  expectError(HL_STACK_UNDERFLOW);
  hlPopName();
  expectError(HL_STACK_UNDERFLOW);
}

TEST_F(CallsTest, MatricesThatCannotPlaceAnythingAreInvalidValueAndChangeNothing) {
  hlTranslatef(1, 2, 3);
  const Matrix before = matrix();
  Matrix bad = kIdentity;
  bad[3] = 1;
  hlLoadMatrixd(bad.data()), expectError(HL_INVALID_VALUE);
  hlMultMatrixd(bad.data()), expectError(HL_INVALID_VALUE);
  bad = kIdentity;
  bad[0] = 0;
  hlLoadMatrixd(bad.data()), expectError(HL_INVALID_VALUE);
  bad[0] = kNaN;
  hlLoadMatrixd(bad.data()), expectError(HL_INVALID_VALUE);
  hlScalef(1, 0, 1), expectError(HL_INVALID_VALUE);
  hlScaled(1e300, 1e300, 1e300), expectError(HL_INVALID_VALUE);
  hlTranslated(kNaN, 0, 0), expectError(HL_INVALID_VALUE);
  hlRotated(10, 0, 0, 0), expectError(HL_INVALID_VALUE);
  hlRotated(kNaN, 0, 0, 1), expectError(HL_INVALID_VALUE);
  hlMatrixMode(HL_TEXTURE_2D), expectError(HL_INVALID_ENUM);
  EXPECT_EQ(matrix(), before);
}

TEST_F(CallsTest, NothingButVerticesBetweenBeginAndEnd) {
  const std::vector<void (*)()> calls{[] { hlMatrixMode(HL_TEXTURE); },
                                      [] { hlPushMatrix(); },
                                      [] { hlPopMatrix(); },
                                      [] { hlLoadIdentity(); },
                                      [] { hlLoadMatrixd(kIdentity.data()); },
                                      [] { hlTranslatef(1, 0, 0); },
                                      [] { hlRotatef(1, 1, 0, 0); },
                                      [] { hlScalef(2, 2, 2); },
                                      [] { hlMaterialf(HL_STIFFNESS, 0.5F); },
                                      [] { hlShadeModel(HL_FLAT); },
                                      [] { hlEnable(HL_TEXTURE_2D); },
                                      [] { hlDisable(HL_TEXTURE_2D); },
                                      [] { hlIsEnabled(HL_TEXTURE_2D); },
                                      [] { hlPushAttrib(HL_ALL_ATTRIB_BITS); },
                                      [] { hlPopAttrib(); },
                                      [] { hlLoadName(3); },
                                      [] { hlPushName(3); },
                                      [] { hlPopName(); },
                                      [] { hlNewObject(3); },
                                      [] { hlEndObject(); },
                                      [] { hlCancelObject(); },
                                      [] { hlCallObject(3); },
                                      [] { hlIsObject(3); },
                                      [] { hlDeleteObjects(0, nullptr); },
                                      [] { hlUpdateVertices(3, 0, 0, nullptr, nullptr); },
                                      [] { hlGenObjects(0, nullptr); },
                                      [] { hlClear(); },
                                      [] { hlFlush(); },
                                      [] { hlFinish(); },
                                      [] { hlFinishTimeout(0); },
                                      [] { hlFrameInterval(1); },
                                      [] { hlPoll(); },
                                      [] { hlEventFunc(HL_EVENT_TOUCH, nullptr, nullptr); },
                                      [] { hlErrorFunc(nullptr, nullptr); },
                                      [] { hlGetString(HL_VENDOR); },
                                      [] { integer(HL_CURRENT_NAME); },
                                      [] { hlGetContacts(0, nullptr); },
                                      [] { hlStateRate(1); },
                                      [] { hlProxyd(HL_PROXY_RADIUS, 1); },
                                      [] { hlWorkspaced(0, 0, 0, 1); },
                                      [] { hlSpringd(1); },
                                      [] { hlLedger(HL_LEDGER_TANK); },
                                      [] { hlRearm(); },
                                      [] { hlHandGoal3d(0, 0, 0); },
                                      [] { hlActiveTexture(HL_TEXTURE0); },
                                      [] { hlBindTexture(HL_TEXTURE_2D, 1); },
                                      [] { hlTexEnvi(HL_TEXTURE_ENV, HL_TEXTURE_QUANTITY, HL_HEIGHT); },
                                      [] { hlTexParameteri(HL_TEXTURE_2D, HL_TEXTURE_WRAP, HL_CLAMP); },
                                      [] { hlGenTextures(0, nullptr); },
                                      [] { hlDeleteTextures(0, nullptr); },
                                      [] { hlIsTexture(1); },
                                      [] { hlEnableClientState(HL_NORMAL_ARRAY); },
                                      [] { hlDisableClientState(HL_NORMAL_ARRAY); },
                                      [] { hlVertexPointer(3, HL_FLOAT, 0, nullptr); },
                                      [] { hlDrawArrays(HL_POINTS, 0, 1); }};
  for (std::size_t i = 0; i < calls.size(); ++i) {
    hlBegin(HL_POINTS);
    calls[i]();
    hlEnd();
    EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION) << "call " << i;
  }
  EXPECT_TRUE(server->received.empty());
  EXPECT_EQ(matrix(), kIdentity);
}

// ---- Surface ----

TEST_F(CallsTest, WhatIsNotSetIsLeftOut) {
  triangle();
  EXPECT_FALSE(flushed().world().items(0).has_material());
}

TEST_F(CallsTest, EveryQuantityReachesTheItem) {
  hlMateriald(HL_STIFFNESS, 0.1);
  hlMaterialf(HL_STATIC_FRICTION, 0.5F);
  hlMateriald(HL_DYNAMIC_FRICTION, 0.3);
  hlMateriald(HL_VISCOSITY, 4);
  hlMateriald(HL_STRIBECK, 0.05);
  hlMateriald(HL_PRESLIDING, 600);
  hlShadeModel(HL_FLAT);
  hlLoadName(9);
  triangle();
  const proto::Item item = flushed().world().items(0);
  EXPECT_EQ(item.material().stiffness(), 0.1);
  EXPECT_EQ(item.material().static_friction(), 0.5);
  EXPECT_EQ(item.material().dynamic_friction(), 0.3);
  EXPECT_EQ(item.material().viscosity_ns_m(), 4);
  EXPECT_EQ(item.material().stribeck_m_s(), 0.05);
  EXPECT_EQ(item.material().presliding_n_m(), 600);
  EXPECT_EQ(item.material().shade(), proto::FLAT);
  EXPECT_EQ(item.name(), 9U);
  EXPECT_EQ(number(HL_VISCOSITY), 4);
}

TEST_F(CallsTest, MaterialOutOfRangeIsInvalidValueAndChangesNothing) {
  hlMateriald(HL_STIFFNESS, 1.01), expectError(HL_INVALID_VALUE);
  hlMateriald(HL_STIFFNESS, -0.01), expectError(HL_INVALID_VALUE);
  hlMateriald(HL_VISCOSITY, kNaN), expectError(HL_INVALID_VALUE);
  hlMaterialf(HL_STATIC_FRICTION, -1), expectError(HL_INVALID_VALUE);
  hlMateriald(HL_HEIGHT, 0), expectError(HL_INVALID_ENUM);
  hlMateriald(HL_FLAT, 0), expectError(HL_INVALID_ENUM);
  hlShadeModel(HL_POINTS), expectError(HL_INVALID_ENUM);
  EXPECT_EQ(number(HL_STIFFNESS), 1);
  EXPECT_EQ(integer(HL_SHADE_MODEL), HL_SMOOTH);
  triangle();
  EXPECT_FALSE(flushed().world().items(0).has_material());
}

TEST_F(CallsTest, PushAttribSavesOnlyTheGroupsAskedFor) {
  hlPushAttrib(HL_SURFACE_BIT);
  hlMateriald(HL_STIFFNESS, 0.5);
  hlLoadName(3);
  hlPopAttrib();
  EXPECT_EQ(number(HL_STIFFNESS), 1);
  EXPECT_EQ(integer(HL_CURRENT_NAME), 3);
  hlPushAttrib(HL_CURRENT_BIT | HL_TRANSFORM_BIT);
  hlLoadName(4);
  hlNormal3f(1, 0, 0);
  hlMatrixMode(HL_TEXTURE);
  hlShadeModel(HL_FLAT);
  hlPopAttrib();
  EXPECT_EQ(integer(HL_CURRENT_NAME), 3);
  EXPECT_EQ(number(HL_CURRENT_NORMAL), 0);
  EXPECT_EQ(integer(HL_MATRIX_MODE), HL_MODELVIEW);
  EXPECT_EQ(integer(HL_SHADE_MODEL), HL_FLAT);
  hlPushAttrib(HL_ENABLE_BIT);
  hlEnable(HL_TEXTURE_2D);
  hlBindTexture(HL_TEXTURE_2D, 5);
  hlPopAttrib();
  EXPECT_EQ(hlIsEnabled(HL_TEXTURE_2D), HL_FALSE);
  EXPECT_EQ(integer(HL_TEXTURE_BINDING_2D), 5);
  hlPushAttrib(HL_TEXTURE_BIT);
  hlActiveTexture(HL_TEXTURE0 + 2);
  hlEnable(HL_TEXTURE_2D);
  hlPopAttrib();
  EXPECT_EQ(integer(HL_ACTIVE_TEXTURE), HL_TEXTURE0);
}

TEST_F(CallsTest, AttribAndNameStacksOverflow) {
  for (int i = 0; i < integer(HL_MAX_ATTRIB_STACK_DEPTH); ++i) hlPushAttrib(0);
  for (int i = 0; i < integer(HL_MAX_NAME_STACK_DEPTH); ++i) hlPushName(static_cast<HLuint>(i));
  expectError(HL_NO_ERROR);
  hlPushAttrib(0), expectError(HL_STACK_OVERFLOW);
  hlPushName(0), expectError(HL_STACK_OVERFLOW);
  EXPECT_EQ(integer(HL_CURRENT_NAME), 63);
  hlPopName();
  EXPECT_EQ(integer(HL_CURRENT_NAME), 62);
  EXPECT_EQ(integer(HL_NAME_STACK_DEPTH), 63);
  EXPECT_EQ(integer(HL_ATTRIB_STACK_DEPTH), 16);
}

// ---- Queries of state ----

TEST_F(CallsTest, QueriesConvertAsInGl) {
  hlNormal3d(0.6, -1.5, 1e30);
  HLint integers[3];
  hlGetIntegerv(HL_CURRENT_NORMAL, integers);
  EXPECT_EQ(integers[0], 1);
  EXPECT_EQ(integers[1], -2);
  EXPECT_EQ(integers[2], std::numeric_limits<HLint>::max());
  HLboolean booleans[3];
  hlGetBooleanv(HL_CURRENT_NORMAL, booleans);
  EXPECT_EQ(booleans[0], HL_TRUE);
  HLfloat floats[3];
  hlGetFloatv(HL_CURRENT_NORMAL, floats);
  EXPECT_EQ(floats[0], 0.6F);
  hlGetFloatv(HL_POINTS, floats), expectError(HL_INVALID_ENUM);
  EXPECT_EQ(floats[0], 0.6F);
}

// What the next error says.
std::string textOfError() {
  EXPECT_EQ(hlGetError(), static_cast<HLenum>(HL_INVALID_VALUE));
  return hlGetString(HL_ERROR_STRING);
}

TEST_F(CallsTest, ANumberOutOfItsRangeIsNamedWithItsRange) {
  hlMateriald(HL_VISCOSITY, -1);
  EXPECT_EQ(textOfError(), "hlMateriald: HL_VISCOSITY must be 0 to 1e9, and is -1");
  hlTexEnvd(HL_TEXTURE_ENV, HL_TEXTURE_HIGH, 2);
  EXPECT_EQ(textOfError(), "hlTexEnvd: HL_STIFFNESS must be 0 to 1, and is 2");
  hlJointd(HL_JOINT_SPRING, -2.5e-7);
  EXPECT_EQ(textOfError(), "hlJointd: HL_JOINT_SPRING must be 0 to 1e9, and is -2.5e-7");
  hlGravity3d(0, -1e10, 0);
  EXPECT_EQ(textOfError(), "hlGravity3d: each coordinate must be -1000 to 1000, and is -1e10");
  hlProxyd(HL_PROXY_RADIUS, 0);
  EXPECT_EQ(textOfError(), "hlProxyd: HL_PROXY_RADIUS must be above 0");
  hlNewObject(1);
  hlBodyd(HL_BODY_MASS, 1e10);
  EXPECT_EQ(textOfError(), "hlBodyd: HL_BODY_MASS must be 1e-9 to 1e9, and is 1e10");
  hlSnapPoint3d(0, 0, 0, std::nan(""), 1);
  EXPECT_EQ(textOfError(), "hlSnapPoint3d: the capture must be 1e-9 to 1e9, and is nan");
  hlFieldForce3d(0, 0, 0, 1, 0, 2000, 0);
  EXPECT_EQ(textOfError(), "hlFieldForce3d: the force must be 1e-9 to 1000, and is 2000");
  hlEndObject();
  hlBodyImpulsed(1, 0, 2e6, 0, 0, 0, 0, 0);
  EXPECT_EQ(textOfError(), "hlBodyImpulsed: each coordinate of the impulse must be -1e6 to 1e6, and is 2e6");
  hlCompliance(1, -1, 0, nullptr);
  EXPECT_EQ(textOfError(), "hlCompliance: each compliance must be 0 to 1e9, and is -1");
}

}  // namespace
}  // namespace hl::client::test_state
