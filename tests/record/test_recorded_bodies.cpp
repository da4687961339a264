// Sessions with rigid bodies, recorded and run again: every tick, and a hash of the world after each, is the same to
// the bit, with scenes that change while bodies move and recordings that begin then; what differs is found where it is.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <thread>

#include "base/clock.h"
#include "base/error.h"
#include "bodies/test_worlds.h"
#include "bodies/world_hash.h"
#include "device/simulated_device.h"
#include "guard/realtime_guard.h"
#include "io/value_messages.h"
#include "record/recorded_bodies.h"
#include "record/recorder.h"
#include "record/replay.h"
#include "scene/scene_model.h"
#include "temp_folder.h"
#include "touch/touch_step.h"
#include "wait_for.h"

namespace hl::test_recorded_bodies {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr double kHalf_m = 0.01;

Instance instanceOf(Model model, std::uint64_t key) {
  Instance instance;
  instance.shape = makeShape(std::move(model));
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = key;
  return instance;
}

Instance floorInstance() {
  Instance floor = instanceOf(test::floorScene(0.2)->shape().model, 1);
  BodySpec spec;
  spec.fixed = true;
  spec.surface = {0.6, 0.4, 0.2};
  floor.body = makeRigidBody("floor", spec, {}, {}, {});
  return floor;
}

Instance bodyAt(std::uint64_t key, const Vec3& at) {
  Instance instance = instanceOf(test::boxModel(Vec3::Constant(kHalf_m)), key);
  BodySpec spec;
  spec.shape = key % 3 == 0 ? BodyShape::kBall : BodyShape::kBox;
  spec.mass_kg = 0.02 * static_cast<double>(key);
  spec.surface = {0.5, 0.4, 0.3};
  spec.velocity_m_s = Vec3(0, 0, 0.05);
  const Pose start{Eigen::AngleAxisd(0.3 * static_cast<double>(key), Vec3::UnitY()).toRotationMatrix(), at};
  instance.body = makeRigidBody("body", spec, start, instance.shape->bounds, {Vec3::Constant(-1), Vec3::Constant(1)});
  instance.motion = Motion(start);
  instance.driver = instance.body->poses;
  if (key == 2) {
    const SnapSpec sheet{"sheet", {Vec3(0, -0.009, 0)}, Vec3::UnitY(), 0.003, 3};
    instance.snaps = std::make_shared<const SnapList>(SnapList{sheet});
    FieldSpec magnet{"magnet", FieldKind::kMagnet, {Vec3::Zero()}, {}, 0.04, 0.05, 0, 0, Vec3::Zero()};
    FieldSpec drag{"drag", FieldKind::kDrag, {Vec3::Zero()}, {}, 0.03, 0, 0, 0.05, Vec3::Zero()};
    instance.fields = std::make_shared<const FieldList>(FieldList{magnet, drag});
  }
  return instance;
}

std::vector<Instance> bodiesOnAFloor() {
  std::vector<Instance> instances{floorInstance()};
  for (std::uint64_t key = 2; key < 8; ++key)
    instances.push_back(
        bodyAt(key, Vec3(0.025 * static_cast<double>(key % 3) - 0.02, 0.012 + 0.01 * key, 0.02 * (key % 2))));
  return instances;
}

/// Both loops by hand, on a virtual clock: a device's hand that stirs among the bodies, and scenes that change.
class Stirred {
 public:
  explicit Stirred(const RecorderSettings& settings)
      : instances_(bodiesOnAFloor()),
        slot_(makeSnapshot(instances_)),
        loop_(slot_, ProxySettings{}),
        settings_(ServoSettings::of(device_.info())),
        recorder_(settings, {device_.info(), 1000, 1000, {}}) {
    arm(step_.servo());
    commands_.radius_W = 0.003;
    commands_.surfaces.viscosity_Ns_m = 0.2;  // of which a body takes as much as its mass allows
    recorder_.scene(slot_.newest());
    recorder_.start();
  }
  ~Stirred() { recorder_.stop(); }

  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  void step() {
    now_ns_ += kPeriod_ns + (count_ * 7919) % 1000;
    const double t = 1e-3 * static_cast<double>(++count_);
    if (scene_changes_ && count_ % 400 == 0) changeScene();
    device_.setHandGoal(Vec3(0.03 * std::sin(4 * t), 0.012 + 0.01 * std::sin(2.3 * t), 0.03 * std::cos(3.1 * t)));
    DeviceSample sample = device_.read(now_ns_);
    if (lost_) sample.status = DeviceStatus::kLost;
    const ServoState before = step_.servo();
    const SpringOfServo spring = springOf(settings_, step_.servo());
    const ServoOutput out = step_.onTime(loop_, commands_, settings_, sample);
    {
      const RealtimeGuard guard;
      if (step_.tick())
        recorder_.tick({sample.time_ns, sample.position, commands_, spring}, *step_.tick(), loop_, 1000);
      recorder_.step({before, ServoCommand::kNone, settings_, step_.target(), sample, out, 1000});
    }
    device_.write(out.force_N);
    slot_.dropBefore();
    if (step_.tick()) {
      for (const ObjectName& touched : step_.tick()->touched) on_bodies_ += touched.key > 1 ? 1 : 0;
    }
    snapped_ += loop_.state().snap.holds() ? 1 : 0;
    drawn_ += step_.target().field_N.norm() > 0.01 ? 1 : 0;
  }
  void keepScene() { scene_changes_ = false; }
  void lose() { lost_ = true; }
  const BodyWorld& world() const { return *loop_.bodies(); }
  int onBodies() const { return on_bodies_; }  ///< contacts with bodies so far
  int snapped() const { return snapped_; }     ///< steps so far in which a snap held the proxy
  int drawn() const { return drawn_; }         ///< steps so far in which a field drew the hand

 private:
  // In turn: one body starts elsewhere, one goes, it comes again, and all stays as it is.
  void changeScene() {
    const int which = static_cast<int>(count_ / 400) % 4;
    if (which == 1) instances_.back() = bodyAt(7, Vec3(0.01, 0.05, 0));
    if (which == 2) instances_.pop_back();
    if (which == 3) instances_.push_back(bodyAt(7, Vec3(-0.02, 0.06, 0.01)));
    const auto next = makeSnapshot(instances_, {}, ++number_, which == 0 ? 0 : kAbruptBlend_ns);
    recorder_.scene(next);
    slot_.publish(next);
  }
  static SimulatedDeviceSettings coarse() {
    SimulatedDeviceSettings settings;
    settings.step_s = 100e-6;
    return settings;
  }

  std::vector<Instance> instances_;
  SnapshotSlot slot_;
  ProxyLoop loop_;
  TouchStep step_;
  SimulatedDevice device_{coarse()};
  ServoSettings settings_;
  Recorder recorder_;
  ProxyCommands commands_;
  std::int64_t now_ns_ = 5'000'000'000, count_ = 0;
  std::uint64_t number_ = 1;
  bool scene_changes_ = true, lost_ = false;
  int on_bodies_ = 0, snapped_ = 0, drawn_ = 0;
};

class RecordedBodies : public testing::Test {
 protected:
  test::TempFolder folder;
  std::string path = (folder.path() / "a.hlr").string(), changed = (folder.path() / "b.hlr").string();

  RecorderSettings toFile() const {
    RecorderSettings settings;
    settings.file = path;
    return settings;
  }
  /// Writes the recording again with something changed.
  void rewrite(const std::string& from, const std::function<void(proto::RecordingBlock&)>& change) const {
    RecordingReader reader(from);
    RecordingWriter writer(changed);
    for (proto::RecordingBlock block; reader.next(block); writer.write(block)) change(block);
  }
};

void expectReproduced(const ReplayReport& report) {
  EXPECT_FALSE(report.difference) << report.difference->what << ' ' << report.difference->number << ": "
                                  << report.difference->text;
  EXPECT_EQ(report.world_hashes, report.ticks);
  EXPECT_EQ(report.lost_ticks + report.unchecked_ticks, 0U);
}

TEST_F(RecordedBodies, AreReproducedBitForBitWhileScenesChange) {
  double moved_m = 0;
  {
    Stirred session(toFile());
    session.run(6000);
    EXPECT_GT(session.onBodies(), 20);
    EXPECT_GT(session.snapped(), 200);
    EXPECT_GT(session.drawn(), 200);
    for (std::size_t i = 0; i < session.world().world().bodies.size(); ++i)
      moved_m =
          std::max(moved_m, (session.world().state().bodies[i].centre - session.world().body(i).start.origin).norm());
  }
  EXPECT_GT(moved_m, 0.02);
  const ReplayReport report = replay(path);
  EXPECT_EQ(report.ticks, 6000U);
  EXPECT_EQ(report.scenes, 16U);
  expectReproduced(report);
}

// What shows a recording goes from pose to pose, so what has rested needs the place where it did.
TEST(RecordedPoses, AreThoseOfBodiesThatMoveAndOfTheEndOfTheirRest) {
  const Instance body = bodyAt(2, Vec3(0.1, 0.2, 0.3));
  SceneWriter writer;
  std::vector<proto::RecordedPoses> written;
  const auto write = [&written](const proto::RecordingBlock& block) {
    if (block.has_poses()) written.push_back(block.poses());
  };
  writer.write(*makeSnapshot({floorInstance(), body}), write);
  const auto move_to = [&](double x) { body.body->poses->jumpTo(Pose{Mat3::Identity(), Vec3(x, 0, 0)}); };
  struct Look {
    std::int64_t time_ns;
    double x;  // of the body then; 0: it rests
    std::vector<std::int64_t> times;
  };
  for (const Look& look : {Look{100, 0, {100}}, Look{200, 0, {}}, Look{300, 0, {}}, Look{400, 1, {300, 400}},
                           Look{500, 2, {500}}, Look{600, 0, {}}, Look{700, 3, {600, 700}}}) {
    if (look.x > 0) move_to(look.x);
    written.clear();
    writer.writePoses(look.time_ns, write);
    ASSERT_EQ(written.size(), look.times.size()) << look.time_ns;
    for (std::size_t i = 0; i < written.size(); ++i) {
      EXPECT_EQ(written[i].time_ns(), look.times[i]);
      EXPECT_EQ(written[i].bodies_size(), 1) << "what is fixed has none";
      EXPECT_EQ(written[i].poses_size(), 12);
    }
    if (look.x > 0) {
      EXPECT_EQ(written.back().poses(9), static_cast<float>(look.x));
    }
  }
  EXPECT_EQ(written.front().poses(9), 2.0f) << "where it rested";
}

TEST_F(RecordedBodies, OneBitOfABodyIsFoundInTheFirstTick) {
  { Stirred(toFile()).run(300); }
  rewrite(path, [](proto::RecordingBlock& block) {
    if (!block.has_rigid_body() || block.rigid_body().name() != "body") return;
    double& mass = *block.mutable_rigid_body()->mutable_body()->mutable_numbers()->Mutable(0);
    mass = std::nextafter(mass, 1);
  });
  const ReplayReport report = replay(changed);
  ASSERT_TRUE(report.difference);
  EXPECT_STREQ(report.difference->what, "tick");
  EXPECT_LT(report.difference->number, 100U);
  rewrite(path, [](proto::RecordingBlock& block) {
    if (block.has_ticks() && block.ticks().first() == 0)
      block.mutable_ticks()->set_world_hash(50, block.ticks().world_hash(50) + 1);
  });
  ASSERT_TRUE(replay(changed).difference);
  EXPECT_EQ(replay(changed).difference->number, 50U);
}

TEST_F(RecordedBodies, NumbersThatNoBodyHasAreRefused) {
  { Stirred(toFile()).run(300); }
  const auto refused = [&](const std::function<void(proto::RecordingBlock&)>& change) {
    rewrite(path, change);
    EXPECT_THROW(replay(changed), Error);
  };
  int numbers = 0;
  rewrite(path, [&](proto::RecordingBlock& block) {
    if (block.has_rigid_body()) numbers = block.rigid_body().body().numbers_size();
  });
  EXPECT_GT(numbers, 20);
  for (int i = 0; i < numbers; ++i) {
    refused([i](proto::RecordingBlock& block) {
      if (block.has_rigid_body()) block.mutable_rigid_body()->mutable_body()->set_numbers(i, std::nan(""));
    });
  }
  refused([](proto::RecordingBlock& block) {
    if (block.has_scene()) block.mutable_scene()->mutable_instances(2)->set_body(77);
  });
  refused([](proto::RecordingBlock& block) {
    if (block.has_scene()) block.mutable_scene()->mutable_mechanics()->set_gravity_m_s2(0, HUGE_VAL);
  });
  refused([](proto::RecordingBlock& block) {
    if (block.has_ticks()) block.mutable_ticks()->add_world_hash(1);
  });
}

/// What a black box of a session has that is lost after this many steps in one scene.
ReplayReport boxAfter(int steps, const std::filesystem::path& boxes) {
  RecorderSettings settings;
  settings.black_box_folder = boxes.string();
  settings.black_boxes = 1;
  {
    Stirred session(settings);
    session.run(900);
    session.keepScene();
    for (int i = 0; i < steps; ++i) {
      session.step();
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    session.lose();
    session.run(10);
  }
  return replay(std::filesystem::directory_iterator(boxes)->path().string());
}

// The recorder asks for what the bodies remember when it comes to it: then the ticks begin.
TEST_F(RecordedBodies, AreInABlackBox) {
  int steps = 1000;
  ReplayReport report = boxAfter(steps, folder.path() / "boxes");
  while (report.ticks < 200 && steps < 1'000'000) report = boxAfter(steps *= 2, folder.path() / "boxes");
  EXPECT_TRUE(report.black_box);
  EXPECT_FALSE(report.difference) << report.difference->what << ' ' << report.difference->number << ": "
                                  << report.difference->text;
  EXPECT_GE(report.ticks, 200U);
  EXPECT_EQ(report.scenes, 1U);
  EXPECT_GT(report.world_hashes, 0U);
  EXPECT_EQ(report.unchecked_ticks + report.lost_ticks, 0U);
  EXPECT_EQ(report.fault, faultText(FaultReason::kDeviceLost));
}

/// A recording that a page asks for while bodies move.
class RecordedLater : public RecordedBodies {
 protected:
  static constexpr std::uint32_t kPage = 7;
  using Phase = PageRecordingStatus::Phase;
  std::shared_ptr<PageRecordings> pages = std::make_shared<PageRecordings>();

  RecorderSettings forPages() const {
    RecorderSettings settings;
    settings.pages = pages;
    return settings;
  }
  FilePointer recorded(Stirred& session, int steps) const {
    pages->ask(kPage, true, monotonicNow_ns());
    while (pages->status().phase == Phase::kStarting) {
      session.step();
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    EXPECT_EQ(pages->status().phase, Phase::kRunning) << pages->status().text;
    session.run(steps);
    pages->ask(kPage, false, monotonicNow_ns());
    test::waitFor([&] { return pages->status().phase == Phase::kReady; });
    return pages->open(kPage);
  }
  static std::string pathOf(const FilePointer& file) { return "/proc/self/fd/" + std::to_string(file->descriptor()); }
};

TEST_F(RecordedLater, BegunWhileBodiesMoveTheyGoOnBitForBit) {
  constexpr int kSteps = 2500;
  Stirred session(forPages());
  int touched = 0;  // bodies, while it was recorded
  for (const int before : {37, 350, 900}) {
    session.run(before);
    const int on_bodies = session.onBodies();
    const FilePointer file = recorded(session, kSteps);
    ASSERT_TRUE(file);
    touched += session.onBodies() - on_bodies;
    const ReplayReport report = replay(pathOf(file));
    EXPECT_GE(report.ticks, std::uint64_t{kSteps});
    expectReproduced(report);
    pages->drop();
  }
  EXPECT_GT(touched, 0);
}

TEST_F(RecordedLater, AMemoryOfBodiesThatNoSessionHasIsRefused) {
  Stirred session(forPages());
  session.run(500);
  const FilePointer file = recorded(session, 100);
  const auto taken = [&](const std::function<void(proto::RecordedBodies&)>& change) {
    rewrite(pathOf(file), [&](proto::RecordingBlock& block) {
      if (block.has_proxy()) change(*block.mutable_proxy()->mutable_bodies());
    });
    replay(changed);
  };
  EXPECT_NO_THROW(taken([](auto& bodies) { EXPECT_GT(bodies.contacts().numbers_size(), 0); }));
  EXPECT_THROW(taken([](auto& bodies) { bodies.mutable_bodies()->set_numbers(1, std::nan("")); }), Error);
  EXPECT_THROW(taken([](auto& bodies) { bodies.mutable_bodies()->set_numbers(4, 2); }), Error) << "a quaternion";
  EXPECT_THROW(taken([](auto& bodies) { bodies.mutable_bodies()->add_numbers(2); }), Error);
  EXPECT_THROW(taken([](auto& bodies) { bodies.clear_bodies(); }), Error);
  EXPECT_THROW(taken([](auto& bodies) { bodies.mutable_contacts()->set_integers(0, -1); }), Error) << "their order";
  EXPECT_THROW(taken([](auto& bodies) { bodies.mutable_totals()->set_numbers(0, HUGE_VAL); }), Error);
}

TEST(RecordedBodiesMemory, GoesOnToTheBitInAnotherWorld) {
  const auto scene = makeSnapshot(bodiesOnAFloor());
  const std::unique_ptr<BodyWorld> one = BodyWorld::of(*scene), other = BodyWorld::of(*withOwnBodies(*scene));
  std::int64_t now_ns = 0;
  for (int i = 0; i < 200; ++i) one->step(now_ns += kPeriod_ns, 1e-3, {});
  BodiesMemory memory;
  EXPECT_FALSE(one->remember(memory)) << "there is no room";
  memory.reserve(one->world().bodies.size(), one->world().joints.size());
  {
    const RealtimeGuard guard;
    ASSERT_TRUE(one->remember(memory));
  }
  proto::RecordedBodies message;
  toProto(memory, message);
  other->resume(fromProto(message));
  for (int i = 0; i < 500; ++i) {
    now_ns += kPeriod_ns;
    one->step(now_ns, 1e-3, {});
    other->step(now_ns, 1e-3, {});
    ASSERT_EQ(hashOf(one->world(), one->state()), hashOf(other->world(), other->state())) << i;
  }
}

TEST(WorldHash, EachNumberOfAStateCounts) {
  const auto scene = makeSnapshot(bodiesOnAFloor());
  const std::unique_ptr<BodyWorld> bodies = BodyWorld::of(*scene);
  for (std::int64_t now_ns = 0; now_ns < 200 * kPeriod_ns; now_ns += kPeriod_ns) bodies->step(now_ns, 1e-3, {});
  const World& world = bodies->world();
  const WorldState& state = bodies->state();
  ASSERT_FALSE(state.memory.all().empty());
  std::vector<std::uint64_t> hashes{hashOf(world, state)};
  const auto add = [&](const auto& change) {
    WorldState other = state;
    change(other);
    hashes.push_back(hashOf(world, other));
  };
  add([](WorldState& s) { s.bodies[0].centre.x() = -s.bodies[0].centre.x(); });
  add([](WorldState& s) { s.bodies[5].turned.w() = std::nextafter(s.bodies[5].turned.w(), 2); });
  add([](WorldState& s) { std::swap(s.bodies[1], s.bodies[2]); });
  add([](WorldState& s) { s.bodies[3].velocity.z() = std::nextafter(s.bodies[3].velocity.z(), 2); });
  add([](WorldState& s) { s.bodies[3].spin.z() = std::nextafter(s.bodies[3].spin.z(), 2); });
  add([](WorldState& s) { ++s.bodies[4].stopped_short; });
  add([](WorldState& s) { s.memory.clear(); });
  add([](WorldState& s) { s.bodies[4].still_s = std::nextafter(s.bodies[4].still_s, 2); });
  add([](WorldState& s) { s.bodies[4].island = 1; });
  add([](WorldState& s) { s.asleep.add({}); });
  add([](WorldState& s) { s.energy.friction_J = std::nextafter(s.energy.friction_J, 2); });
  add([](WorldState& s) { ++s.steps; });
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end());
}

TEST(OldRecordings, OfATimeBeforeBodiesAreRead) {
  const ReplayReport report = replay(HL_TEST_FOLDER "/before_bodies.hlr");
  EXPECT_EQ(report.damage, "");
  EXPECT_GT(report.steps, 100U);
  EXPECT_EQ(report.ticks, report.steps);
  EXPECT_EQ(report.world_hashes, 0U);
}

}  // namespace
}  // namespace hl::test_recorded_bodies
