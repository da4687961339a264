// Frames of a few bytes that ask for more memory than a session may have, and numbers that are none, are refused before
// anything is made of them.
#include "server/decode_frame.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "base/error.h"

namespace hl {
namespace {

SceneLimits smallLimits() {
  SceneLimits limits;
  limits.primitives = 10;
  limits.texture_bytes = 64 * sizeof(float);
  return limits;
}

std::string refusalOf(const proto::Frame& frame, const Uploads& uploads = {}, MemoryShare memory = {}) {
  try {
    decodeFrame(frame, uploads, smallLimits(), memory, [](double) {});
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void addTexture(proto::Frame& frame, const std::string& name, std::uint32_t size) {
  proto::TextureImage& texture = *frame.add_textures();
  texture.set_name(name);
  texture.mutable_procedural()->set_kind("checker");
  texture.mutable_procedural()->set_size(size);
}

TEST(DecodeFrame, TexturesShareTheRoomThereIs) {
  proto::Frame frame;
  addTexture(frame, "a", 4);
  addTexture(frame, "b", 6);
  EXPECT_EQ(refusalOf(frame), "accepted");
  addTexture(frame, "c", 4);
  EXPECT_EQ(refusalOf(frame), "textures[2].procedural.size of 4 is too large: there is room for 12 texels");
}

// An upload with no element: each item that refers to it would keep all of its vertices.
TEST(DecodeFrame, VerticesOfUploadsAreCountedForEachItem) {
  Uploads uploads;
  for (int i = 0; i < 12; ++i) uploads[1].add_vertices(i);
  proto::Frame frame;
  for (int i = 0; i < 8; ++i) frame.mutable_world()->add_items()->set_upload(1);
  EXPECT_EQ(refusalOf(frame, uploads), "accepted");
  frame.mutable_world()->add_items()->set_upload(1);
  EXPECT_EQ(refusalOf(frame, uploads), "world.items[8].upload: there are more than 10 x 3 vertices");
}

// What is not finite, or so large that products of it would not be, is refused where it comes in.
TEST(DecodeFrame, NumbersThatNobodyCanComputeWithAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto with = [](auto set) {
    proto::Frame frame;
    proto::Item& item = *frame.mutable_world()->add_items();
    for (const double x : {0, 0, 0, 1, 0, 0, 0, 1, 0}) item.mutable_primitives()->add_vertices(x);
    for (const std::uint32_t i : {0u, 1u, 2u}) item.mutable_primitives()->add_triangles(i);
    set(item);
    return refusalOf(frame);
  };
  EXPECT_EQ(with([](proto::Item&) {}), "accepted");
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_EQ(with([&](proto::Item& item) {
                for (int i = 0; i < 9; ++i) item.mutable_primitives()->add_normals(i == 4 ? bad : 1);
              }),
              "world.items[0].primitives.normals must hold finite numbers");
    EXPECT_EQ(with([&](proto::Item& item) {
                for (int i = 0; i < 6; ++i) item.mutable_primitives()->add_texcoords(i == 4 ? bad : 1);
              }),
              "world.items[0].primitives.texcoords must hold finite numbers");
  }
  for (const double bad : {nan, inf, -1.0, 1e10, 1e308}) {
    const auto refused = [&](auto set) { return with([&](proto::Item& item) { set(*item.mutable_material()); }); };
    const std::string range = " must be between 0 and 1e+09", at = "world.items[0].material.";
    EXPECT_EQ(refused([&](proto::Material& m) { m.set_stiffness(bad); }), at + "stiffness must be between 0 and 1");
    EXPECT_EQ(refused([&](proto::Material& m) { m.set_static_friction(bad); }), at + "staticFriction" + range);
    EXPECT_EQ(refused([&](proto::Material& m) { m.set_dynamic_friction(bad); }), at + "dynamicFriction" + range);
    EXPECT_EQ(refused([&](proto::Material& m) { m.set_viscosity_ns_m(bad); }), at + "viscosityNsM" + range);
    EXPECT_EQ(refused([&](proto::Material& m) { m.set_stribeck_m_s(bad); }), at + "stribeckMS" + range);
    EXPECT_EQ(refused([&](proto::Material& m) { m.set_presliding_n_m(bad); }), at + "preslidingNM" + range);
  }
}

}  // namespace
}  // namespace hl
