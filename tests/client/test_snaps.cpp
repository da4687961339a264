// Snaps by the calls: what is sent of them, what the state gives, and which calls are errors.
#include <gtest/gtest.h>

#include <cmath>

#include "client/fake_server.h"

namespace hl::client::test_snaps {
namespace {

HLenum errorOf(void (*call)()) {
  call();
  return hlGetError();
}

TEST_F(CallsTest, SnapsAreSentWithTheirObjectPlacedByTheMatrix) {
  hlNewObject(3);
  hlTranslated(0, 0, 1);
  hlScaled(1, 2, 1);
  hlSnapPoint3d(1, 1, 0, 0.002, 3);
  hlSnapPoint3d(0, 0, 0, 0.001, 2);
  hlSnapLineTo3d(0, 1, 0);
  hlSnapLineTo3d(0, 1, 1);
  hlSnapPlane3d(0, 1, 0, 3, 3, 0, 0.001, 2);
  hlEndObject();
  hlLoadIdentity();
  hlCallObject(3);
  hlFlush();
  EXPECT_EQ(hlGetError(), HLenum{HL_NO_ERROR});
  const auto frames = server->frames();
  ASSERT_EQ(frames.size(), 1U);
  const proto::ObjectDefinition& object = frames[0].objects(0);
  ASSERT_EQ(object.snaps_size(), 3);
  EXPECT_EQ(object.items_size(), 0);
  const auto points = [&](int i) {
    return std::vector<double>(object.snaps(i).points().begin(), object.snaps(i).points().end());
  };
  EXPECT_EQ(points(0), (std::vector<double>{1, 2, 1}));
  EXPECT_EQ(object.snaps(0).capture(), 0.002);
  EXPECT_EQ(object.snaps(0).release_n(), 3);
  EXPECT_EQ(points(1), (std::vector<double>{0, 0, 1, 0, 2, 1, 0, 2, 2}));
  EXPECT_FALSE(object.snaps(1).has_normal());
  EXPECT_NEAR(object.snaps(2).normal().x(), 2 / std::sqrt(5), 1e-15);  // by the inverse transpose
  EXPECT_NEAR(object.snaps(2).normal().y(), 1 / std::sqrt(5), 1e-15);
}

TEST_F(CallsTest, SnapsOutOfRangeAreErrorsAndNotSent) {
  const HLenum operation = HL_INVALID_OPERATION, value = HL_INVALID_VALUE;
  EXPECT_EQ(errorOf([] { hlSnapPoint3d(0, 0, 0, 1, 1); }), operation);
  EXPECT_EQ(errorOf([] { hlSnapPlane3d(0, 0, 0, 1, 0, 0, 1, 1); }), operation);
  hlNewObject(1);
  EXPECT_EQ(errorOf([] { hlSnapLineTo3d(0, 0, 0); }), operation);
  EXPECT_EQ(errorOf([] { hlSnapPoint3d(0, 0, 0, 0, 1); }), value);
  EXPECT_EQ(errorOf([] { hlSnapPoint3d(0, 0, 0, 1, -1); }), value);
  EXPECT_EQ(errorOf([] { hlSnapPoint3d(0, 0, 0, 1, std::nan("")); }), value);
  EXPECT_EQ(errorOf([] { hlSnapPoint3d(0, HUGE_VAL, 0, 1, 1); }), value);
  EXPECT_EQ(errorOf([] { hlSnapPoint3d(0, 0, 1.1e6, 1, 1); }), value);
  EXPECT_EQ(errorOf([] { hlSnapPlane3d(0, 0, 0, 0, 0, 0, 1, 1); }), value);
  EXPECT_EQ(errorOf([] { hlSnapPlane3d(0, 0, 0, std::nan(""), 0, 0, 1, 1); }), value);
  hlSnapPlane3d(0, 0, 0, 1, 0, 0, 1, 1);
  EXPECT_EQ(errorOf([] { hlSnapLineTo3d(0, 0, 0); }), operation) << "a plane";
  hlSnapPoint3d(0, 0, 0, 1, 1);
  for (int i = 1; i < 256; ++i) hlSnapLineTo3d(i, 0, 0);
  EXPECT_EQ(errorOf([] { hlSnapLineTo3d(0, 0, 0); }), value);
  for (int i = 2; i < 64; ++i) hlSnapPoint3d(0, 0, 0, 1, 1);
  EXPECT_EQ(errorOf([] { hlSnapPoint3d(0, 0, 0, 1, 1); }), value);
  hlEndObject();
  hlFlush();
  EXPECT_EQ(server->frames()[0].objects(0).snaps_size(), 64);
}

TEST_F(CallsTest, FieldsAreSentWithTheirObjectPlacedByTheMatrix) {
  hlNewObject(3);
  hlRotated(90, 0, 0, 1);
  hlFieldPoint3d(HL_FIELD_MAGNET, 1, 0, 0, 0.03, 2);
  hlFieldLineTo3d(2, 0, 0);
  hlFieldPlane3d(HL_FIELD_DRAG, 0, 0, 0, 5, 0, 0, 0.1, 4);
  hlFieldPoint3d(HL_FIELD_SPRING, 0, 0, 0, 0.1, 50);
  hlFieldForce3d(0, 0, 0, 0.1, 3, 0, 4);
  hlEndObject();
  hlFlush();
  EXPECT_EQ(hlGetError(), HLenum{HL_NO_ERROR});
  const proto::ObjectDefinition object = server->frames()[0].objects(0);
  ASSERT_EQ(object.fields_size(), 4);
  EXPECT_EQ(object.fields(0).kind(), proto::MAGNET);
  EXPECT_EQ(object.fields(0).points_size(), 6);
  EXPECT_NEAR(object.fields(0).points(4), 2, 1e-15);
  EXPECT_EQ(object.fields(0).reach(), 0.03);
  EXPECT_EQ(object.fields(0).force_n(), 2);
  EXPECT_EQ(object.fields(1).kind(), proto::DRAG);
  EXPECT_NEAR(object.fields(1).normal().y(), 1, 1e-15);
  EXPECT_EQ(object.fields(1).damping_ns_m(), 4);
  EXPECT_EQ(object.fields(2).stiffness_n_m(), 50);
  EXPECT_EQ(object.fields(3).kind(), proto::CONSTANT);
  EXPECT_EQ(object.fields(3).force_n(), 5);
  EXPECT_NEAR(object.fields(3).direction().y(), 0.6, 1e-15);
  EXPECT_NEAR(object.fields(3).direction().z(), 0.8, 1e-15);
}

TEST_F(CallsTest, FieldsOutOfRangeAreErrorsAndNotSent) {
  EXPECT_EQ(errorOf([] { hlFieldPoint3d(HL_FIELD_MAGNET, 0, 0, 0, 1, 1); }), HLenum{HL_INVALID_OPERATION});
  hlNewObject(1);
  EXPECT_EQ(errorOf([] { hlFieldPoint3d(HL_FIELD_CONSTANT, 0, 0, 0, 1, 1); }), HLenum{HL_INVALID_ENUM});
  EXPECT_EQ(errorOf([] { hlFieldPoint3d(HL_POINTS, 0, 0, 0, 1, 1); }), HLenum{HL_INVALID_ENUM});
  EXPECT_EQ(errorOf([] { hlFieldPoint3d(HL_FIELD_MAGNET, 0, 0, 0, 1, 1001); }), HLenum{HL_INVALID_VALUE});
  EXPECT_EQ(errorOf([] { hlFieldPoint3d(HL_FIELD_DRAG, 0, 0, 0, 1, 101); }), HLenum{HL_INVALID_VALUE});
  EXPECT_EQ(errorOf([] { hlFieldPoint3d(HL_FIELD_SPRING, 0, 0, 0, 0, 1); }), HLenum{HL_INVALID_VALUE});
  EXPECT_EQ(errorOf([] { hlFieldForce3d(0, 0, 0, 1, 0, 0, 0); }), HLenum{HL_INVALID_VALUE});
  EXPECT_EQ(errorOf([] { hlFieldForce3d(0, 0, 0, 1, std::nan(""), 0, 0); }), HLenum{HL_INVALID_VALUE});
  EXPECT_EQ(errorOf([] { hlFieldLineTo3d(0, 0, 0); }), HLenum{HL_INVALID_OPERATION});
  hlEndObject();
  hlFlush();
  EXPECT_EQ(server->frames()[0].objects(0).fields_size(), 0);
}

TEST_F(CallsTest, TheStateGivesWhichSnapHolds) {
  server->sendState();
  hlPoll();
  EXPECT_EQ(number(HL_SNAPPED_OBJECT), 0);
  const auto session = static_cast<std::uint32_t>(number(HL_SESSION));
  proto::HoldingSnap& snap = *server->sendState().mutable_snap();
  snap.set_object(3);
  snap.set_name(7);
  snap.set_number(2);
  snap.set_session(session);
  hlPoll();
  EXPECT_EQ(number(HL_SNAPPED_OBJECT), 3);
  EXPECT_EQ(number(HL_SNAPPED_NAME), 7);
  EXPECT_EQ(number(HL_SNAP_NUMBER), 2);
}

}  // namespace
}  // namespace hl::client::test_snaps
