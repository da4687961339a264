// Frames of a few bytes that ask for more memory than a session may have are refused before they get it.
#include "server/decode_frame.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace hl
