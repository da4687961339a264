// Recordings: what is written comes back bit for bit, whatever it is; and what a cut or a damage has spared is
// readable.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>

#include "base/error.h"
#include "builtin.h"
#include "fields.h"
#include "io/value_messages.h"
#include "proxy/proxy.h"
#include "record/recorded_scene.h"
#include "record/recorded_servo.h"
#include "record/recording_file.h"
#include "scene/scene_model.h"
#include "surfaces/iso_surface.h"
#include "temp_folder.h"

namespace hl::test_recording {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  std::int64_t integer() { return static_cast<std::int64_t>(engine_()); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  /// Any bits: numbers of every size, infinities, NaNs, zeros of both signs.
  double bits() { return below(8) == 0 ? -0.0 : std::bit_cast<double>(engine_()); }
  Vec3 bits3() { return {bits(), bits(), bits()}; }
  double uniform() { return std::uniform_real_distribution<>(-1, 1)(engine_); }
  Vec3 vec() { return {uniform(), uniform(), uniform()}; }

 private:
  std::mt19937_64 engine_;
};

Stylus randomStylus(Random& random, bool has_gripper) {
  Stylus stylus;
  stylus.turned = Eigen::Quaterniond(random.uniform(), random.uniform(), random.uniform(), random.uniform());
  stylus.turned.normalize();
  stylus.spin_rad_s = random.bits3();
  if (has_gripper) stylus.gripper_rad = random.bits();
  if (has_gripper) stylus.gripper_N = random.bits();
  return stylus;
}

ServoRecord randomRecord(Random& random, const ServoSettings& settings) {
  ServoRecord record;
  record.command = static_cast<ServoCommand>(random.below(5));
  record.settings = settings;
  record.target = {random.bits3(), random.integer(), random.below(2) == 0, random.bits(), random.bits()};
  record.sample.time_ns = random.integer();
  record.sample.position = random.bits3();
  record.sample.buttons = static_cast<std::uint32_t>(random.integer());
  record.sample.status = static_cast<DeviceStatus>(random.below(3));
  record.sample.held = random.below(2) == 0;
  record.out = {random.bits3(), static_cast<SafetyState>(random.below(5)), static_cast<FaultReason>(random.below(11))};
  record.work_ns = random.integer();
  return record;
}

bool sameBits(const Vec3& a, const Vec3& b) { return std::memcmp(a.data(), b.data(), sizeof(double) * 3) == 0; }
bool sameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

void expectSame(const ServoRecord& a, const ServoRecord& b) {
  EXPECT_EQ(a.command, b.command);
  EXPECT_EQ(valuesOf(a.settings), valuesOf(b.settings));
  EXPECT_TRUE(sameBits(a.target.proxy_D, b.target.proxy_D));
  EXPECT_EQ(a.target.time_ns, b.target.time_ns);
  EXPECT_EQ(a.target.valid, b.target.valid);
  EXPECT_TRUE(sameBits(a.target.stiffness, b.target.stiffness));
  EXPECT_TRUE(sameBits(a.target.paid_J, b.target.paid_J));
  EXPECT_EQ(a.sample.time_ns, b.sample.time_ns);
  EXPECT_TRUE(sameBits(a.sample.position, b.sample.position));
  EXPECT_TRUE(sameBits(a.sample.weight_N, b.sample.weight_N));
  EXPECT_EQ(a.sample.age_ns, b.sample.age_ns);
  EXPECT_EQ(a.sample.buttons, b.sample.buttons);
  EXPECT_EQ(a.sample.status, b.sample.status);
  EXPECT_EQ(a.sample.held, b.sample.held);
  EXPECT_EQ(std::memcmp(a.sample.stylus.turned.coeffs().data(), b.sample.stylus.turned.coeffs().data(), 32), 0);
  EXPECT_TRUE(sameBits(a.sample.stylus.spin_rad_s, b.sample.stylus.spin_rad_s));
  EXPECT_TRUE(sameBits(a.sample.stylus.gripper_rad, b.sample.stylus.gripper_rad));
  EXPECT_TRUE(sameBits(a.sample.stylus.gripper_N, b.sample.stylus.gripper_N));
  EXPECT_TRUE(sameBits(a.out.force_N, b.out.force_N));
  EXPECT_EQ(a.out.safety, b.out.safety);
  EXPECT_EQ(a.out.fault, b.out.fault);
  EXPECT_EQ(a.work_ns, b.work_ns);
}

/// Every member of the structure set to something of its own.
template <typename T>
T scrambled(Random& random) {
  T value;
  Values values = valuesOf(value);
  for (double& number : values.numbers) number = random.bits();
  for (std::int64_t& integer : values.integers) integer = random.below(2);
  EXPECT_EQ(setFrom(values, value), Fit::kFits);
  EXPECT_EQ(valuesOf(value), values);
  return value;
}

TEST(RecordedServo, AnyStepsComeBackBitForBit) {
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    std::vector<ServoRecord> records;
    ServoSettings settings = scrambled<ServoSettings>(random);
    for (int i = 0, n = 1 + random.below(200); i < n; ++i) {
      if (random.below(20) == 0) settings = scrambled<ServoSettings>(random);
      records.push_back(randomRecord(random, settings));
      if (round % 2 == 0) records.back().sample.weight_N = random.bits3();
      if (round % 5 != 0) records.back().sample.stylus = randomStylus(random, round % 3 != 0);
      if (round % 3 == 0) records.back().sample.age_ns = random.integer();
    }
    records.front().before = scrambled<ServoState>(random);
    proto::ServoSteps message;
    toProto(records, 77, message);
    proto::ServoSteps parsed;
    ASSERT_TRUE(parsed.ParseFromString(message.SerializeAsString()));
    EXPECT_EQ(parsed.first(), 77u);
    const std::vector<ServoRecord> back = fromProto(parsed);
    ASSERT_EQ(back.size(), records.size());
    for (std::size_t i = 0; i < records.size(); ++i) expectSame(records[i], back[i]);
    EXPECT_EQ(valuesOf(back.front().before), valuesOf(records.front().before));
  }
}

TEST(RecordedServo, EveryNumberOfADeviceComesBack) {
  DeviceInfo info;
  info.servo_rate_Hz = 2000;
  info.servo_rate_max_Hz = 8000;
  info.resolution_m = 3e-5;
  DeviceInfo back;
  EXPECT_EQ(setFrom(valuesOf(info), back), Fit::kFits);
  EXPECT_EQ(back.servo_rate_Hz, 2000);
  EXPECT_EQ(back.servo_rate_max_Hz, 8000);
  EXPECT_EQ(back.resolution_m, 3e-5);
}

TEST(RecordedServo, FlagsThatSayNothingAreRefused) {
  Random random(4);
  proto::ServoSteps good;
  toProto(std::vector<ServoRecord>{randomRecord(random, {})}, 0, good);
  for (const std::uint32_t flags : {3U, 5U << 6, 7U << 6, 11U << 9, 15U << 9, 1U << 13 | 1U << 3, 1U << 14}) {
    proto::ServoSteps bad = good;
    bad.set_flags(0, flags);
    EXPECT_THROW(fromProto(bad), Error) << flags;
  }
}

TEST(RecordedServo, MessagesThatMakeNoSenseAreRefused) {
  Random random(2);
  const std::vector<ServoRecord> records{randomRecord(random, {})};
  proto::ServoSteps good;
  toProto(records, 0, good);
  EXPECT_NO_THROW(fromProto(good));
  EXPECT_THROW(fromProto(proto::ServoSteps{}), Error);
  proto::ServoSteps shorter = good;
  shorter.mutable_position()->RemoveLast();
  EXPECT_THROW(fromProto(shorter), Error);
  proto::ServoSteps other_version = good;
  other_version.mutable_start()->add_numbers(1);
  EXPECT_THROW(fromProto(other_version), Error);
  proto::ServoSteps no_settings = good;
  no_settings.clear_settings();
  EXPECT_THROW(fromProto(no_settings), Error);
  proto::ServoSteps settings_of_no_step = good;
  *settings_of_no_step.add_settings() = good.settings(0);
  EXPECT_THROW(fromProto(settings_of_no_step), Error);
}

/// A soup of shaded, textured, rough triangles with some that are degenerate, a line and a point; and a second object
/// that moves on two screws.
std::shared_ptr<const Snapshot> randomScene(Random& random) {
  Model model;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const Vec3 a = 0.03 * random.vec(), b = a + 0.03 * random.vec(), c = a + 0.03 * random.vec();
    for (const Vec3& p : {a, b, c}) {
      model.positions.push_back(p);
      model.normals.push_back(random.vec());
      model.texcoords.emplace_back(2 * random.uniform(), 2 * random.uniform());
    }
    model.triangles.push_back({3 * i, 3 * i + 1, i % 7 == 0 ? 3 * i : 3 * i + 2});
    model.triangle_materials.push_back(static_cast<std::uint16_t>(i % 2));
  }
  model.segments.push_back({0, 4});
  model.points.push_back(8);
  model.textures = {makeTexture("noise", 16), makeTexture("sine", 8)};
  model.materials.resize(2);
  model.materials[0].smooth = true;
  model.materials[0].dynamic_friction = 0.3;
  model.materials[1].textureOf(Quantity::kStiffness) = {0, 0.3, 1};
  model.materials[1].textureOf(Quantity::kHeight) = {1, 0, 1e-4};
  Instance instance;
  instance.shape = makeShape(std::move(model));
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = 5;
  instance.session = 2;
  instance.object = 3;
  instance.name = 4;
  Instance mover = instance;
  mover.key = 9;
  const auto pose = [&] {
    return Pose{Eigen::AngleAxisd(random.uniform(), random.vec().normalized()).toRotationMatrix(), 0.02 * random.vec()};
  };
  mover.motion = Motion(pose()).then(pose(), 100'000'000, 200'000'000).then(pose(), 150'000'000, 400'000'000);
  return makeSnapshot({mover, instance}, "soup", 12, 33'000'000);
}

std::shared_ptr<const Snapshot> writtenAndRead(const Snapshot& scene, SceneWriter& writer, SceneReader& reader,
                                               int& parts) {
  std::shared_ptr<const Snapshot> back;
  writer.write(scene, [&](const proto::RecordingBlock& written) {
    proto::RecordingBlock block;
    ASSERT_TRUE(block.ParseFromString(written.SerializeAsString()));
    if (block.has_shape()) reader.add(block.shape());
    if (block.has_heights()) reader.add(block.heights());
    if (block.has_volume()) reader.add(block.volume());
    if (block.has_cloud()) reader.add(block.cloud());
    if (block.has_implicit()) reader.add(block.implicit());
    if (block.has_surfaces()) reader.add(block.surfaces());
    if (block.has_scene()) back = reader.scene(block.scene());
    parts += block.has_scene() ? 0 : 1;
  });
  return back;
}

// In two parts, as its samples are more than one takes.
TEST(RecordedScene, HasItsHeightField) {
  SceneModel scene;
  scene.surfaces.push_back({"hills", makeTerrainField(5'000'000)->placed(2 * Mat3::Identity(), Vec3(1, 2, 3))});
  scene.surfaces[0].textures = {makeTexture("noise", 8)};
  scene.surfaces[0].material.textureOf(Quantity::kHeight) = {0, 0, 1e-5};
  scene.surfaces[0].repeat = Vec2(7, 1.0 / 3);
  const auto made = makeSnapshot(std::move(scene));
  SceneWriter writer;
  SceneReader reader;
  int parts = 0;
  const auto back = writtenAndRead(*made, writer, reader, parts);
  ASSERT_TRUE(back);
  EXPECT_EQ(parts, 3);
  const Shape &was = made->shape(), &is = back->shape();
  ASSERT_EQ(is.count(), was.count());
  EXPECT_EQ(is.bounds.min, was.bounds.min);
  EXPECT_EQ(is.repeat, was.repeat);
  ASSERT_TRUE(back->instances[0].label);
  EXPECT_EQ(*back->instances[0].label, (Label{"hills"}));
  EXPECT_EQ(back->instances[0].surfaces->textures.at(0)->texels, made->instances[0].surfaces->textures.at(0)->texels);
  for (ElementId id = 0; id < is.count(); id += 9973) ASSERT_EQ(is.source->corners(id), was.source->corners(id)) << id;
}

TEST(RecordedScene, HasItsDepthImage) {
  const auto made = makeSnapshot(makeBuiltinWorld("depth:table"));
  SceneWriter writer;
  SceneReader reader;
  int parts = 0;
  const auto back = writtenAndRead(*made, writer, reader, parts);
  ASSERT_TRUE(back);
  const Shape &was = made->shape(), &is = back->shape();
  ASSERT_EQ(is.count(), was.count());
  EXPECT_EQ(is.source->triangles(), was.source->triangles());
  EXPECT_EQ(is.bounds.min, was.bounds.min);
  const auto& frame = dynamic_cast<const DepthFrame&>(*is.source);
  for (ElementId id = 0; id < is.count(); id += 997) {
    if (!frame.cells().exists(cellOf(id, 640))) continue;
    ASSERT_EQ(is.source->corners(id), was.source->corners(id)) << id;
  }
}

// The points are written once, for the first of both; the same slots have the same points.
TEST(RecordedScene, HasItsCloudOnce) {
  SceneModel scene = makeBuiltinWorld("points:terrain:40000");
  const auto& plain = *dynamic_cast<const PointCloud&>(*scene.surfaces[0].source).points();
  CloudInput coloured{{}, {}, plain.lattice(), true, true};
  for (std::size_t slot = 0; slot < plain.blocks() * CloudPoints::kPerBlock; ++slot) {
    if (slot % CloudPoints::kPerBlock >= plain.countIn(slot / CloudPoints::kPerBlock)) continue;
    coloured.points.push_back({plain.stepsAt(slot), plain.normal(slot)});
    coloured.colours.push_back({plain.stepsAt(slot), static_cast<std::uint32_t>(slot)});
  }
  scene.surfaces[0].source = std::make_shared<const PointCloud>(makeCloud(std::move(coloured)), CloudLook{});
  scene.surfaces.push_back(scene.surfaces[0]);
  scene.surfaces[1].source = scene.surfaces[1].source->placed(2 * Mat3::Identity(), Vec3(1, 2, 3));
  setSurfels(scene, 0.9);
  const auto made = makeSnapshot(std::move(scene));
  SceneWriter writer;
  SceneReader reader;
  int parts = 0;
  const auto back = writtenAndRead(*made, writer, reader, parts);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->instances.size(), 2U);
  EXPECT_EQ(back->instances[0].shape->shared().of, back->instances[1].shape->shared().of);
  for (std::size_t i = 0; i < 2; ++i) {
    const Shape &was = *made->instances[i].shape, &is = *back->instances[i].shape;
    ASSERT_EQ(is.count(), was.count());
    EXPECT_EQ(is.bounds.min, was.bounds.min);
    for (ElementId id = 0; id < is.count(); id += 7) ASSERT_EQ(is.source->corners(id), was.source->corners(id)) << id;
    const auto& points = *dynamic_cast<const PointCloud&>(*is.source).points();
    ASSERT_TRUE(points.hasColours());
    EXPECT_EQ(packRgb(points.colour(17)), 17U);
  }
}

TEST(RecordedScene, HasItsImplicitSurface) {
  SceneModel scene = makeBuiltinWorld("sdf:bracket");
  scene.surfaces[0].source = scene.surfaces[0].source->placed(2 * Mat3::Identity(), Vec3(1, 2, 3));
  const auto made = makeSnapshot(std::move(scene));
  SceneWriter writer;
  SceneReader reader;
  int parts = 0;
  const auto back = writtenAndRead(*made, writer, reader, parts);
  ASSERT_TRUE(back);
  const PrimitiveSource &was = *made->shape().source, &is = *back->shape().source;
  EXPECT_EQ(is.bounds().min, was.bounds().min);
  int met = 0;
  made->shape().index->overlap(Vec3(1, 2, 3), 0.03, [&](ElementId id) {
    EXPECT_EQ(is.corners(id), was.corners(id));
    ++met;
  });
  EXPECT_GT(met, 10);
}

// The samples are written once, for the first of both surfaces; both are touched as they were.
TEST(RecordedScene, HasItsVolumeOnce) {
  const auto made = makeSnapshot(makeBuiltinWorld("ct:phantom:41"));
  ASSERT_EQ(made->instances.size(), 2U);
  SceneWriter writer;
  SceneReader reader;
  std::size_t samples = 0, volumes = 0;
  std::shared_ptr<const Snapshot> back;
  writer.write(*made, [&](const proto::RecordingBlock& written) {
    proto::RecordingBlock block;
    ASSERT_TRUE(block.ParseFromString(written.SerializeAsString()));
    if (block.has_volume()) {
      ++volumes;
      samples += block.volume().samples().size();
      reader.add(block.volume());
    }
    if (block.has_surfaces()) reader.add(block.surfaces());
    if (block.has_scene()) back = reader.scene(block.scene());
  });
  EXPECT_EQ(volumes, 2U);
  EXPECT_EQ(samples, std::size_t{2} * 41 * 41 * 41);
  ASSERT_TRUE(back);
  const auto& skin = dynamic_cast<const IsoSurface&>(*back->instances[0].shape->source);
  const auto& bone = dynamic_cast<const IsoSurface&>(*back->instances[1].shape->source);
  EXPECT_EQ(skin.volume(), bone.volume());
  EXPECT_LT(memoryOf(*back), 2 * samples);
  const ProxySettings settings;
  Random random(3);
  Vec3 finger(0, 0.09, 0);
  ProxyState was = startProxy(*made, settings, finger), is = startProxy(*back, settings, finger);
  int touched = 0;
  for (int i = 0; i < 2000; ++i) {
    finger += 1e-3 * random.vec() - 0.003 * (finger - 0.03 * finger.normalized());
    touched += tick(was, *made, settings, finger).contacts.empty() ? 0 : 1;
    tick(is, *back, settings, finger);
    ASSERT_EQ(was.position, is.position) << i;
  }
  EXPECT_GT(touched, 200);
}

// A needle that pierces the skin goes on through the same matter.
TEST(RecordedScene, HasTheMatterOfItsVolume) {
  SceneModel phantom = makeBuiltinWorld("ct:phantom:41");
  const auto& iso = dynamic_cast<const IsoSurface&>(*phantom.surfaces[0].source);
  const auto matter = std::make_shared<const MatterTable>(
      std::vector<MatterRow>{{.value = -500, .stiffness = 0.5, .strength_N = 1},
                             {.value = 0, .stiffness = 1, .strength_N = 2, .force = {0.1, 5}}});
  phantom.surfaces[0].source = std::make_shared<const IsoSurface>(iso.volume(), iso.frame(), iso.iso(), matter);
  const auto made = makeSnapshot(phantom);
  EXPECT_NEAR(made->instances[0].surfaces->materials[0].strength_N, 1.04, 1e-12) << "at -480";
  SceneWriter writer;
  SceneReader reader;
  std::shared_ptr<const Snapshot> back;
  writer.write(*made, [&](const proto::RecordingBlock& block) {
    if (block.has_volume()) reader.add(block.volume());
    if (block.has_surfaces()) reader.add(block.surfaces());
    if (block.has_scene()) back = reader.scene(block.scene());
  });
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->instances[0].shape->source->resists());
  const ProxySettings settings;
  Vec3 finger(0.001, 0.1, 0.002);
  ProxyState was = startProxy(*made, settings, finger), is = startProxy(*back, settings, finger);
  int pierced = 0, held = 0;
  for (int i = 0; i < 2000; ++i) {
    finger.y() -= 1e-4;
    tick(was, *made, settings, finger);
    const TickReport report = tick(is, *back, settings, finger);
    ASSERT_EQ(was.position, is.position) << i;
    pierced += is.pierced.empty() ? 0 : 1;
    held += report.held_pull_m == Vec3::Zero() ? 0 : 1;
  }
  EXPECT_GT(pierced, 0);
  EXPECT_GT(held, 200);
}

TEST(RecordedScene, IsTouchedBitForBitAsItWas) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const auto scene = randomScene(random);
    SceneWriter writer;
    SceneReader reader;
    int parts = 0;
    const auto back = writtenAndRead(*scene, writer, reader, parts);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->number, scene->number);
    EXPECT_EQ(back->blend_ns, scene->blend_ns);
    EXPECT_EQ(back->moves_until_ns, scene->moves_until_ns);
    EXPECT_EQ(back->primitives, scene->primitives);
    ProxySettings settings;
    ProxyState a = startProxy(SceneAt(*scene, 0), settings, Vec3(0.1, 0, 0));
    ProxyState b = startProxy(SceneAt(*back, 0), settings, Vec3(0.1, 0, 0));
    int touching = 0;
    Vec3 finger = Vec3::Zero(), goal = Vec3::Zero();
    for (std::int64_t t = 0; t < 600; ++t) {
      if (t % 100 == 0) goal = 0.04 * random.vec();
      finger += limited(goal - finger, 5e-4);
      const TickReport ra = tick(a, SceneAt(*scene, t * 1'000'000), settings, finger);
      const TickReport rb = tick(b, SceneAt(*back, t * 1'000'000), settings, finger);
      ASSERT_TRUE(sameBits(a.position, b.position)) << t;
      ASSERT_TRUE(sameBits(ra.injected_J, rb.injected_J)) << t;
      ASSERT_TRUE(sameBits(a.stiffness, b.stiffness)) << t;
      touching += ra.contacts.empty() ? 0 : 1;
    }
    EXPECT_GT(touching, 100);
  }
}

TEST(RecordedScene, WhatScenesShareIsWrittenOnce) {
  Random random(3);
  const auto scene = randomScene(random);
  SceneWriter writer;
  SceneReader reader;
  int parts = 0;
  writtenAndRead(*scene, writer, reader, parts);
  EXPECT_EQ(parts, 2);
  const auto next = makeSnapshot(scene->instances, "soup", 13);
  ASSERT_TRUE(writtenAndRead(*next, writer, reader, parts));
  EXPECT_EQ(parts, 2);
}

constexpr std::int64_t kBend_ns = 10'000'000;

// The scene before, with its soup bent.
std::shared_ptr<const Snapshot> bent(const Snapshot& scene, Random& random) {
  std::vector<Instance> instances = scene.instances;
  const std::shared_ptr<const Shape> before = instances[0].shape;
  Model model = before->model;
  for (Vec3& p : model.positions) p += 0.004 * random.vec();
  const auto shape = makeShape(std::move(model), *before);
  for (Instance& instance : instances) {
    instance.shape = shape;
    instance.mesh_motion = std::make_shared<MeshMotion>(MeshTransition(before, shape, 0, kBend_ns));
  }
  return makeSnapshot(std::move(instances), scene.name, scene.number + 1);
}

TEST(RecordedScene, ABentMeshPushesTheProxyAsItDid) {
  Random random(8);
  const auto first = randomScene(random);
  SceneWriter writer;
  SceneReader reader;
  int parts = 0, pushed = 0;
  for (std::shared_ptr<const Snapshot> scene = first, next; pushed < 20; scene = next) {
    next = bent(*scene, random);
    const auto one = writtenAndRead(*scene, writer, reader, parts),
               other = writtenAndRead(*next, writer, reader, parts);
    ASSERT_TRUE(one && other && other->deforming.size() == 2);
    const Vec3 finger = 0.03 * random.vec();
    ProxySettings settings;
    settings.work_cap = kNoWorkCap;  // the scene that was read has another hierarchy, which does other work
    ProxyState a = startProxy(SceneAt(*scene, 0), settings, finger), b = startProxy(SceneAt(*one, 0), settings, finger);
    tick(a, SceneAt(*scene, 0), settings, finger);
    tick(b, SceneAt(*one, 0), settings, finger);
    const Vec3 was = a.position;
    for (std::int64_t t = 0; t <= kBend_ns; t += kBend_ns / 10) {
      tick(a, SceneAt(*next, t), settings, finger);
      tick(b, SceneAt(*other, t), settings, finger);
      ASSERT_TRUE(sameBits(a.position, b.position)) << t;
    }
    pushed += a.position != was ? 1 : 0;
  }
}

TEST(RecordedScene, ABentMeshOfAnotherMeshIsRefused) {
  Random random(9);
  const auto scene = randomScene(random);
  SceneWriter writer;
  SceneReader reader;
  proto::RecordedScene message;
  writer.write(*bent(*scene, random), [&](const proto::RecordingBlock& block) {
    if (block.has_shape()) reader.add(block.shape());
    if (block.has_surfaces()) reader.add(block.surfaces());
    if (block.has_scene()) message = block.scene();
  });
  EXPECT_NO_THROW(reader.scene(message));
  proto::RecordedShape other;
  other.set_id(77);
  other.set_materials(1);
  for (int i = 0; i < 9; ++i) other.add_positions(i * i);
  for (std::uint32_t i = 0; i < 3; ++i) other.add_triangles(i);
  reader.add(other);
  for (const std::uint64_t id : {77, 78}) {
    message.mutable_instances(0)->mutable_mesh_motion(0)->set_from(id);
    EXPECT_THROW(reader.scene(message), Error) << id;
  }
}

TEST(RecordedScene, AMeshOfManyPartsComesBackWhole) {
  Random random(11);
  Model model;
  for (std::uint32_t i = 0; i < 300'000; ++i) {
    model.positions.push_back(random.vec());
    model.texcoords.emplace_back(random.uniform(), random.uniform());
  }
  for (std::uint32_t i = 0; i < 700'000; ++i) {
    model.triangles.push_back({i % 300'000, (7 * i + 1) % 300'000, (13 * i + 2) % 300'000});
    model.triangle_materials.push_back(static_cast<std::uint16_t>(i % 3));
  }
  model.materials.resize(3);
  const auto scene = makeSnapshot(model, HierarchyKind::kNone);
  SceneWriter writer;
  SceneReader reader;
  int parts = 0;
  const auto back = writtenAndRead(*scene, writer, reader, parts);
  ASSERT_TRUE(back);
  EXPECT_GT(parts, 3);
  const Model &was = scene->shape().model, &is = back->shape().model;
  EXPECT_TRUE(was.positions == is.positions && was.texcoords == is.texcoords && was.triangles == is.triangles &&
              was.triangle_materials == is.triangle_materials);
  EXPECT_EQ(is.materials.size(), 3u);
}

/// A triangle with everything that a mesh can have.
proto::RecordedShape soundShape() {
  proto::RecordedShape shape;
  shape.set_id(1);
  shape.set_materials(2);
  for (int i = 0; i < 9; ++i) shape.add_positions(i * i % 7);
  for (int i = 0; i < 9; ++i) shape.add_normals(i % 4 == 2 ? 1 : 0);
  for (int i = 0; i < 6; ++i) shape.add_texcoords(0.1 * i);
  for (std::uint32_t i = 0; i < 3; ++i) shape.add_triangles(i);
  shape.add_triangle_materials(1);
  return shape;
}

TEST(RecordedScene, AMeshThatCanNotBeIsRefusedInOneLine) {
  using Change = void (*)(proto::RecordedShape&);
  const std::vector<Change> changes{[](proto::RecordedShape& s) { s.add_positions(1); },
                                    [](proto::RecordedShape& s) { s.mutable_normals()->Truncate(6); },
                                    [](proto::RecordedShape& s) { s.set_normals(4, std::nan("")); },
                                    [](proto::RecordedShape& s) { s.mutable_texcoords()->Truncate(2); },
                                    [](proto::RecordedShape& s) { s.set_texcoords(1, HUGE_VAL); },
                                    [](proto::RecordedShape& s) { s.set_triangles(1, 3); },
                                    [](proto::RecordedShape& s) { s.add_triangles(0); },
                                    [](proto::RecordedShape& s) { s.add_segments(0), s.add_segments(0xffffffff); },
                                    [](proto::RecordedShape& s) { s.add_points(3); },
                                    [](proto::RecordedShape& s) { s.set_triangle_materials(0, 0x10000); },
                                    [](proto::RecordedShape& s) { s.add_triangle_materials(0); },
                                    [](proto::RecordedShape& s) { s.add_point_materials(0); },
                                    [](proto::RecordedShape& s) { s.set_materials(0); },
                                    [](proto::RecordedShape& s) { s.set_materials(0xffffffff); },
                                    [](proto::RecordedShape& s) { s.set_hierarchy(3); }};
  EXPECT_NO_THROW(SceneReader().add(soundShape()));
  for (std::size_t i = 0; i < changes.size(); ++i) {
    proto::RecordedShape shape = soundShape();
    changes[i](shape);
    try {
      SceneReader().add(shape);
      ADD_FAILURE() << "change " << i << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(RecordedScene, APartOfAnotherMeshIsRefused) {
  SceneReader reader;
  proto::RecordedShape part = soundShape();
  part.set_continues(true);
  reader.add(part);
  part.set_id(2);
  EXPECT_THROW(reader.add(part), Error);
}

TEST(RecordedScene, MessagesThatMakeNoSenseAreRefused) {
  SceneReader reader;
  proto::RecordedScene scene;
  scene.add_instances()->set_shape(3);
  EXPECT_THROW(reader.scene(scene), Error);
  proto::RecordedShape shape;
  shape.add_positions(1);
  EXPECT_THROW(reader.add(shape), Error);
  proto::RecordedSurfaces surfaces;
  surfaces.add_materials()->add_numbers(1);
  EXPECT_THROW(reader.add(surfaces), Error);
}

proto::RecordingBlock block(const std::string& text) {
  proto::RecordingBlock block;
  block.mutable_end()->set_reason(text);
  return block;
}

/// The reasons of all blocks that can be read.
std::vector<std::string> readAll(const std::string& path, std::string& damage) {
  RecordingReader reader(path);
  proto::RecordingBlock read;
  std::vector<std::string> found;
  while (reader.next(read)) found.push_back(read.end().reason());
  damage = reader.damage();
  return found;
}

class RecordingFile : public testing::Test {
 protected:
  test::TempFolder folder;
  std::string path = (folder.path() / "a.hlr").string();
  std::vector<std::string> written;
  std::vector<std::uint64_t> ends;  ///< of the blocks in the file
  void SetUp() override {
    RecordingWriter writer(path);
    for (int i = 0; i < 8; ++i) {
      written.push_back(std::string(static_cast<std::size_t>(10 * i + 1), static_cast<char>('a' + i)));
      writer.write(block(written.back()));
      ends.push_back(writer.bytes());
    }
    EXPECT_EQ(writer.bytes(), std::filesystem::file_size(path));
  }
};

TEST_F(RecordingFile, BlocksComeBack) {
  std::string damage;
  EXPECT_EQ(readAll(path, damage), written);
  EXPECT_EQ(damage, "");
}

TEST_F(RecordingFile, CutAnywhereGivesTheBlocksBefore) {
  for (auto left = ends.back() - 1; left >= 8; --left) {
    std::filesystem::resize_file(path, left);
    const auto whole = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), left) - ends.begin());
    std::string damage;
    const std::vector<std::string> found = readAll(path, damage);
    ASSERT_EQ(found, std::vector(written.begin(), written.begin() + static_cast<std::ptrdiff_t>(whole)));
    EXPECT_EQ(damage.empty(), left == (whole > 0 ? ends[whole - 1] : 8)) << left;
  }
}

TEST_F(RecordingFile, ADamagedBitEndsItWhereItIs) {
  const auto size = static_cast<int>(std::filesystem::file_size(path));
  for (int at = 8; at < size; at += 3) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(at);
    const char byte = static_cast<char>(file.get());
    file.seekp(at);
    file.put(static_cast<char>(byte ^ 4));
    file.close();
    std::string damage;
    const std::vector<std::string> found = readAll(path, damage);
    EXPECT_FALSE(damage.empty()) << at;
    EXPECT_TRUE(found.size() < written.size() && std::equal(found.begin(), found.end(), written.begin())) << at;
    file.open(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(at);
    file.put(byte);
  }
}

TEST_F(RecordingFile, OfAnotherFormSaysWhich) {
  for (const std::string form : {"1", "3", "9"}) {
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << "HLREC" + form + "\r\n";
    std::string damage;
    try {
      readAll(path, damage);
      ADD_FAILURE() << "it was read";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("form " + form + ", and this version of HL reads form 2"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST_F(RecordingFile, OtherFilesAreRefused) {
  std::string damage;
  EXPECT_THROW(readAll((folder.path() / "none").string(), damage), Error);
  std::ofstream(path) << "v 0 0 0\n";
  EXPECT_THROW(readAll(path, damage), Error);
  EXPECT_THROW(RecordingWriter((folder.path() / "no folder" / "a.hlr").string()), Error);
}

}  // namespace
}  // namespace hl::test_recording
