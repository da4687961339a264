// Frames of a few bytes that ask for more memory than a session may have, and numbers that are none, are refused before
// anything is made of them.
#include "session/decode_frame.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "session/message_forms.h"
#include "session/message_size.h"
#include "surfaces/depth_frame.h"
#include "surfaces/iso_surface.h"
#include "surfaces/point_cloud.h"

namespace hl::test_decode_frame {
namespace {

SceneLimits smallLimits() {
  SceneLimits limits;
  limits.scene_bytes = 18'000;  // eight of the smallest
  limits.texture_bytes = 64 * sizeof(float);
  return limits;
}

std::string refusalOf(const proto::Frame& frame, Uploads uploads = {}, const MemoryBudget& memory = {}) {
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
  EXPECT_EQ(refusalOf(frame), "texture 'c'.procedural.size of 4 is too large: there is room for 12 texels");
}

// A patch of a few bytes that makes millions of triangles.
TEST(DecodeFrame, PatchesAreCountedBeforeTheyAreMade) {
  proto::Frame frame;
  proto::Primitives& primitives = *frame.mutable_world()->add_items()->mutable_primitives();
  proto::Patch& patch = *primitives.add_patches();
  patch.set_order_u(3);
  patch.set_order_v(3);
  for (int i = 0; i < 9; ++i) {
    for (const int number : {i % 3, i == 4 ? 1 : 0, i / 3}) patch.add_points(number);
  }
  primitives.set_patch_error(0.1);
  EXPECT_EQ(refusalOf(frame), "accepted");
  const MemoryBudget memory(1'000'000);
  primitives.set_patch_error(1e-6);
  EXPECT_NE(refusalOf(frame, {}, memory), "accepted");
  primitives.set_patch_error(1e-9);
  EXPECT_NE(refusalOf(frame).find("say a larger patchError"), std::string::npos) << refusalOf(frame);
  primitives.set_patch_error(0.1);
  patch.set_points(4, std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(refusalOf(frame).find("patches[0]: points"), std::string::npos) << refusalOf(frame);
}

TEST(DecodeFrame, HeightFieldsComeAtOnceOrInParts) {
  const auto decoded = [](const proto::Frame& frame, Uploads uploads) {
    return decodeFrame(frame, uploads, SceneLimits{}, {}, [](double) {}).edit.world->at(0).shape;
  };
  proto::Frame frame;
  proto::Heights& heights = *frame.mutable_world()->add_items()->mutable_primitives()->mutable_heights();
  heights.set_columns(3);
  heights.set_rows(2);
  for (int i = 0; i < 6; ++i) heights.add_values(static_cast<float>(i * i));
  const auto whole = decoded(frame, {});
  ASSERT_TRUE(whole->source);
  EXPECT_EQ(whole->count(), 4U);
  EXPECT_EQ(whole->bounds.max, Vec3(1, 25, 0.5));

  frame.mutable_world()->mutable_items(0)->mutable_material()->set_repeat_u(4);
  const auto repeated = decoded(frame, {});
  ASSERT_TRUE(repeated->hasTexcoords());
  const Primitive triangle = repeated->primitive(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 texcoord = repeated->cornerTexcoord(triangle.source, triangle.order[i]);
    EXPECT_EQ(texcoord, Vec2(2 * (triangle.vertex[i].x() + 1), 0.5 - triangle.vertex[i].z()));
  }

  Uploads uploads;
  for (int part = 0; part < 2; ++part) {
    proto::Heights& piece = *uploads[4].emplace_back().mutable_heights();
    if (part == 0) piece = heights;
    piece.clear_values();
    const std::array<std::int16_t, 3> samples{static_cast<std::int16_t>(9 * part * part),
                                              static_cast<std::int16_t>(part == 0 ? 1 : 16),
                                              static_cast<std::int16_t>(part == 0 ? 4 : 25)};
    if (part == 0) piece.set_kind("int16");
    piece.add_samples(samples.data(), sizeof samples);
  }
  proto::Frame later;
  later.mutable_world()->add_items()->set_upload(4);
  const auto joined = decoded(later, uploads);
  for (ElementId id = 0; id < 4; ++id) EXPECT_EQ(joined->source->corners(id), whole->source->corners(id));
}

TEST(DecodeFrame, HeightFieldsThatMakeNoSenseAreRefused) {
  const auto with = [](auto set) {
    proto::Frame frame;
    proto::Primitives& primitives = *frame.mutable_world()->add_items()->mutable_primitives();
    proto::Heights& heights = *primitives.mutable_heights();
    heights.set_columns(2);
    heights.set_rows(2);
    for (const float value : {0.F, 1.F, 2.F, 3.F}) heights.add_values(value);
    set(heights, primitives);
    return refusalOf(frame);
  };
  const std::string where = "world.items[0].primitives.heights: ";
  EXPECT_EQ(with([](auto&, auto&) {}), "accepted");
  EXPECT_EQ(with([](auto& in, auto&) { in.set_rows(3); }), where + "it has fewer samples than it says");
  EXPECT_EQ(with([](auto& in, auto&) {
              in.set_columns(1 << 29);
              in.set_rows(1 << 29);
            }),
            where + "it has fewer samples than it says");
  EXPECT_EQ(with([](auto& in, auto&) { in.add_values(1); }), where + "it has more samples than it says");
  EXPECT_EQ(with([](auto& in, auto&) { in.set_columns(1); }),
            where + "a height field of 1 x 2 samples: each side must have 2 to 1073741824");
  EXPECT_EQ(with([](auto& in, auto&) { in.set_kind("int8"); }), where + "kind must be int16, uint16 or float32");
  EXPECT_EQ(with([](auto& in, auto&) { in.set_file("a.tif"); }),
            where + "a file of heights is named in scene files only");
  EXPECT_EQ(with([](auto& in, auto&) { in.set_spacing(-1); }), where + "spacing must be from 1e-12 to 1e9");
  EXPECT_EQ(with([](auto& in, auto&) { in.set_vertical_scale(std::numeric_limits<double>::quiet_NaN()); }),
            where + "verticalScale must be from 1e-12 to 1e9");
  EXPECT_EQ(
      with([](auto& in, auto&) { in.set_values(2, std::numeric_limits<float>::quiet_NaN()); }),
      where +
          "its samples are missing, are no finite numbers (of 32 bits), or lack neighbours: there is nothing to touch");
  EXPECT_EQ(
      with([](auto&, auto& in) { in.add_vertices(1); }),
      "world.items[0].primitives: heights, volumes, clouds and implicit surfaces come without vertices and elements");
}

proto::Frame depthFrame(const std::vector<float>& depths, double smoothing) {
  proto::Frame frame;
  proto::Item& item = *frame.add_objects()->add_items();
  frame.mutable_objects(0)->set_id(5);
  proto::Heights& heights = *item.mutable_primitives()->mutable_heights();
  heights.set_columns(2);
  heights.set_rows(2);
  heights.mutable_values()->Add(depths.begin(), depths.end());
  for (const double number : {100.0, 100.0, 0.5, 0.5}) heights.add_camera(number);
  heights.set_vertical_scale(0.001);
  heights.set_smoothing(smoothing);
  return frame;
}

// Smoothed with what the object showed before.
TEST(DecodeFrame, ADepthImageFollowsTheOneBefore) {
  const auto image = [](const SceneItems& items) -> const DepthImage& {
    return dynamic_cast<const DepthFrame&>(*items[0].shape->source).image();
  };
  const MemoryBudget memory(std::uint64_t{1} << 30);
  const auto decoded = [&](const std::vector<float>& depths, const ItemsBefore& before) {
    Uploads uploads;
    return decodeFrame(
        depthFrame(depths, 0.5), uploads, SceneLimits(), memory, [](double) {}, before);
  };
  const DecodedFrame first = decoded({1000, 1000, 1000, 1000}, {});
  const std::shared_ptr<const SceneItems> before = first.edit.objects.at(5);
  EXPECT_NEAR(image(*before).pixels.at(0, 0), 1, 1e-6);
  EXPECT_EQ((*before)[0].shape->source->triangles(), 2U);
  const DecodedFrame second = decoded({1010, 1000, 0, 2000}, [&](std::uint32_t) { return before.get(); });
  const DepthImage& now = image(*second.edit.objects.at(5));
  EXPECT_NEAR(now.pixels.at(0, 0), 1.005, 1e-6);
  EXPECT_NEAR(now.pixels.at(0, 1), 1, 1e-6) << "held";
  EXPECT_NEAR(now.pixels.at(1, 1), 2, 1e-6);
}

TEST(DecodeFrame, DepthImagesThatMakeNoSenseAreRefused) {
  const auto with = [](const std::function<void(proto::Heights&)>& change) {
    proto::Frame frame = depthFrame({1, 1, 1, 1}, 0);
    change(*frame.mutable_objects(0)->mutable_items(0)->mutable_primitives()->mutable_heights());
    return refusalOf(frame);
  };
  EXPECT_EQ(with([](auto&) {}), "accepted");
  EXPECT_EQ(with([](auto& in) { in.mutable_values()->Set(0, 0); }), "accepted") << "with one triangle";
  EXPECT_EQ(with([](auto& in) {
              for (int i = 0; i < 4; ++i) in.mutable_values()->Set(i, 0);
            }),
            "accepted")
      << "a covered lens";
  const std::string where = "object 5, items[0].primitives.heights: ";
  EXPECT_EQ(
      with([](auto& in) { in.set_camera(0, 0); }),
      where + "a depth camera needs four numbers: focal lengths fx and fy above 0, and its centre cx, cy, in pixels");
  EXPECT_EQ(with([](auto& in) { in.add_camera(1); }),
            where + "a camera has four numbers: focal lengths fx and fy above 0, and its centre cx, cy, in pixels");
  EXPECT_EQ(with([](auto& in) { in.set_spacing(2); }), where + "a depth image has a camera, and no spacing");
  EXPECT_EQ(with([](auto& in) { in.set_join(1.5); }), where + "join must be above 0, and at most 1");
  EXPECT_EQ(with([](auto& in) { in.set_smoothing(1); }), where + "smoothing must be from 0 to less than 1");
  EXPECT_EQ(with([](auto& in) {
              in.clear_camera();
              in.set_join(0.5);
            }),
            where + "join and smoothing are of depth images, which have a camera");
}

// 3 x 2 x 2 samples, whose values are x.
// In parts, as they come.
TEST(DecodeFrame, CloudsBecomeTheirPoints) {
  Uploads uploads;
  for (int part = 0; part < 2; ++part) {
    proto::Cloud& cloud = *uploads[4].emplace_back().mutable_cloud();
    cloud.set_surfels(true);
    for (const double x : {0.0, 1.0 + part, 0.5}) cloud.add_positions(x);
    for (const float n : {0.0F, 1.0F, 0.0F}) cloud.add_normals(n);
    for (const unsigned c : {10U, 20U, 30U}) cloud.add_colours(c + static_cast<unsigned>(part));
  }
  proto::Frame frame;
  frame.mutable_world()->add_items()->set_upload(4);
  MemoryBudget memory(std::uint64_t{1} << 30);
  {
    const DecodedFrame made = decodeFrame(frame, uploads, SceneLimits(), memory, [](double) {}, {});
    const auto& cloud = dynamic_cast<const PointCloud&>(*made.edit.world->at(0).shape->source);
    EXPECT_EQ(cloud.points()->size(), 2U);
    EXPECT_TRUE(cloud.surfels());
    ASSERT_TRUE(cloud.hasColours());
    EXPECT_EQ(cloud.points()->colour(0), (Rgb{10, 20, 30}));
    ASSERT_EQ(cloud.points()->blocks(), 2U);
    EXPECT_EQ(cloud.points()->colour(CloudPoints::kPerBlock), (Rgb{11, 21, 31}));
    EXPECT_LT((cloud.trueNormal(0, {}) - Vec3::UnitY()).norm(), 1e-4);
    EXPECT_GE(memory.used_bytes(), cloud.points()->bytes());
  }
  EXPECT_EQ(memory.used_bytes(), 0U);
}

TEST(DecodeFrame, CloudsThatMakeNoSenseAreRefused) {
  const auto with = [](auto set) {
    proto::Frame frame;
    proto::Primitives& primitives = *frame.mutable_world()->add_items()->mutable_primitives();
    for (const double x : {1.0, 2.0, 3.0}) primitives.mutable_cloud()->add_positions(x);
    set(primitives);
    return refusalOf(frame);
  };
  const std::string where = "world.items[0].primitives.cloud: ";
  EXPECT_EQ(with([](auto&) {}), "accepted");
  EXPECT_EQ(with([](auto& in) { in.mutable_cloud()->add_positions(1); }),
            where + "positions must be three numbers for each point");
  EXPECT_EQ(with([](auto& in) { in.mutable_cloud()->set_positions(1, NAN); }), where + "there are no points in it");
  EXPECT_EQ(with([](auto& in) { in.mutable_cloud()->set_file("a.las"); }),
            where + "a file of a cloud is named in scene files only");
  EXPECT_EQ(
      with([](auto& in) { in.add_points(0); }),
      "world.items[0].primitives: heights, volumes, clouds and implicit surfaces come without vertices and elements");
  EXPECT_EQ(with([](auto& in) { in.mutable_heights(); }),
            "world.items[0].primitives: it has heights, a volume, a cloud or an implicit surface, not several of them");
}

proto::Volume smallVolume() {
  proto::Volume volume;
  for (const std::uint32_t side : {3U, 2U, 2U}) volume.add_size(side);
  for (int i = 0; i < 12; ++i) volume.add_values(static_cast<float>(i % 3));
  return volume;
}

TEST(DecodeFrame, VolumesBecomeTheirSurfaces) {
  Uploads uploads;
  *uploads[4].emplace_back().mutable_volume() = smallVolume();
  proto::Frame frame;
  for (const double iso : {0.5, 1.75}) {
    proto::Item& item = *frame.mutable_world()->add_items();
    item.set_upload(4);
    item.set_iso(iso);
    item.set_below(iso > 1);
  }
  MemoryBudget memory(std::uint64_t{1} << 30);
  {
    const DecodedFrame made = decodeFrame(frame, uploads, SceneLimits(), memory, [](double) {}, {});
    const SceneItems& items = *made.edit.world;
    ASSERT_EQ(items.size(), 2U);
    const auto& first = dynamic_cast<const IsoSurface&>(*items[0].shape->source);
    const auto& second = dynamic_cast<const IsoSurface&>(*items[1].shape->source);
    EXPECT_EQ(first.volume(), second.volume());
    EXPECT_EQ(first.iso().value, 0.5);
    EXPECT_EQ(second.iso().value, 1.75);
    EXPECT_EQ(first.iso().solid, SolidSide::kAbove);
    EXPECT_EQ(second.iso().solid, SolidSide::kBelow);
    EXPECT_EQ(first.frame().origin, Vec3(-1, -0.5, -0.5));
    EXPECT_GT(memory.used_bytes(), first.volume()->bytes());
  }
  EXPECT_EQ(memory.used_bytes(), 0U);
}

TEST(DecodeFrame, AnotherIsoValueKeepsTheSamples) {
  proto::Frame first;
  proto::ObjectDefinition& object = *first.add_objects();
  object.set_id(7);
  for (const double iso : {0.5, 1.75}) {
    proto::Item& item = *object.add_items();
    *item.mutable_primitives()->mutable_volume() = smallVolume();
    item.set_iso(iso);
  }
  Uploads none;
  const DecodedFrame before = decodeFrame(first, none, {}, {}, [](double) {}, {});
  const SceneItems& old = *before.edit.objects.at(7);
  const auto there = [&](std::uint32_t id) { return id == 7 ? &old : nullptr; };
  const auto surfaceOf = [](const SceneItem& item) {
    return dynamic_cast<const IsoSurface*>(item.shape->source.get());
  };
  proto::Frame next;
  proto::IsoUpdate& iso = *next.add_isos();
  iso.set_object(7);
  iso.set_item(1);
  iso.set_value(1.25);
  iso.set_below(true);
  const DecodedFrame after = decodeFrame(
      next, none, {}, {}, [](double) {}, there);
  const SceneItems& items = *after.edit.objects.at(7);
  EXPECT_EQ(items[0].shape, old[0].shape);
  EXPECT_EQ(surfaceOf(items[1])->volume(), surfaceOf(old[1])->volume());
  EXPECT_EQ(surfaceOf(items[1])->iso(), (IsoValue{1.25, SolidSide::kBelow}));
  EXPECT_EQ(surfaceOf(old[1])->iso(), (IsoValue{1.75, SolidSide::kAbove}));
  const auto refusal = [&] {
    try {
      decodeFrame(
          next, none, {}, {}, [](double) {}, there);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  iso.set_value(std::numeric_limits<double>::infinity());
  EXPECT_EQ(refusal(), "isos[0].value must be a finite number");
  iso.set_item(2);
  EXPECT_EQ(refusal(), "isos[0]: item 2 of object 7 is no surface of a volume");
  iso.set_object(8);
  EXPECT_EQ(refusal(), "isos[0]: there is no object 8");
}

TEST(DecodeFrame, ImplicitSurfacesAreWhatTheySay) {
  proto::Frame frame;
  proto::Implicit& implicit = *frame.mutable_world()->add_items()->mutable_primitives()->mutable_implicit();
  implicit.mutable_expression()->mutable_sphere()->set_radius(0.02);
  implicit.mutable_expression()->mutable_translate()->set_y(1);
  Uploads none;
  const DecodedFrame decoded = decodeFrame(frame, none, {}, {}, [](double) {}, {});
  const Shape& shape = *decoded.edit.world->at(0).shape;
  EXPECT_EQ(shape.source->siteOf(Vec3(0, 1, 0)), Site::kMatter);
  EXPECT_LE(shape.source->error_m(), 1.1e-5);
  implicit.mutable_expression()->mutable_sphere()->set_radius(-1);
  EXPECT_EQ(refusalOf(frame), "world.items[0].primitives.implicit: sphere.radius must be from 1e-9 to 1e6");
}

TEST(DecodeFrame, VolumesThatMakeNoSenseAreRefused) {
  const auto with = [](auto set) {
    proto::Frame frame;
    proto::Item& item = *frame.mutable_world()->add_items();
    *item.mutable_primitives()->mutable_volume() = smallVolume();
    set(*item.mutable_primitives()->mutable_volume(), item);
    return refusalOf(frame);
  };
  const std::string where = "world.items[0].primitives.volume: ";
  const std::string size = "size must be three numbers of samples: along x, y and z";
  EXPECT_EQ(with([](auto&, auto&) {}), "accepted") << "a value between the samples is found";
  EXPECT_EQ(with([](auto& in, auto&) { in.set_size(0, 4); }), where + "it has fewer samples than it says");
  EXPECT_EQ(with([](auto& in, auto&) {
              for (int axis = 0; axis < 3; ++axis) in.set_size(axis, 1U << 20);
            }),
            where + "it has fewer samples than it says");
  EXPECT_EQ(with([](auto& in, auto&) { in.add_values(1); }), where + "it has more samples than it says");
  EXPECT_EQ(with([](auto& in, auto&) { in.set_size(1, 1); }),
            where + "a volume needs 2 to 2^20 samples along each axis");
  EXPECT_EQ(with([](auto& in, auto&) { in.mutable_size()->RemoveLast(); }), where + size);
  EXPECT_EQ(with([](auto& in, auto&) { in.set_kind("int8"); }), where + "kind must be int16, uint16 or float32");
  EXPECT_EQ(with([](auto& in, auto&) { in.set_file("a.nii"); }),
            where + "a file of a volume is named in scene files only");
  EXPECT_EQ(with([](auto& in, auto&) { in.add_spacing(-1); }), where + "spacing must be from 1e-12 to 1e9");
  EXPECT_EQ(with([](auto& in, auto&) { in.mutable_spacing()->Resize(2, 1); }),
            where + "spacing must be one length or three: along x, y and z");
  EXPECT_EQ(with([](auto& in, auto&) { in.set_scale(std::numeric_limits<double>::quiet_NaN()); }),
            where + "the scale of a volume's values must be a number that is not 0, and their offset a number");
  EXPECT_EQ(with([](auto& in, auto&) { in.set_iso(3); }),
            where + "there is no surface at iso 3: its values are from 0 to 2");
  EXPECT_EQ(with([](auto&, auto& item) { item.set_iso(std::numeric_limits<double>::quiet_NaN()); }),
            where + "the iso value of a volume must be a number");
  EXPECT_EQ(with([](auto& in, auto&) { in.add_matter()->set_drag_ns_m(std::numeric_limits<double>::infinity()); }),
            where + "matter: drag must be from 0 to 1e9");
  EXPECT_EQ(with([](auto& in, auto&) { in.add_matter()->set_stiffness(1.5); }),
            where + "matter: stiffness must be from 0 to 1");
  EXPECT_EQ(
      with([](auto&, auto& item) { item.mutable_primitives()->add_vertices(1); }),
      "world.items[0].primitives: heights, volumes, clouds and implicit surfaces come without vertices and elements");
  EXPECT_EQ(with([](auto&, auto& item) { item.mutable_primitives()->mutable_heights(); }),
            "world.items[0].primitives: it has heights, a volume, a cloud or an implicit surface, not several of them");
  EXPECT_EQ(with([](auto&, auto& item) {
              item.mutable_primitives()->clear_volume();
              item.set_iso(1);
            }),
            "world.items[0].primitives: iso and below are of volumes, and this is none");
}

TEST(DecodeFrame, CompliancesAreOfObjectsThatAreThere) {
  const auto with = [](auto set) {
    proto::Frame frame;
    frame.add_objects()->set_id(5);
    proto::Compliance& compliance = *frame.add_compliances();
    compliance.set_object(5);
    compliance.set_normal_m_n(0.01);
    set(frame, compliance);
    return refusalOf(frame);
  };
  EXPECT_EQ(with([](auto&, auto&) {}), "accepted");
  EXPECT_EQ(with([](auto&, auto& in) { in.set_object(6); }), "compliances[0]: there is no object 6");
  EXPECT_EQ(with([](auto&, auto& in) { in.set_object(0); }), "compliances[0]: there is no object 0");
  EXPECT_EQ(with([](auto& frame, auto& in) { frame.add_compliances()->CopyFrom(in); }),
            "compliances[1]: object 5 is there twice");
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0, 1e10}) {
    EXPECT_EQ(with([&](auto&, auto& in) { in.set_normal_m_n(bad); }),
              "compliances[0].normalMN must be between 0 and 1e+09");
    EXPECT_EQ(with([&](auto&, auto& in) { in.set_tangential_m_n(bad); }),
              "compliances[0].tangentialMN must be between 0 and 1e+09");
    if (bad == -1.0) continue;
    EXPECT_EQ(with([&](auto&, auto& in) { in.mutable_computed_for_n()->set_z(bad); }),
              "compliances[0].computedForN.z must be between -1e+09 and 1e+09");
  }
}

TEST(DecodeFrame, SnapsAreOfTheirObject) {
  const auto with = [](auto set) {
    proto::Frame frame;
    proto::ObjectDefinition& object = *frame.add_objects();
    object.set_id(5);
    proto::Snap& snap = *object.add_snaps();
    for (const double x : {1, 2, 3}) snap.add_points(x);
    snap.set_capture(0.01);
    snap.set_release_n(2);
    set(snap);
    return frame;
  };
  Uploads uploads;
  const DecodedFrame decoded = decodeFrame(with([](auto&) {}), uploads, smallLimits(), {}, [](double) {});
  ASSERT_TRUE(decoded.edit.objects.at(5)->snaps);
  EXPECT_EQ(*decoded.edit.objects.at(5)->snaps, (SnapList{{"", {Vec3(1, 2, 3)}, {}, 0.01, 2}}));
  const auto refusal = [&](auto set) { return refusalOf(with(set)); };
  EXPECT_EQ(refusal([](auto& snap) { snap.set_capture(0); }),
            "object 5.snaps[0].capture must be between 1e-09 and 1e+09");
  EXPECT_EQ(refusal([](auto& snap) { snap.set_release_n(HUGE_VAL); }),
            "object 5.snaps[0].releaseN must be between 1e-09 and 1e+09");
  EXPECT_EQ(refusal([](auto& snap) { snap.set_points(1, std::nan("")); }),
            "object 5.snaps[0].points must be between -1e+06 and 1e+06");
  EXPECT_EQ(refusal([](auto& snap) { snap.mutable_normal(); }), "object 5.snaps[0].normal must not be zero");
}

TEST(DecodeFrame, FieldsAreOfTheirObject) {
  proto::Frame frame;
  proto::ObjectDefinition& object = *frame.add_objects();
  object.set_id(5);
  proto::Field& field = *object.add_fields();
  for (const double x : {1, 2, 3}) field.add_points(x);
  field.set_reach(0.1);
  field.set_force_n(2);
  Uploads uploads;
  const DecodedFrame decoded = decodeFrame(frame, uploads, smallLimits(), {}, [](double) {});
  ASSERT_TRUE(decoded.edit.objects.at(5)->fields);
  EXPECT_EQ(decoded.edit.objects.at(5)->fields->at(0).force_N, 2);
  field.set_force_n(2000);
  EXPECT_EQ(refusalOf(frame), "object 5.fields[0].forceN must be between 1e-09 and 1000");
}

TEST(DecodeFrame, AnAbsentTangentialComplianceIsThatAlongTheNormal) {
  proto::Frame frame;
  frame.add_objects()->set_id(5);
  frame.add_compliances()->set_object(5);
  frame.mutable_compliances(0)->set_normal_m_n(0.25);
  frame.mutable_compliances(0)->mutable_computed_for_n()->set_y(2);
  Uploads uploads;
  const DecodedFrame decoded = decodeFrame(frame, uploads, smallLimits(), {}, [](double) {});
  EXPECT_EQ(decoded.edit.compliances.at(5), (Compliance{0.25, 0.25, Vec3(0, 2, 0)}));
}

// An upload with no element: each item that refers to it would keep all of its vertices.
TEST(DecodeFrame, VerticesOfUploadsAreCountedForEachItem) {
  Uploads uploads;
  for (int i = 0; i < 12; ++i) uploads[1].emplace_back().add_vertices(i);
  proto::Frame frame;
  for (int i = 0; i < 8; ++i) frame.mutable_world()->add_items()->set_upload(1);
  EXPECT_EQ(refusalOf(frame, uploads), "accepted");
  frame.mutable_world()->add_items()->set_upload(1);
  EXPECT_EQ(refusalOf(frame, uploads),
            "world.items[8].upload: the shapes need more than the 18000 bytes that one client may have");
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

// Four bytes on the wire each.
TEST(DecodeFrame, ItemsAreCountedBeforeTheyAreMadeAndUntilTheyGo) {
  constexpr int kItems = 10'000;
  proto::Frame frame;
  proto::ObjectDefinition& object = *frame.add_objects();
  object.set_id(1);
  for (int i = 0; i < kItems; ++i) object.add_items()->set_call(7);
  const auto no_room = refusalOf(frame, {}, MemoryBudget(sizeof(SceneItem) * kItems));
  EXPECT_NE(no_room.find("there is no room"), std::string::npos) << no_room;
  EXPECT_NE(no_room.find("show less"), std::string::npos) << no_room;
  const MemoryBudget budget(2 * sizeof(SceneItem) * kItems);
  Uploads none;
  {
    const DecodedFrame decoded = decodeFrame(frame, none, smallLimits(), budget, [](double) {});
    EXPECT_GE(budget.used_bytes(), sizeof(SceneItem) * kItems);
  }
  EXPECT_EQ(budget.used_bytes(), 0U);
  EXPECT_LE(sizeof(SceneItem), 64U);
}

TEST(DecodeFrame, SurfacesPlacesNamesAndTexturesAreCounted) {
  proto::Frame frame;
  addTexture(frame, "a", 8);
  for (int i = 0; i < 100; ++i) {
    proto::Item& item = *frame.mutable_world()->add_items();
    item.set_call(7);
    for (int k = 0; k < 16; ++k) item.add_matrix(k % 5 == 0 ? 1 : 0);
    proto::MaterialTexture& use = *item.mutable_material()->add_textures();
    use.set_texture(std::string(200, 'x'));
  }
  const MemoryBudget budget(1'000'000);
  Uploads none;
  const DecodedFrame decoded = decodeFrame(frame, none, smallLimits(), budget, [](double) {});
  EXPECT_GE(budget.used_bytes(),
            64 * sizeof(float) + 100 * (sizeof(SceneItem) + sizeof(Placement) + sizeof(SurfaceChange) + 200));
  frame.mutable_world()->mutable_items(3)->mutable_material()->mutable_textures(0)->set_texture(std::string(300, 'x'));
  EXPECT_EQ(refusalOf(frame), "world.items[3].material.textures[0]: the name of a texture has at most 256 bytes");
}

TEST(DecodeFrame, WarningsHaveAnEnd) {
  proto::Frame frame;
  for (int i = 0; i < 100; ++i) {
    proto::Primitives& line = *frame.mutable_world()->add_items()->mutable_primitives();
    for (const double v : {0., 0., 0.}) line.add_vertices(v);
    for (const std::uint32_t v : {0U, 0U}) line.add_segments(v);
  }
  Uploads none;
  const DecodedFrame decoded = decodeFrame(frame, none, {}, {}, [](double) {});
  EXPECT_EQ(decoded.warnings.size(), 21U);
  EXPECT_EQ(decoded.warnings.back(), "and 80 more lines about what was skipped");
}

// As of scene files; but a texture that is left on over lines is no mistake.
TEST(DecodeFrame, WhatNobodyCouldFeelIsAWarning) {
  proto::Frame frame;
  addTexture(frame, "a", 8);
  for (const bool lines : {false, true}) {
    proto::Item& item = *frame.mutable_world()->add_items();
    item.set_name(5);
    for (const double v : {0., 0., 0., 1., 0., 0., 0., 1., 0.}) item.mutable_primitives()->add_vertices(v);
    auto& list =
        lines ? *item.mutable_primitives()->mutable_segments() : *item.mutable_primitives()->mutable_triangles();
    for (const std::uint32_t v : {0U, 1U, 2U}) {
      if (!lines || v < 2) list.Add(v);
    }
    proto::MaterialTexture& use = *item.mutable_material()->add_textures();
    use.set_texture("a");
    use.set_quantity(proto::VISCOSITY);
  }
  frame.mutable_world()->mutable_items(1)->mutable_material()->set_static_friction(0.1);
  frame.mutable_world()->mutable_items(1)->mutable_material()->set_dynamic_friction(0.2);
  Uploads none;
  const DecodedFrame decoded = decodeFrame(frame, none, {}, {}, [](double) {});
  ASSERT_EQ(decoded.warnings.size(), 2U);
  EXPECT_EQ(decoded.warnings[0],
            "world.items[0], named 5: its viscosity texture 'a' is not felt: there are no texture coordinates");
  EXPECT_EQ(decoded.warnings[1],
            "world.items[1], named 5: its static friction of 0.1 is below its dynamic friction of 0.2, and counts as "
            "that");
}

TEST(DecodeFrame, AnUploadInPartsIsOneMesh) {
  Uploads uploads;
  for (int part = 0; part < 3; ++part) {
    proto::Primitives& p = uploads[1].emplace_back();
    for (int i = 0; i < 3; ++i) p.add_vertices(part == i ? 1 : 0);
    p.add_triangles(static_cast<std::uint32_t>(part));
  }
  proto::Frame frame;
  frame.mutable_world()->add_items()->set_upload(1);
  const DecodedFrame decoded = decodeFrame(frame, uploads, smallLimits(), MemoryBudget(100'000), [](double) {});
  EXPECT_EQ(decoded.edit.world->at(0).shape->primitives.size(), 1U);
}

// What is counted before a message is decoded is at least what it then takes, whatever it is made of.
TEST(MessageSize, IsAtLeastWhatTheMessageTakes) {
  proto::ClientMessage calls, polygons, vertices, textures;
  for (int i = 0; i < 1000; ++i) {
    calls.mutable_frame()->mutable_world()->add_items()->set_call(1);
    polygons.mutable_upload()->mutable_part()->add_polygons();
    for (int k = 0; k < 9; ++k) vertices.mutable_upload()->mutable_part()->add_vertices(k);
    for (int k = 0; k < 9; ++k) vertices.mutable_upload()->mutable_part()->add_triangles(1U << k);
    textures.mutable_frame()->add_textures()->mutable_texels()->set_values("xyz");
    textures.mutable_frame()->add_deleted_textures("some");
  }
  for (const proto::ClientMessage& message : {calls, polygons, vertices, textures}) {
    proto::ClientMessage decoded;
    ASSERT_TRUE(decoded.ParseFromString(message.SerializeAsString()));
    const std::uint64_t counted = bytesToDecode(message.SerializeAsString());
    EXPECT_GE(counted, bytesOfMessage(decoded.SpaceUsedLong())) << message.ShortDebugString().substr(0, 80);
    EXPECT_LE(counted, 4 * decoded.SpaceUsedLong());
  }
}

TEST(MessageSize, AMessageThatHasNoRoomIsKnownByItsOutline) {
  proto::ClientMessage frame, upload, uploads, decoded;
  frame.mutable_frame()->set_number(77);
  for (int i = 0; i < 1000; ++i) frame.mutable_frame()->mutable_world()->add_items()->set_call(1);
  const std::string wire = frame.SerializeAsString();
  EXPECT_EQ(outlineOf(wire).frame().number(), 77U);
  EXPECT_EQ(outlineOf(wire.substr(0, 100)).frame().number(), 77U) << "its beginning will do";
  upload.mutable_upload()->set_id(5);
  EXPECT_EQ(outlineOf(upload.SerializeAsString()).upload().id(), 5U);
  for (const std::uint64_t id : {7U, 8U}) uploads.mutable_uploads()->add_parts()->set_id(id);
  const proto::ClientMessage outline = outlineOf(uploads.SerializeAsString());
  ASSERT_EQ(outline.uploads().parts_size(), 2);
  EXPECT_EQ(outline.uploads().parts(1).id(), 8U);
  const MemoryBudget budget(1000);
  MemoryShare memory(budget);
  const Decoding decoding = decodeMessage(MessageForm::kBinary, wire, decoded, memory);
  EXPECT_EQ(decoding.fault, "");
  EXPECT_NE(decoding.no_room, "");
  EXPECT_EQ(decoded.frame().number(), 77U);
  EXPECT_EQ(decoded.frame().world().items_size(), 0);
}

// ---- What a client is sent
// -------------------------------------------------------------------------------------------

std::vector<std::string> warningsOf(const proto::Frame& frame, const ItemsBefore& before = {}) {
  Uploads none;
  return decodeFrame(
             frame, none, smallLimits(), {}, [](double) {}, before)
      .warnings;
}

// A triangle, and one without extent.
void addTriangles(proto::Item& item) {
  for (const double x : {0, 0, 0, 1, 0, 0, 0, 1, 0}) item.mutable_primitives()->add_vertices(x);
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 0u, 1u}) item.mutable_primitives()->add_triangles(i);
}

TEST(DecodeFrame, WarningsNameObjectsByTheirNumbersAndNames) {
  proto::Frame frame;
  frame.add_objects()->set_id(3);
  proto::ObjectDefinition& object = *frame.add_objects();
  object.set_id(77);
  addTriangles(*object.add_items());
  addTriangles(*object.add_items());
  object.mutable_items(1)->set_name(5);
  addTriangles(*frame.mutable_world()->add_items());
  const std::string what = ": skipped 1 triangles that are degenerate, not finite or beyond 1e9 m";
  EXPECT_EQ(warningsOf(frame),
            (std::vector<std::string>{"object 77, items[0]" + what, "object 77, items[1], named 5" + what,
                                      "world.items[0]" + what}));
}

TEST(DecodeFrame, FaultsNameObjectsByTheirNumbers) {
  proto::Frame frame;
  frame.add_objects()->set_id(3);
  proto::ObjectDefinition& object = *frame.add_objects();
  object.set_id(77);
  object.add_items();
  EXPECT_EQ(refusalOf(frame), "object 77, items[0]: an item needs primitives, an upload or a call");
  object.clear_items();
  addTriangles(*object.add_items());
  object.mutable_items(0)->add_matrix(1);
  EXPECT_EQ(refusalOf(frame), "object 77, items[0].matrix must hold 16 numbers, column by column");
  object.set_id(3);
  object.clear_items();
  EXPECT_EQ(refusalOf(frame), "object 3 is there twice");
}

TEST(DecodeFrame, ACallOfWhatIsNotThereIsReportedAndShown) {
  const SceneItems none;
  const ItemsBefore before = [&](std::uint32_t object) { return object == 6 ? &none : nullptr; };
  proto::Frame frame;
  proto::World& world = *frame.mutable_world();
  for (const std::uint32_t object : {9u, 8u, 6u}) world.add_items()->set_call(object);
  frame.add_objects()->set_id(8);
  frame.mutable_objects(0)->add_items()->set_call(7);
  const std::string what = " to call: nothing can be touched there";
  EXPECT_EQ(warningsOf(frame, before), (std::vector<std::string>{"object 8, items[0]: there is no object 7" + what,
                                                                 "world.items[0]: there is no object 9" + what}));
  frame.add_deleted_objects(6);
  EXPECT_EQ(warningsOf(frame, before).back(), "world.items[2]: there is no object 6" + what);
  frame.add_objects()->set_id(6);
  EXPECT_EQ(warningsOf(frame, before).size(), 2U) << "deleted, and defined anew";
}

TEST(DecodeFrame, ATimeThatIsNoneIsRefused) {
  proto::Frame frame;
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    frame.set_interval_s(bad);
    EXPECT_EQ(refusalOf(frame), "interval_s must not be below 0");
  }
  frame.set_interval_s(0);
  EXPECT_EQ(refusalOf(frame), "accepted");
}

}  // namespace
}  // namespace hl::test_decode_frame
