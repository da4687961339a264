// Frames: what a flush sends, when it waits, how large meshes go ahead, and what the server's answers do.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "client/fake_server.h"
#include "client/outbox.h"

namespace hl::client::test_frames {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
void expectError(HLenum error) { EXPECT_EQ(hlGetError(), error); }

TEST_F(CallsTest, EmptyFrameIsNotSent) {
  EXPECT_EQ(flushed().number(), 0U);
  hlFinish();
  EXPECT_TRUE(server->received.empty());
}

TEST_F(CallsTest, WhatIsDrawnReplacesTheWorldAndNumbersRise) {
  triangle();
  EXPECT_EQ(flushed().number(), 1U);
  triangle();
  triangle(5);
  const proto::Frame second = flushed();
  EXPECT_EQ(second.number(), 2U);
  EXPECT_EQ(second.world().items(0).primitives().triangles_size(), 6);
}

TEST_F(CallsTest, ACancelledFrameHasNotBeen) {
  const auto define = [&](HLuint object, int triangles) {
    hlNewObject(object);
    for (int i = 0; i < triangles; ++i) triangle(i);
    hlEndObject();
  };
  const HLuint image = 1, later = 2, one = 1;
  hlBindTexture(HL_TEXTURE_2D, image);
  hlTexImage2D(HL_TEXTURE_2D, 0, HL_LUMINANCE, 1, 1, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE, "a");
  define(1, 1);
  flushed();
  triangle();
  define(1, 3);
  define(2, 1);
  hlDeleteObjects(1, &one);
  hlDeleteTextures(1, &image);
  hlBindTexture(HL_TEXTURE_2D, later);
  hlTexImage2D(HL_TEXTURE_2D, 0, HL_LUMINANCE, 1, 1, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE, "b");
  hlNewObject(3);
  hlBegin(HL_TRIANGLES);
  hlVertex3d(0, 0, 0);
  hlCancelFrame();
  expectError(HL_NO_ERROR);
  hlEnd();
  expectError(HL_INVALID_OPERATION);
  EXPECT_EQ(integer(HL_CURRENT_OBJECT), 0);
  EXPECT_EQ(integer(HL_TEXTURE_BINDING_2D), 0);
  EXPECT_EQ(hlIsTexture(image), HL_TRUE);
  EXPECT_EQ(hlIsTexture(later), HL_FALSE);
  EXPECT_EQ(hlIsObject(1), HL_TRUE);
  EXPECT_EQ(hlIsObject(2), HL_FALSE);
  EXPECT_EQ(hlIsObject(3), HL_FALSE);
  hlFinish();
  EXPECT_EQ(server->frames().size(), 1U);
  const std::array<HLdouble, 3> moved{};
  hlUpdateVertices(1, 2, 1, moved.data(), nullptr);  // it has three vertices again
  expectError(HL_NO_ERROR);
  hlUpdateVertices(1, 3, 1, moved.data(), nullptr);
  expectError(HL_INVALID_VALUE);
  const proto::Frame next = flushed();
  EXPECT_FALSE(next.has_world());
  EXPECT_EQ(next.objects_size() + next.deleted_objects_size() + next.textures_size() + next.deleted_textures_size(), 0);
}

TEST_F(CallsTest, HeightFieldsAreSentWithTheirSamples) {
  const std::array<HLshort, 6> small{1, 2, 3, 4, 5, -9};
  const HLdouble missing = -9;
  hlScaled(0.5, 1, 0.5);
  hlHeightField(3, 2, HL_SHORT, small.data(), &missing);
  const proto::Frame frame = flushed();
  const proto::Heights& heights = frame.world().items(0).primitives().heights();
  EXPECT_EQ(frame.world().items(0).matrix(0), 0.5);
  EXPECT_EQ(heights.columns(), 3U);
  EXPECT_EQ(heights.rows(), 2U);
  EXPECT_EQ(heights.kind(), "int16");
  EXPECT_EQ(heights.missing(), -9);
  EXPECT_EQ(heights.samples(0), std::string(reinterpret_cast<const char*>(small.data()), sizeof small));
}

TEST_F(CallsTest, TheTextureMatrixScalesTheTexturesOfHeights) {
  const std::array<HLfloat, 4> samples{};
  const auto draw = [&] { hlHeightField(2, 2, HL_FLOAT, samples.data(), nullptr); };
  HLuint texture = 0;
  hlGenTextures(1, &texture);
  hlBindTexture(HL_TEXTURE_2D, texture);
  hlTexImage2D(HL_TEXTURE_2D, 0, HL_LUMINANCE, 1, 1, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE, "a");
  hlMatrixMode(HL_TEXTURE);
  hlTranslated(0.5, 0, 0);
  draw();
  hlEnable(HL_TEXTURE_2D);
  draw();
  expectError(HL_INVALID_OPERATION);
  hlLoadIdentity();
  hlScaled(5, 1, 1);
  draw();
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.world().items_size(), 2) << "the one that was refused is left out";
  EXPECT_FALSE(frame.world().items(0).material().has_repeat_u()) << "it has no texture";
  const proto::Material& material = frame.world().items(1).material();
  EXPECT_EQ(material.repeat_u(), 5);
  EXPECT_FALSE(material.has_repeat_v());
  EXPECT_EQ(material.textures_size(), 1);
}

TEST_F(CallsTest, LargeHeightFieldsGoAheadInParts) {
  std::vector<HLfloat> large(1000 * 1000);
  for (std::size_t i = 0; i < large.size(); ++i) large[i] = static_cast<HLfloat>(i);
  hlHeightField(1000, 1000, HL_FLOAT, large.data(), nullptr);
  triangle();
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.world().items_size(), 2);
  const proto::Heights heights = server->uploads().at(frame.world().items(0).upload()).heights();
  EXPECT_EQ(heights.columns(), 1000U);
  EXPECT_GT(heights.samples_size(), 1);
  std::string joined;
  for (const std::string& piece : heights.samples()) joined += piece;
  EXPECT_EQ(joined, std::string(reinterpret_cast<const char*>(large.data()), sizeof(HLfloat) * large.size()));
}

TEST_F(CallsTest, HeightFieldsThatMakeNoSenseAreRefused) {
  const std::array<HLfloat, 4> samples{};
  hlHeightField(1, 4, HL_FLOAT, samples.data(), nullptr);
  expectError(HL_INVALID_VALUE);
  hlHeightField(2, 2, HL_FLOAT, nullptr, nullptr);
  expectError(HL_INVALID_VALUE);
  hlHeightField(2, 2, HL_DOUBLE, samples.data(), nullptr);
  expectError(HL_INVALID_ENUM);
  hlHeightField(2, 2, HL_FLOAT, samples.data(), &kNaN);
  expectError(HL_INVALID_VALUE);
  hlHeightField(1 << 20, 1 << 20, HL_FLOAT, samples.data(), nullptr);
  expectError(HL_OUT_OF_MEMORY);
  EXPECT_EQ(flushed().number(), 0U);
}

TEST_F(CallsTest, SurfacesOfAVolumeShareItsSamples) {
  const std::array<HLushort, 12> samples{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const HLdouble missing = 9;
  hlScaled(0.5, 1, 0.5);
  hlVolume(3, 2, 2, HL_UNSIGNED_SHORT, samples.data(), &missing, 2.5);
  triangle();
  hlMateriald(HL_STIFFNESS, 0.5);
  hlVolumeSolid(HL_BELOW);
  hlVolumeSurface(6.5);
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.world().items_size(), 3);
  const proto::Item &first = frame.world().items(0), &second = frame.world().items(2);
  EXPECT_EQ(first.upload(), second.upload());
  EXPECT_EQ(first.iso(), 2.5);
  EXPECT_EQ(second.iso(), 6.5);
  EXPECT_FALSE(first.below());
  EXPECT_TRUE(second.below());
  EXPECT_EQ(second.matrix(0), 0.5);
  EXPECT_EQ(second.material().stiffness(), 0.5);
  ASSERT_EQ(server->uploads().size(), 1U);
  const proto::Volume volume = server->uploads().at(first.upload()).volume();
  EXPECT_EQ((std::vector<std::uint32_t>{volume.size().begin(), volume.size().end()}),
            (std::vector<std::uint32_t>{3, 2, 2}));
  EXPECT_EQ(volume.kind(), "uint16");
  EXPECT_EQ(volume.missing(), 9);
  EXPECT_EQ(volume.samples(0), std::string(reinterpret_cast<const char*>(samples.data()), sizeof samples));
}

TEST_F(CallsTest, AnotherIsoValueIsSentAlone) {
  const std::array<HLushort, 8> samples{1, 2, 3, 4, 5, 6, 7, 8};
  hlNewObject(3);
  triangle();
  hlVolume(2, 2, 2, HL_UNSIGNED_SHORT, samples.data(), nullptr, 2.5);
  hlVolumeSurface(3.5);
  hlEndObject();
  flushed();
  hlVolumeIso(3, 1, 4.5);
  hlVolumeIso(3, 1, 5.5);
  const proto::Frame frame = flushed();
  EXPECT_EQ(frame.objects_size(), 0);
  ASSERT_EQ(frame.isos_size(), 1) << "the last one counts";
  EXPECT_EQ(frame.isos(0).object(), 3U);
  EXPECT_EQ(frame.isos(0).item(), 2U) << "after the triangle and the first surface";
  EXPECT_EQ(frame.isos(0).value(), 5.5);
  EXPECT_FALSE(frame.isos(0).has_below());
  hlVolumeIso(3, 0, 6.5);
  const HLuint object = 3;
  hlDeleteObjects(1, &object);
  EXPECT_EQ(flushed().isos_size(), 0);
}

TEST_F(CallsTest, IsoValuesOfWhatIsNotThereAreRefused) {
  hlNewObject(3);
  triangle();
  hlEndObject();
  for (const auto& [object, surface, iso] :
       {std::tuple<HLuint, HLint, HLdouble>{3, 0, 1}, {4, 0, 1}, {3, -1, 1}, {3, 0, kNaN}}) {
    hlVolumeIso(object, surface, iso);
    expectError(HL_INVALID_VALUE);
  }
  hlNewObject(4);
  hlVolumeIso(3, 0, 1);
  expectError(HL_INVALID_OPERATION);
  hlEndObject();
}

TEST_F(CallsTest, ADepthFrameIsAHeightFieldWithACamera) {
  const std::array<HLushort, 6> depths{500, 501, 502, 503, 504, 505};
  const std::array<HLdouble, 4> camera{525, 526, 319.5, 239.5};
  hlDepthFrame(3, 2, depths.data(), camera.data(), 0.001, 0.05, 0.25);
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.world().items_size(), 1);
  const proto::Heights& sent = frame.world().items(0).primitives().heights();
  EXPECT_EQ(sent.columns(), 3U);
  EXPECT_EQ(sent.rows(), 2U);
  EXPECT_EQ(sent.kind(), "uint16");
  EXPECT_EQ(sent.vertical_scale(), 0.001);
  EXPECT_EQ((std::vector<double>{sent.camera().begin(), sent.camera().end()}),
            (std::vector<double>{525, 526, 319.5, 239.5}));
  EXPECT_EQ(sent.join(), 0.05);
  EXPECT_EQ(sent.smoothing(), 0.25);
}

TEST_F(CallsTest, DepthFramesThatMakeNoSenseAreRefused) {
  const std::array<HLushort, 4> depths{};
  const std::array<HLdouble, 4> camera{525, 525, 0, 0}, none{0, 1, 0, 0}, nan{1, 1, kNaN, 0};
  hlDepthFrame(1, 4, depths.data(), camera.data(), 1, 0, 0);
  expectError(HL_INVALID_VALUE);
  hlDepthFrame(2, 2, nullptr, camera.data(), 1, 0, 0);
  expectError(HL_INVALID_VALUE);
  hlDepthFrame(2, 2, depths.data(), nullptr, 1, 0, 0);
  expectError(HL_INVALID_VALUE);
  hlDepthFrame(2, 2, depths.data(), none.data(), 1, 0, 0);
  expectError(HL_INVALID_VALUE);
  hlDepthFrame(2, 2, depths.data(), nan.data(), 1, 0, 0);
  expectError(HL_INVALID_VALUE);
  for (const double wrong : {-1.0, 2.0, kNaN}) {
    hlDepthFrame(2, 2, depths.data(), camera.data(), 1, wrong, 0);
    expectError(HL_INVALID_VALUE);
    hlDepthFrame(2, 2, depths.data(), camera.data(), 1, 0, wrong);
    expectError(HL_INVALID_VALUE);
  }
  hlDepthFrame(2, 2, depths.data(), camera.data(), 0, 0, 0);
  expectError(HL_INVALID_VALUE);
  EXPECT_EQ(flushed().world().items_size(), 0);
}

TEST_F(CallsTest, MatterIsOfTheVolumesThatAreDrawnNext) {
  const std::array<HLushort, 8> samples{1, 2, 3, 4, 5, 6, 7, 8};
  const std::array<HLdouble, 6> matter{-5, 0, 0, 40, 0.2, 5};
  hlVolume(2, 2, 2, HL_UNSIGNED_SHORT, samples.data(), nullptr, 2.5);
  hlVolumeMatter(2, matter.data());
  hlVolume(2, 2, 2, HL_UNSIGNED_SHORT, samples.data(), nullptr, 2.5);
  hlVolumeMatter(0, nullptr);
  hlVolume(2, 2, 2, HL_UNSIGNED_SHORT, samples.data(), nullptr, 2.5);
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.world().items_size(), 3);
  const auto volume = [&](int item) { return server->uploads().at(frame.world().items(item).upload()).volume(); };
  EXPECT_EQ(volume(0).matter_size() + volume(2).matter_size(), 0);
  ASSERT_EQ(volume(1).matter_size(), 2);
  EXPECT_EQ(volume(1).matter(1).value(), 40);
  EXPECT_EQ(volume(1).matter(1).resistance_n(), 0.2);
  EXPECT_EQ(volume(1).matter(1).drag_ns_m(), 5);
}

TEST_F(CallsTest, MatterThatMakesNoSenseIsRefused) {
  const std::array<std::array<HLdouble, 6>, 5> wrong{
      {{1, 0, 0, 1, 0, 0}, {kNaN, 0, 0, 1, 0, 0}, {1, -1, 0, 2, 0, 0}, {1, 0, 2e9, 2, 0, 0}, {1, 0, 0, 2, 0, kNaN}}};
  for (const auto& numbers : wrong) {
    hlVolumeMatter(2, numbers.data());
    expectError(HL_INVALID_VALUE);
  }
  hlVolumeMatter(257, wrong[0].data());
  expectError(HL_INVALID_VALUE);
  hlVolumeMatter(-1, wrong[0].data());
  expectError(HL_INVALID_VALUE);
  hlVolumeMatter(1, nullptr);
  expectError(HL_INVALID_VALUE);
}

TEST_F(CallsTest, SurfacesOneAfterTheOtherAreOneItem) {
  const std::array<HLdouble, 12> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1};
  std::array<HLdouble, 32> weighted{};  // with room between the rows
  for (std::size_t i = 0; i < 6; ++i) {
    HLdouble* const p = &weighted[i / 3 * 16 + i % 3 * 4];
    const HLdouble w = i % 3 == 1 ? 0.5 : 1;
    p[0] = w * static_cast<HLdouble>(i % 3), p[1] = w * static_cast<HLdouble>(i / 3), p[3] = w;
  }
  const std::array<HLdouble, 6> knots{0, 0, 0, 2, 2, 2};
  hlNurbsSurface(0, nullptr, 0, nullptr, 3, 6, square.data(), 2, 2, HL_MAP2_VERTEX_3, 1e-5);
  hlNurbsSurface(6, knots.data(), 0, nullptr, 4, 16, weighted.data(), 3, 2, HL_MAP2_VERTEX_4, 1e-5);
  triangle();
  hlNurbsSurface(0, nullptr, 0, nullptr, 3, 6, square.data(), 2, 2, HL_MAP2_VERTEX_3, 0);
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.world().items_size(), 3);
  const proto::Primitives& both = frame.world().items(0).primitives();
  ASSERT_EQ(both.patches_size(), 2);
  EXPECT_EQ(both.patch_error(), 1e-5);
  const proto::Patch& second = both.patches(1);
  EXPECT_EQ(second.order_u(), 3U);
  EXPECT_EQ((std::vector<double>{second.points().begin() + 3, second.points().begin() + 6}),
            (std::vector<double>{1, 0, 0}));
  EXPECT_EQ((std::vector<double>{second.weights().begin(), second.weights().end()}),
            (std::vector<double>{1, 0.5, 1, 1, 0.5, 1}));
  EXPECT_EQ(second.knots_u_size(), 6);
  EXPECT_EQ(frame.world().items(2).primitives().patches_size(), 1);
  for (int i = 0; i < 10'000; ++i)
    hlNurbsSurface(0, nullptr, 0, nullptr, 3, 6, square.data(), 2, 2, HL_MAP2_VERTEX_3, 0);
  EXPECT_TRUE(flushed().world().items(0).has_upload());
}

TEST_F(CallsTest, SurfacesThatMakeNoSenseAreRefused) {
  std::array<HLdouble, 16> points{0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, 1, 1, 0, 1};
  const auto surface = [&](HLint order, HLint stride, HLenum type, HLdouble error) {
    hlNurbsSurface(0, nullptr, 0, nullptr, stride, 8, points.data(), order, 2, type, error);
  };
  surface(1, 4, HL_MAP2_VERTEX_4, 0);
  expectError(HL_INVALID_VALUE);
  surface(2, 3, HL_MAP2_VERTEX_4, 0);
  expectError(HL_INVALID_VALUE);
  surface(2, 4, HL_FLOAT, 0);
  expectError(HL_INVALID_ENUM);
  surface(2, 4, HL_MAP2_VERTEX_4, kNaN);
  expectError(HL_INVALID_VALUE);
  points[7] = 0;
  surface(2, 4, HL_MAP2_VERTEX_4, 0);
  expectError(HL_INVALID_VALUE);
  hlNurbsSurface(0, nullptr, 0, nullptr, 3, 6, nullptr, 2, 2, HL_MAP2_VERTEX_3, 0);
  expectError(HL_INVALID_VALUE);
  hlNurbsSurface(5, nullptr, 0, nullptr, 3, 6, points.data(), 2, 2, HL_MAP2_VERTEX_3, 0);
  expectError(HL_INVALID_VALUE);
  EXPECT_EQ(flushed().number(), 0U);
}

TEST_F(CallsTest, ACloudIsSentInPiecesOrInTheFrame) {
  const std::vector<HLdouble> points(3 * 50'000, 0.5), normals(3 * 50'000, 1);
  hlPointCloud(2, points.data(), nullptr, 0);
  hlPointCloud(50'000, points.data(), normals.data(), 0.75);
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.world().items_size(), 2);
  const proto::Cloud& small = frame.world().items(0).primitives().cloud();
  EXPECT_EQ(small.positions_size(), 6);
  EXPECT_EQ(small.normals_size(), 0);
  EXPECT_FALSE(small.surfels());
  const proto::Cloud large = server->uploads().at(frame.world().items(1).upload()).cloud();
  EXPECT_EQ(large.positions_size(), 150'000);
  EXPECT_EQ(large.normals_size(), 150'000);
  EXPECT_EQ(large.reach(), 0.75);
}

TEST_F(CallsTest, ColoursAreOfTheCloudThatWasDrawnLast) {
  const std::vector<HLdouble> points(3 * 50'000, 0.5);
  std::vector<HLubyte> colors(3 * 50'000);
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = static_cast<HLubyte>(i);
  hlPointColors(1, colors.data());
  expectError(HL_INVALID_OPERATION);
  hlPointCloud(2, points.data(), nullptr, 0);
  hlPointColors(3, colors.data());
  expectError(HL_INVALID_VALUE);
  hlPointColors(2, nullptr);
  expectError(HL_INVALID_VALUE);
  hlPointColors(2, colors.data() + 250);
  triangle();
  hlPointCloud(50'000, points.data(), nullptr, 0);
  hlPointColors(50'000, colors.data());
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.world().items_size(), 3);
  const proto::Cloud& small = frame.world().items(0).primitives().cloud();
  EXPECT_EQ((std::vector<unsigned>{small.colours().begin(), small.colours().end()}),
            (std::vector<unsigned>{250, 251, 252, 253, 254, 255}));
  const proto::Cloud large = server->uploads().at(frame.world().items(2).upload()).cloud();
  ASSERT_EQ(large.colours_size(), 150'000);
  for (int i = 0; i < large.colours_size(); i += 777) EXPECT_EQ(large.colours(i), static_cast<unsigned>(i) % 256);
}

TEST_F(CallsTest, CloudsThatMakeNoSenseAreRefused) {
  std::array<HLdouble, 3> point{1, 2, 3};
  hlPointCloud(0, point.data(), nullptr, 0);
  expectError(HL_INVALID_VALUE);
  hlPointCloud(1, nullptr, nullptr, 0);
  expectError(HL_INVALID_VALUE);
  hlPointCloud(1, point.data(), nullptr, 11);
  expectError(HL_INVALID_VALUE);
  hlPointCloud(1, point.data(), nullptr, kNaN);
  expectError(HL_INVALID_VALUE);
  hlPointCloud(100'000'000, point.data(), nullptr, 0);
  expectError(HL_OUT_OF_MEMORY);
  point[1] = kNaN;
  hlPointCloud(1, point.data(), nullptr, 0);
  expectError(HL_INVALID_VALUE);
  EXPECT_FALSE(flushed().has_world());
}

TEST_F(CallsTest, ImplicitSurfacesGoAsTheyAreWritten) {
  hlTranslated(1, 2, 3);
  hlImplicit(R"({"expression": {"union": {"of": [{"sphere": {"radius": 0.5}}], "smooth": 0.25}}, "error": 1e-5})");
  triangle();
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.world().items_size(), 2);
  const proto::Implicit& implicit = frame.world().items(0).primitives().implicit();
  EXPECT_EQ(implicit.expression().union_().of(0).sphere().radius(), 0.5);
  EXPECT_EQ(implicit.expression().union_().smooth(), 0.25);
  EXPECT_EQ(implicit.error(), 1e-5);
  hlImplicit(nullptr);
  expectError(HL_INVALID_VALUE);
  hlImplicit("{\"expression\": {\"ball\": {}}}");
  expectError(HL_INVALID_VALUE);
}

TEST_F(CallsTest, VolumesThatMakeNoSenseAreRefused) {
  const std::array<HLfloat, 8> samples{};
  hlVolumeSolid(HL_FLAT);
  expectError(HL_INVALID_ENUM);
  hlVolume(1, 2, 2, HL_FLOAT, samples.data(), nullptr, 0);
  expectError(HL_INVALID_VALUE);
  hlVolume(2, 2, 2, HL_FLOAT, nullptr, nullptr, 0);
  expectError(HL_INVALID_VALUE);
  hlVolume(2, 2, 2, HL_DOUBLE, samples.data(), nullptr, 0);
  expectError(HL_INVALID_ENUM);
  hlVolume(2, 2, 2, HL_FLOAT, samples.data(), nullptr, kNaN);
  expectError(HL_INVALID_VALUE);
  hlVolume(2, 2, 2, HL_FLOAT, samples.data(), &kNaN, 0);
  expectError(HL_INVALID_VALUE);
  hlVolume(1 << 20, 1 << 20, 1 << 20, HL_FLOAT, samples.data(), nullptr, 0);
  expectError(HL_OUT_OF_MEMORY);
  hlVolumeSurface(0);
  expectError(HL_INVALID_OPERATION);
  hlVolume(2, 2, 2, HL_FLOAT, samples.data(), nullptr, 0);
  hlVolumeSurface(kNaN);
  expectError(HL_INVALID_VALUE);
  EXPECT_EQ(flushed().world().items_size(), 1);
}

TEST_F(CallsTest, FrameThatDrawsNothingLeavesTheWorld) {
  hlNewObject(1);
  triangle();
  hlEndObject();
  EXPECT_FALSE(flushed().has_world());
}

TEST_F(CallsTest, ClearDropsWhatWasDrawnAndShowsAnEmptyWorld) {
  triangle();
  hlClear();
  const proto::Frame frame = flushed();
  EXPECT_TRUE(frame.has_world());
  EXPECT_EQ(frame.world().items_size(), 0);
}

TEST_F(CallsTest, IntervalIsLeftToTheServerUnlessSet) {
  triangle();
  EXPECT_FALSE(flushed().has_interval_s());
  hlFrameInterval(0);
  triangle();
  EXPECT_TRUE(flushed().has_interval_s());
  hlFrameInterval(0.5);
  EXPECT_EQ(flushed().number(), 0U);
  triangle();
  EXPECT_EQ(flushed().interval_s(), 0.5);
  hlFrameInterval(-1);
  hlFrameInterval(kNaN), expectError(HL_INVALID_VALUE);
  triangle();
  EXPECT_FALSE(flushed().has_interval_s());
}

TEST_F(CallsTest, ShownFramesAreKnown) {
  server->shows_frames = false;
  EXPECT_EQ(number(HL_FRAME_PROGRESS), 1);
  triangle();
  hlFlush();
  EXPECT_EQ(integer(HL_FRAME_SENT), 1);
  EXPECT_EQ(integer(HL_FRAME_SHOWN), 0);
  EXPECT_EQ(number(HL_FRAME_PROGRESS), 0);
  proto::Progress& progress = *server->replies.emplace_back().mutable_progress();
  progress.set_frame(1);
  progress.set_built(0.5);
  hlPoll();
  EXPECT_EQ(number(HL_FRAME_PROGRESS), 0.5);
  proto::FrameShown& shown = *server->replies.emplace_back().mutable_frame_shown();
  shown.set_number(1);
  shown.set_primitives(12);
  shown.add_warnings("3 triangles without area");
  shown.add_warnings("1 zero normal");
  hlPoll();
  EXPECT_EQ(integer(HL_FRAME_SHOWN), 1);
  EXPECT_EQ(number(HL_FRAME_PROGRESS), 1);
  EXPECT_EQ(integer(HL_FRAME_PRIMITIVES), 12);
  EXPECT_STREQ(hlGetString(HL_FRAME_WARNINGS), "3 triangles without area\n1 zero normal");
}

TEST_F(CallsTest, FinishWaitsUntilShown) {
  triangle();
  hlFinish();
  EXPECT_EQ(integer(HL_FRAME_SHOWN), 1);
  EXPECT_EQ(hlFinishTimeout(0), HL_TRUE);
}

TEST_F(CallsTest, FinishWithTimeoutGivesUpWithoutAnError) {
  server->shows_frames = false;
  triangle();
  EXPECT_EQ(hlFinishTimeout(0.001), HL_FALSE);
  expectError(HL_NO_ERROR);
  hlFinishTimeout(-1), expectError(HL_INVALID_VALUE);
  hlFinishTimeout(kNaN), expectError(HL_INVALID_VALUE);
}

TEST_F(CallsTest, RefusedFrameIsAnErrorWithItsReason) {
  server->shows_frames = false;
  triangle();
  hlFlush();
  server->refuse(1, "too many primitives");
  EXPECT_EQ(hlFinishTimeout(10), HL_FALSE);
  EXPECT_STREQ(hlGetString(HL_ERROR_STRING), "refused by the server: frame 1: too many primitives");
  expectError(HL_REFUSED);
  EXPECT_EQ(hlFinishTimeout(10), HL_TRUE);
}

TEST_F(CallsTest, FramesWaitWithoutAnErrorWhileTheServerBuildsMany) {
  server->shows_frames = false;
  for (std::size_t i = 0; i < kMaxUnanswered + 5; ++i) {
    triangle(static_cast<double>(i));
    hlFlush();
  }
  EXPECT_EQ(server->frames().size(), kMaxUnanswered);
  server->show(1);
  hlPoll();
  ASSERT_EQ(server->frames().size(), kMaxUnanswered + 1);
  EXPECT_EQ(server->frames().back().world().items(0).primitives().vertices(0), kMaxUnanswered + 4.0);
}

TEST_F(CallsTest, FrameWaitsWhileTheNetworkIsBusyAndLaterOnesJoinIt) {
  server->queued_bytes = kMaxQueuedBytes + 1;
  hlNewObject(1);
  hlEndObject();
  triangle(1);
  hlFlush();
  expectError(HL_BUSY);
  EXPECT_EQ(integer(HL_FRAME_WAITING), 1);
  triangle(2);
  hlNewObject(2);
  hlEndObject();
  hlFlush();
  expectError(HL_BUSY);
  EXPECT_TRUE(server->received.empty());
  server->queued_bytes = 0;
  hlPoll();
  ASSERT_EQ(server->frames().size(), 1U);
  const proto::Frame frame = server->frames()[0];
  EXPECT_EQ(frame.number(), 1U);
  EXPECT_EQ(frame.objects_size(), 2);
  EXPECT_EQ(frame.world().items(0).primitives().vertices(0), 2);
  EXPECT_EQ(frame.world().items(0).primitives().vertices_size(), 9);
  EXPECT_EQ(integer(HL_FRAME_WAITING), 0);
}

TEST_F(CallsTest, DeletionUndoesADefinitionThatWaits) {
  server->queued_bytes = kMaxQueuedBytes + 1;
  hlNewObject(1);
  hlEndObject();
  hlFlush();
  const HLuint one = 1;
  hlDeleteObjects(1, &one);
  hlFlush();
  expectError(HL_BUSY);
  server->queued_bytes = 0;
  hlFlush();
  ASSERT_EQ(server->frames().size(), 1U);
  EXPECT_EQ(server->frames()[0].objects_size(), 0);
}

// A context whose server takes one frame in an hour.
class SlowFrames : public CallsTest {
 protected:
  SlowFrames() {
    server->welcome.mutable_limits()->set_frames_hz(1.0 / 3600);
    slow = hlCreateContext("fake:");
    hlMakeCurrent(slow);
  }
  ~SlowFrames() override {
    expectError(HL_NO_ERROR);
    hlDestroyContext(slow);
    hlMakeCurrent(context);
  }
  HLcontext* slow = nullptr;
};

TEST_F(SlowFrames, FramesFasterThanTheServerTakesWaitWithoutAnError) {
  triangle();
  EXPECT_EQ(flushed().number(), 1U);
  triangle();
  EXPECT_EQ(flushed().number(), 0U);
  EXPECT_EQ(integer(HL_FRAME_WAITING), 1);
  EXPECT_EQ(hlFinishTimeout(0.001), HL_FALSE);
}

// ---- Large meshes ----

void strip(int vertices) {
  hlBegin(HL_TRIANGLE_STRIP);
  for (int i = 0; i < vertices; ++i) {
    hlNormal3d(0, 0, i + 1);
    hlVertex3d(i, i % 2, 0);
  }
  hlEnd();
}

TEST_F(CallsTest, LargeMeshesGoAheadInPartsThatMergeToTheWhole) {
  constexpr int kVertices = 100'000;
  strip(kVertices);
  const proto::Frame frame = flushed();
  ASSERT_EQ(frame.world().items_size(), 1);
  const proto::Item& item = frame.world().items(0);
  ASSERT_EQ(item.what_case(), proto::Item::kUpload);
  EXPECT_LT(frame.ByteSizeLong(), 1000U);
  EXPECT_TRUE(server->received.back().has_frame());
  EXPECT_GT(server->received.size(), 4U);
  for (const proto::ClientMessage& message : server->received) EXPECT_LE(message.ByteSizeLong(), (1U << 20) + 100);
  const proto::Primitives whole = server->uploads().at(item.upload());
  ASSERT_EQ(whole.vertices_size(), 3 * kVertices);
  ASSERT_EQ(whole.normals_size(), 3 * kVertices);
  ASSERT_EQ(whole.triangles_size(), 3 * (kVertices - 2));
  for (int i = 0; i < kVertices; ++i) {
    ASSERT_EQ(whole.vertices(3 * i), i);
    ASSERT_EQ(whole.normals(3 * i + 2), i + 1);
  }
  EXPECT_EQ(whole.triangles(whole.triangles_size() - 1), kVertices - 1U);
}

TEST_F(CallsTest, ManySmallMeshesDoNotMakeALongFrame) {
  for (HLuint name = 1; name <= 40; ++name) {
    hlLoadName(name);
    strip(2'000);
  }
  const proto::Frame frame = flushed();
  EXPECT_EQ(frame.world().items_size(), 40);
  EXPECT_LE(frame.ByteSizeLong(), 4U << 20);
  EXPECT_FALSE(server->uploads().empty());
}

TEST_F(CallsTest, ManySmallMeshesShareTheMessagesThatGoAhead) {
  constexpr int kMeshes = 3'000, kVertices = 100;
  for (HLuint name = 1; name <= kMeshes; ++name) {
    hlLoadName(name);
    strip(kVertices);
  }
  const proto::Frame frame = flushed();
  std::size_t bytes = 0;
  for (const proto::ClientMessage& message : server->received) {
    if (message.has_frame()) continue;
    EXPECT_LE(message.ByteSizeLong(), 1U << 20);
    bytes += message.ByteSizeLong();
  }
  EXPECT_GT(bytes, 8U << 20);
  EXPECT_LT(server->received.size(), 3 * bytes >> 20);
  const auto uploads = server->uploads();
  ASSERT_EQ(frame.world().items_size(), kMeshes);
  EXPECT_GT(uploads.size(), kMeshes / 2U);
  for (const proto::Item& item : frame.world().items()) {
    const proto::Primitives& mesh = item.has_upload() ? uploads.at(item.upload()) : item.primitives();
    ASSERT_EQ(mesh.vertices_size(), 3 * kVertices) << item.name();
    ASSERT_EQ(mesh.triangles_size(), 3 * (kVertices - 2)) << item.name();
  }
}

// A context whose server takes little.
class SmallServer : public CallsTest {
 protected:
  SmallServer() {
    server->welcome.mutable_limits()->set_message_bytes(2'000);
    server->welcome.mutable_limits()->set_upload_bytes(100'000);
    small = hlCreateContext("fake:");
    hlMakeCurrent(small);
  }
  ~SmallServer() override {
    expectError(HL_NO_ERROR);
    hlDestroyContext(small);
    hlMakeCurrent(context);
  }
  HLcontext* small = nullptr;
};

TEST_F(SmallServer, PartsFitItsMessages) {
  strip(500);
  EXPECT_EQ(flushed().number(), 1U);
  for (const proto::ClientMessage& message : server->received) EXPECT_LE(message.ByteSizeLong(), 2'000U);
}

TEST_F(SmallServer, FrameThatIsTooLargeIsOutOfMemoryAndDropped) {
  for (HLuint name = 1; name <= 500; ++name) {
    hlLoadName(name);
    triangle();
  }
  EXPECT_EQ(flushed().number(), 0U);
  expectError(HL_OUT_OF_MEMORY);
  strip(50'000);
  EXPECT_EQ(flushed().number(), 0U);
  expectError(HL_OUT_OF_MEMORY);
  EXPECT_EQ(integer(HL_FRAME_WAITING), 0);
  EXPECT_TRUE(server->received.empty());
  triangle();
  EXPECT_EQ(flushed().number(), 1U);
}

}  // namespace
}  // namespace hl::client::test_frames
