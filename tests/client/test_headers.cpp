// The public headers: hl.h from C, and the scopes and spans of hl.hpp.
#include <gtest/gtest.h>
#include <hl/hl.hpp>

#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

#include "client/fake_server.h"

extern "C" int useFromC(void);

namespace hl::client::test_headers {
namespace {

TEST(Header, IsC99) { EXPECT_EQ(useFromC(), 0); }

class Cpp : public testing::Test {
 protected:
  Cpp() {
    setLinkOpener("fake", [this](const ServerUrl&) { return std::make_unique<FakeLink>(server); });
  }
  ~Cpp() override { setLinkOpener("fake", {}); }
  proto::Frame flushed() {
    hlFlush();
    check();
    return server->frames().back();
  }
  std::shared_ptr<FakeServer> server = std::make_shared<FakeServer>();
};

TEST_F(Cpp, ContextIsCurrentWhileItLives) {
  {
    Context context("fake:");
    EXPECT_EQ(hlGetCurrentContext(), context.get());
    const Context moved = std::move(context);
    EXPECT_EQ(hlGetCurrentContext(), moved.get());
  }
  EXPECT_EQ(hlGetCurrentContext(), nullptr);
}

TEST_F(Cpp, FailuresAreExceptionsWithCodeAndReason) {
  EXPECT_THROW(Context("nowhere:"), CallError);
  const Context context("fake:");
  check();
  hlBegin(99);
  try {
    check();
    FAIL() << "nothing thrown";
  } catch (const CallError& error) {
    EXPECT_EQ(error.code(), HL_INVALID_ENUM);
    EXPECT_STREQ(error.what(), "hlBegin: the mode must be HL_POINTS .. HL_POLYGON");
  }
  check();
}

TEST_F(Cpp, CheckWithoutAContextThrowsOnce) {
  hlFlush();
  EXPECT_THROW(check(), CallError);
  EXPECT_NO_THROW(check());
}

TEST_F(Cpp, ScopesEndWhatTheyBegan) {
  const Context context("fake:");
  const HLuint object = genObject();
  {
    const ObjectScope definition(object);
    const MatrixScope matrix;
    hlTranslated(1, 0, 0);
    const AttribScope attributes;
    hlMateriald(HL_STIFFNESS, 0.5);
    const NameScope name(3);
    const PrimitiveScope points(HL_POINTS);
    hlVertex3d(1, 2, 3);
  }
  const proto::ObjectDefinition definition = flushed().objects(0);
  EXPECT_EQ(definition.id(), object);
  EXPECT_EQ(definition.items(0).name(), 3U);
  EXPECT_EQ(definition.items(0).matrix(12), 1);
  EXPECT_EQ(definition.items(0).primitives().points_size(), 1);
  EXPECT_GT(genTexture(), 0U);
}

TEST_F(Cpp, ADefinitionThatAnExceptionLeavesDoesNotCount) {
  const Context context("fake:");
  const HLuint object = genObject();
  const auto define = [&](bool fails) {
    const ObjectScope definition(object);
    const NameScope name(fails ? 4 : 3);
    const PrimitiveScope points(HL_POINTS);
    hlVertex3d(1, 2, 3);
    if (fails) throw std::runtime_error("in the definition");
  };
  EXPECT_THROW(define(true), std::runtime_error);
  EXPECT_EQ(hlIsObject(object), HL_FALSE);
  hlClear();
  EXPECT_EQ(flushed().objects_size(), 0);
  define(false);
  EXPECT_THROW(define(true), std::runtime_error);
  EXPECT_EQ(hlIsObject(object), HL_TRUE);
  const proto::Frame frame = flushed();
  EXPECT_EQ(frame.objects_size(), 1);
  EXPECT_EQ(frame.objects(0).items(0).name(), 3U);
  EXPECT_NO_THROW(check());
}

TEST_F(Cpp, SpansDrawWhatTheCallsDraw) {
  const Context context("fake:");
  const std::vector<HLfloat> vertices{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::vector<HLfloat> normals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  const std::array<HLushort, 6> indices{0, 1, 2, 2, 1, 3};
  drawElements(HL_TRIANGLES, VertexArrays<HLfloat>{vertices, normals}, indices);
  const proto::Primitives elements = flushed().world().items(0).primitives();
  EXPECT_EQ(elements.triangles_size(), 6);
  EXPECT_EQ(elements.normals_size(), 12) << "of four vertices";
  drawArrays(HL_TRIANGLE_STRIP, VertexArrays<HLfloat>{vertices});
  EXPECT_EQ(flushed().world().items(0).primitives().triangles_size(), 6);
  // No pointer is left behind.
  EXPECT_EQ(hlIsEnabled(HL_VERTEX_ARRAY), HL_FALSE);
  hlEnableClientState(HL_VERTEX_ARRAY);
  hlDrawArrays(HL_POINTS, 0, 1);
  EXPECT_THROW(check(), CallError);
}

TEST_F(Cpp, SpansMoveVertices) {
  const Context context("fake:");
  const std::vector<HLdouble> vertices{0, 0, 0, 1, 0, 0}, moved{1, 2, 3};
  const HLuint object = genObject();
  {
    const ObjectScope definition(object);
    drawArrays(HL_POINTS, VertexArrays<HLdouble>{vertices, vertices});
  }
  flushed();
  updateVertices(object, 1, moved);
  const proto::Frame frame = flushed();
  EXPECT_EQ(frame.moved(0).first(), 1U);
  EXPECT_EQ(frame.moved(0).primitives().vertices(2), 3);
  EXPECT_EQ(frame.moved(0).primitives().normals_size(), 0);
  updateVertices(object, 0, moved, moved);
  EXPECT_EQ(flushed().moved(0).primitives().normals_size(), 3);
  EXPECT_THROW(updateVertices(object, 0, moved, vertices), std::invalid_argument);
  EXPECT_THROW(updateVertices(object, 0, std::span(vertices).first(4)), std::invalid_argument);
  constexpr std::size_t kTooMany = std::size_t{1} << 32;  // 0 as an HLsizei
  EXPECT_THROW(heightField(kTooMany, std::span<const HLfloat>{}), std::invalid_argument);
  EXPECT_THROW(depthFrame({1, 1, 0, 0}, kTooMany, {}), std::invalid_argument);
  EXPECT_THROW(volume(kTooMany, kTooMany, std::span<const HLfloat>{}, 0), std::invalid_argument);
  check();
}

TEST_F(Cpp, SpansThatDoNotFitAreRefused) {
  const Context context("fake:");
  const std::vector<HLdouble> vertices(6), other(5);
  const std::vector<HLuint> indices{0, 2};
  EXPECT_THROW(drawArrays(HL_POINTS, VertexArrays<HLdouble>{other}), std::invalid_argument);
  EXPECT_THROW(drawArrays(HL_POINTS, VertexArrays<HLdouble>{vertices, other}), std::invalid_argument);
  EXPECT_THROW(drawArrays(HL_POINTS, VertexArrays<HLdouble>{vertices, {}, other}), std::invalid_argument);
  EXPECT_THROW(drawElements(HL_POINTS, VertexArrays<HLdouble>{vertices}, indices), std::invalid_argument);
  check();
}

TEST_F(Cpp, QueriesAndContacts) {
  Context context("fake:");
  proto::ClientState& state = server->sendState();
  state.mutable_proxy()->set_y(2);
  state.add_touched()->set_object(4);
  context.poll();
  EXPECT_EQ(get<3>(HL_PROXY_POSITION)[1], 2);
  EXPECT_EQ(get(HL_CONTACT_COUNT), 1);
  ASSERT_EQ(contacts().size(), 1U);
  EXPECT_EQ(contacts()[0].object, 4U);
}

TEST_F(Cpp, EventFunctionsMayMoveAndThrow) {
  Context first("fake:");
  int touches = 0;
  first.onEvent(HL_EVENT_TOUCH, [&](const HLevent&) {
    if (++touches == 1) throw std::runtime_error("once");
  });
  Context context = std::move(first);
  for (int i = 0; i < 2; ++i) server->replies.emplace_back().mutable_event()->set_kind(proto::TOUCH);
  EXPECT_THROW(context.poll(), std::runtime_error);
  EXPECT_EQ(touches, 2);
  EXPECT_EQ(context.poll(), 0);
  context.onEvent(HL_EVENT_TOUCH, {});
  check();
  context.onEvent(HL_POINTS, {});
  EXPECT_THROW(check(), CallError);
}

}  // namespace
}  // namespace hl::client::test_headers
