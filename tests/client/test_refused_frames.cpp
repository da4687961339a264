// Frames that the server refuses: the context's own tables go back with them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "client/fake_server.h"

namespace hl::client::test_refused_frames {
namespace {

constexpr HLuint kObject = 6, kTexture = 4;

void expectError(HLenum error) { EXPECT_EQ(hlGetError(), error); }

class RefusedFrames : public CallsTest {
 protected:
  RefusedFrames() { server->shows_frames = false; }

  /// Flushes and returns the frame's number.
  std::uint64_t sent() {
    hlFlush();
    return server->frames().back().number();
  }
  void shown() { server->show(sent()), hlPoll(); }
  void refuse(std::uint64_t frame) {
    server->refuse(frame, "a fault");
    hlPoll();
    expectError(HL_REFUSED);
  }
  void refused() { refuse(sent()); }
};

void define(int triangles) {
  hlNewObject(kObject);
  for (int i = 0; i < triangles; ++i) triangle(i);
  hlEndObject();
}

void remove(HLuint object = kObject) { hlDeleteObjects(1, &object); }

bool hasVertices(HLsizei count) {
  const std::vector<HLdouble> vertices(3 * static_cast<std::size_t>(count));
  hlUpdateVertices(kObject, 0, count, vertices.data(), nullptr);
  return hlGetError() == HL_NO_ERROR;
}

void drawImage(char texel) {
  hlBindTexture(HL_TEXTURE_2D, kTexture);
  hlTexImage2D(HL_TEXTURE_2D, 0, HL_LUMINANCE, 1, 1, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE, &texel);
}

void drawTextured() {
  hlBindTexture(HL_TEXTURE_2D, kTexture);
  hlEnable(HL_TEXTURE_2D);
  triangle();
  hlDisable(HL_TEXTURE_2D);
}

TEST_F(RefusedFrames, ADeletionHasNotBeen) {
  define(1), shown();
  remove(), refused();
  EXPECT_EQ(hlIsObject(kObject), HL_TRUE);
  remove();
  EXPECT_THAT(flushed().deleted_objects(), testing::ElementsAre(kObject)) << "it can be deleted again";
}

TEST_F(RefusedFrames, ADefinitionHasNotBeen) {
  define(1), refused();
  EXPECT_EQ(hlIsObject(kObject), HL_FALSE);
  hlCallObject(kObject), expectError(HL_INVALID_VALUE);
}

TEST_F(RefusedFrames, AfterARedefinitionTheMeshBeforeCanBeMoved) {
  define(2), shown();
  define(1), refused();
  EXPECT_TRUE(hasVertices(6));
  EXPECT_FALSE(hasVertices(7));
}

TEST_F(RefusedFrames, WhatALaterFrameHasDefinedStays) {
  define(1), shown();
  remove();
  const std::uint64_t first = sent();
  define(2), sent();
  refuse(first);
  EXPECT_TRUE(hasVertices(6));
}

TEST_F(RefusedFrames, WhatTheOpenFrameHasDefinedStaysUntilItIsCancelled) {
  define(2), shown();
  remove();
  const std::uint64_t first = sent();
  define(1);
  refuse(first);
  EXPECT_FALSE(hasVertices(6));
  hlCancelFrame();
  EXPECT_TRUE(hasVertices(6));
}

TEST_F(RefusedFrames, OfSeveralTheTableGoesBackToTheFirst) {
  define(2), shown();
  for (const bool in_order : {true, false}) {
    define(1);
    const std::uint64_t first = sent();
    remove();
    const std::uint64_t second = sent();
    refuse(in_order ? first : second);
    refuse(in_order ? second : first);
    EXPECT_TRUE(hasVertices(6)) << in_order;
    hlCancelFrame();
  }
}

TEST_F(RefusedFrames, AFrameThatWaitsBehindThemKeepsItsOwn) {
  define(2), shown();
  define(1);
  const std::uint64_t first = sent();
  server->queued_bytes = kMaxQueuedBytes + 1;
  remove();
  hlFlush(), expectError(HL_BUSY);
  refuse(first);
  EXPECT_EQ(hlIsObject(kObject), HL_FALSE);
  server->queued_bytes = 0;
  refused();
  EXPECT_TRUE(hasVertices(6));
}

TEST_F(RefusedFrames, AFrameThatIsTooLargeForTheServerHasNotBeenEither) {
  server->welcome.mutable_limits()->set_message_bytes(2'000);
  HLcontext* const small = hlCreateContext("fake:");
  hlMakeCurrent(small);
  define(1), shown();
  remove();
  for (HLuint name = 1; name <= 500; ++name) {
    hlLoadName(name);
    triangle();
  }
  hlFlush(), expectError(HL_OUT_OF_MEMORY);
  EXPECT_EQ(hlIsObject(kObject), HL_TRUE);
  hlMakeCurrent(context);
  hlDestroyContext(small);
}

TEST_F(RefusedFrames, ATextureThatItMadeIsNoneAndIsBoundNoMore) {
  drawImage(1);
  drawTextured();
  refused();
  EXPECT_EQ(hlIsTexture(kTexture), HL_FALSE);
  EXPECT_EQ(integer(HL_TEXTURE_BINDING_2D), 0);
}

TEST_F(RefusedFrames, ATextureHasTheImageThatItHadBefore) {
  drawImage(1), shown();
  drawImage(2), refused();
  hlTexParameteri(HL_TEXTURE_2D, HL_TEXTURE_WRAP, HL_CLAMP);
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.textures_size(), 1);
  EXPECT_EQ(frame.textures(0).texels().values(), std::string(1, 1));
}

TEST_F(RefusedFrames, ATextureThatItRemovedIsRemovedByALaterOne) {
  drawImage(1);
  drawTextured();
  shown();
  const HLuint texture = kTexture;
  hlDeleteTextures(1, &texture);
  define(1), shown();
  EXPECT_EQ(server->frames().back().deleted_textures_size(), 0) << "the world uses it";
  triangle(), refused();
  EXPECT_EQ(server->frames().back().deleted_textures_size(), 1);
  define(1), shown();
  EXPECT_EQ(server->frames().back().deleted_textures_size(), 0) << "the world before uses it again";
  triangle(), shown();
  EXPECT_EQ(server->frames().back().deleted_textures_size(), 1);
}

}  // namespace
}  // namespace hl::client::test_refused_frames
