// Sessions recorded and run again: bit for bit, with scenes that change under the finger, faults and settings; what is
// changed in a file is found; a killed recorder's file is readable; faults leave black boxes.
#include "record/recorder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "base/clock.h"
#include "base/error.h"
#include "builtin.h"
#include "device/simulated_device.h"
#include "guard/realtime_guard.h"
#include "io/value_messages.h"
#include "record/replay.h"
#include "temp_folder.h"
#include "touch/touch_session.h"
#include "touch/touch_step.h"
#include "wait_for.h"

namespace hl::test_recorder {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

std::shared_ptr<const Snapshot> sceneOf(const std::string& name) {
  Model model = makeBuiltinScene(name);
  fitModel(model, 0.1);
  model.materials[0].dynamic_friction = 0.3;
  model.materials[0].smooth = true;
  return makeSnapshot(std::move(model));
}

Model pressed(Model model, double by) {
  for (Vec3& p : model.positions) p.y() *= by;
  return model;
}

// A mesh that bends from the fifth second of the clock to the ninth; `given`: its client says how it yields.
std::shared_ptr<const Snapshot> bendingSceneOf(const std::string& name, bool given) {
  constexpr std::int64_t kBegin_ns = 5'000'000'000, kEnd_ns = 9'000'000'000;
  Instance instance;
  instance.key = 1;
  const auto from = sceneOf(name)->instances[0].shape;
  instance.shape = makeShape(pressed(from->model, 0.9), *from);
  instance.mesh_motion = std::make_shared<MeshMotion>(MeshTransition(from, instance.shape, kBegin_ns, kEnd_ns));
  if (given) {
    instance.compliance =
        std::make_shared<ComplianceMotion>(ComplianceMotion(Compliance{0.002, 0.001, Vec3(0.1, 0.3, -0.2)})
                                               .then({0.004, 0.004, Vec3(0, 1, 0)}, kBegin_ns, kEnd_ns));
  }
  Surfaces surfaces = *surfacesOf(from);
  surfaces.materials[0].compliance_m_N = 0.0005;
  instance.surfaces = std::make_shared<const Surfaces>(std::move(surfaces));
  return makeSnapshot({instance});
}

/// Both loops by hand, on a virtual clock, with a simulated device in a hand that is led over the scene.
class Loops {
 public:
  explicit Loops(const RecorderSettings& settings, bool start = true)
      : scenes_({sceneOf("sphere:500"), bendingSceneOf("teapot", true), bendingSceneOf("terrain:2000", false)}),
        slot_(scenes_[0]),
        proxy_(slot_, hurried()),
        settings_(ServoSettings::of(device_.info())),
        recorder_(settings, {device_.info(), 1000, 1000, hurried()}) {
    commands_.radius_W = 0.002;
    recorder_.scene(scenes_[0]);
    if (start) recorder_.start();
  }
  ~Loops() { recorder_.stop(); }

  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  void step() {
    now_ns_ += kPeriod_ns + static_cast<std::int64_t>(random_() % 1000);
    ++count_;
    disturb();
    const TickRequest input{now_ns_, finger_D_, commands_, springOf(settings_, state_)};
    const ProxyStep tick = proxy_.step(now_ns_, finger_D_, commands_, input.spring);
    recorder_.tick(input, tick, proxy_, 1000);
    touching_ += tick.held.target.valid ? 1 : 0;
    out_of_work_ += tick.report.ending == Ending::kOutOfWork ? 1 : 0;
    DeviceSample sample = device_.read(now_ns_);
    if (lost_) sample.status = DeviceStatus::kLost;
    finger_D_ = sample.position;
    const ServoState before = state_;
    apply(state_, command_);
    const ServoOutput out = stepServo(state_, settings_, tick.held.target, sample);
    recorder_.step({before, command_, settings_, tick.held.target, sample, out, 1000});
    device_.write(out.force_N);
  }
  int touching() const { return touching_; }
  int outOfWork() const { return out_of_work_; }
  Recorder& recorder() { return recorder_; }
  void lose() { lost_ = true; }

 private:
  void disturb() {
    const double t = 1e-3 * static_cast<double>(count_);
    device_.setHandGoal(0.045 * Vec3(std::sin(1.3 * t), std::cos(0.7 * t), std::sin(0.9 * t + 1)));
    if (count_ % 700 == 0) {
      const auto& next = scenes_[static_cast<std::size_t>(count_ / 700) % scenes_.size()];
      recorder_.scene(next);
      slot_.publish(next);
    }
    if (count_ % 300 == 0) settings_.stiffness_N_m = 500 + static_cast<double>(random_() % 1000);
    if (count_ % 450 == 0) commands_.surfaces.static_friction = 0.1 * static_cast<double>(random_() % 10);
    if (count_ % 900 == 0) ++commands_.restarts;
    command_ = count_ == 1 || count_ % 1100 == 0 ? ServoCommand::kArm : ServoCommand::kNone;
    if (count_ % 1000 == 0) command_ = ServoCommand::kStall;
  }

  std::vector<std::shared_ptr<const Snapshot>> scenes_;
  SnapshotSlot slot_;
  ProxyLoop proxy_;
  SimulatedDevice device_{coarse()};
  ServoSettings settings_;
  Recorder recorder_;
  ServoState state_;
  ProxyCommands commands_;
  ServoCommand command_ = ServoCommand::kNone;
  Vec3 finger_D_ = Vec3::Zero();
  std::int64_t now_ns_ = 5'000'000'000, count_ = 0;
  int touching_ = 0, out_of_work_ = 0;
  bool lost_ = false;
  std::mt19937 random_{1};

  // So little work that some ticks run out of it.
  static ProxySettings hurried() {
    ProxySettings settings;
    settings.work_cap = 50;
    return settings;
  }
  static SimulatedDeviceSettings coarse() {
    SimulatedDeviceSettings settings;
    settings.step_s = 100e-6;
    return settings;
  }
};

class Recording : public testing::Test {
 protected:
  test::TempFolder folder;
  std::string path = (folder.path() / "a.hlr").string();
  RecorderSettings settings() const {
    RecorderSettings settings;
    settings.file = path;
    settings.version = "test";
    return settings;
  }
  std::vector<std::filesystem::path> boxes() const {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "boxes")) found.push_back(entry);
    return found;
  }
};

TEST_F(Recording, IsReproducedBitForBit) {
  {
    Loops loops(settings());
    loops.run(5000);
    EXPECT_GT(loops.touching(), 1000);
    EXPECT_GT(loops.outOfWork(), 5);
  }
  int visited = 0, forced = 0;
  const ReplayReport report = replay(path, [&](double, const ServoRecord& step) {
    ++visited;
    forced += step.out.force_N.isZero(0) ? 0 : 1;
  });
  EXPECT_FALSE(report.difference) << report.difference->what << " " << report.difference->number << " "
                                  << report.difference->text;
  EXPECT_EQ(report.steps, 5000u);
  EXPECT_EQ(report.ticks, 5000u);
  EXPECT_EQ(report.scenes, 8u);
  EXPECT_EQ(report.lost_steps + report.lost_ticks, 0u);
  EXPECT_EQ(report.end, "stopped");
  EXPECT_EQ(report.damage, "");
  EXPECT_EQ(report.version, "test");
  EXPECT_EQ(visited, 5000);
  EXPECT_GT(forced, 500);
}

/// Writes the recording again with something changed.
void rewrite(const std::string& from, const std::string& to,
             const std::function<void(proto::RecordingBlock&)>& change) {
  RecordingReader reader(from);
  RecordingWriter writer(to);
  proto::RecordingBlock block;
  while (reader.next(block)) {
    change(block);
    if (block.body_case() != proto::RecordingBlock::BODY_NOT_SET) writer.write(block);
  }
}

// A file that was made before the last quantity of surfaces was added.
TEST_F(Recording, OfBeforeTheLastQuantityIsRead) {
  { Loops(settings()).run(600); }  // in the first scene, which has not got it
  const auto drop = [](proto::Values& values, std::initializer_list<int> numbers, std::initializer_list<int> integers) {
    for (const int i : numbers) values.mutable_numbers()->erase(values.numbers().begin() + i);
    for (const int i : integers) values.mutable_integers()->erase(values.integers().begin() + i);
  };
  constexpr int kLast = static_cast<int>(kNumbers) - 1, kTexture = static_cast<int>(kNumbers) + 2 * kLast;
  const std::string older = (folder.path() / "b.hlr").string();
  rewrite(path, older, [&](proto::RecordingBlock& block) {
    if (block.has_start()) drop(*block.mutable_start()->mutable_proxy(), {4 + kLast}, {4 + kLast});
    if (block.has_surfaces()) {
      for (auto& material : *block.mutable_surfaces()->mutable_materials())
        drop(material, {kTexture + 1, kTexture, kLast}, {1 + kLast});
    }
    if (block.has_ticks()) {
      for (auto& change : *block.mutable_ticks()->mutable_commands()) drop(*change.mutable_values(), {kLast}, {kLast});
    }
  });
  const ReplayReport report = replay(older);
  EXPECT_FALSE(report.difference);
  EXPECT_EQ(report.ticks, 600u);
}

TEST_F(Recording, OneBitChangedIsFoundWhereItIs) {
  { Loops(settings()).run(3000); }
  const std::string changed = (folder.path() / "b.hlr").string();
  const auto nudge = [](double value) { return std::nextafter(value, 1); };
  rewrite(path, changed, [&](proto::RecordingBlock& block) {
    if (!block.has_steps() || block.steps().first() > 2100 ||
        block.steps().first() + block.steps().flags_size() <= 2100)
      return;
    const int at = 3 * static_cast<int>(2100 - block.steps().first());
    block.mutable_steps()->set_force_n(at, nudge(block.steps().force_n(at)));
  });
  const ReplayReport step = replay(changed);
  ASSERT_TRUE(step.difference);
  EXPECT_STREQ(step.difference->what, "servo step");
  EXPECT_EQ(step.difference->number, 2100u);
  rewrite(path, changed, [&](proto::RecordingBlock& block) {
    if (!block.has_ticks() || block.ticks().first() > 1500 ||
        block.ticks().first() + block.ticks().contacts_size() <= 1500)
      return;
    const int at = 3 * static_cast<int>(1500 - block.ticks().first());
    block.mutable_ticks()->set_finger(at, nudge(block.ticks().finger(at)));
  });
  const ReplayReport tick = replay(changed);
  ASSERT_TRUE(tick.difference);
  EXPECT_STREQ(tick.difference->what, "tick");
  EXPECT_GE(tick.difference->number, 1500u);
}

TEST_F(Recording, WhatIsMissingIsReportedAndTheServoGoesOnAfterIt) {
  { Loops(settings()).run(3000); }
  const std::string changed = (folder.path() / "b.hlr").string();
  std::uint64_t steps = 0, ticks = 0, steps_after = 0, ticks_after = 0;
  rewrite(path, changed, [&](proto::RecordingBlock& block) {
    if (block.has_steps() && steps == 0 && block.steps().first() > 1000) {
      steps = static_cast<std::uint64_t>(block.steps().flags_size());
      steps_after = 3000 - block.steps().first() - steps;
      block.Clear();
    } else if (block.has_ticks() && ticks == 0 && block.ticks().first() > 1000) {
      ticks = static_cast<std::uint64_t>(block.ticks().contacts_size());
      ticks_after = 3000 - block.ticks().first() - ticks;
      block.Clear();
    }
  });
  const ReplayReport report = replay(changed);
  EXPECT_FALSE(report.difference);
  EXPECT_EQ(report.lost_steps, steps);
  EXPECT_EQ(report.lost_ticks, ticks);
  EXPECT_EQ(report.unchecked_ticks, ticks_after);
  EXPECT_GT(steps_after, 0u);
  EXPECT_EQ(report.steps, 3000 - steps);
}

TEST_F(Recording, NumbersThatNoSessionHasAreRefused) {
  { Loops(settings()).run(200); }
  const std::string changed = (folder.path() / "b.hlr").string();
  const auto recordedWith = [&](const std::function<void(proto::RecordingBlock&)>& change) {
    rewrite(path, changed, change);
    replay(changed);
  };
  EXPECT_NO_THROW(recordedWith([](proto::RecordingBlock&) {}));
  EXPECT_THROW(recordedWith([](proto::RecordingBlock& block) {
                 if (!block.has_ticks()) return;
                 for (double& number : *block.mutable_ticks()->mutable_commands(0)->mutable_values()->mutable_numbers())
                   number = -1;
               }),
               Error);
  EXPECT_THROW(recordedWith([](proto::RecordingBlock& block) {
                 if (block.has_ticks()) block.mutable_ticks()->add_finger(0);
               }),
               Error);
  EXPECT_THROW(recordedWith([](proto::RecordingBlock& block) {
                 if (block.has_scene()) block.mutable_scene()->set_identity(1ULL << 60);
               }),
               Error);
}

/// The structure that a message holds, changed.
template <typename T>
void change(proto::Values& values, const std::function<void(T&)>& change_it) {
  T value;
  EXPECT_EQ(setFrom(fromProto(values), value), Fit::kFits);
  change_it(value);
  values.Clear();
  toProto(valuesOf(value), values);
}

TEST_F(Recording, EachFieldOutOfItsRangeIsRefusedInOneLine) {
  { Loops(settings()).run(3000); }  // blocks enough to be out of order
  using Change = std::function<void(proto::RecordingBlock&)>;
  const auto device = [](const std::function<void(DeviceInfo&)>& it) -> Change {
    return [it](auto& block) {
      if (block.has_start()) change<DeviceInfo>(*block.mutable_start()->mutable_device(), it);
    };
  };
  const auto proxy = [](const std::function<void(ProxySettings&)>& it) -> Change {
    return [it](auto& block) {
      if (block.has_start()) change<ProxySettings>(*block.mutable_start()->mutable_proxy(), it);
    };
  };
  const auto commands = [](const std::function<void(TickContext&)>& it) -> Change {
    return [it](auto& block) {
      if (block.has_ticks()) change<TickContext>(*block.mutable_ticks()->mutable_commands(0)->mutable_values(), it);
    };
  };
  const auto steps = [](const std::function<void(proto::ServoSteps&)>& it) -> Change {
    return [it](auto& block) {
      if (block.has_steps()) it(*block.mutable_steps());
    };
  };
  const auto ticks = [](const std::function<void(proto::ProxyTicks&)>& it) -> Change {
    return [it](auto& block) {
      if (block.has_ticks()) it(*block.mutable_ticks());
    };
  };
  const std::vector<std::pair<std::string, Change>> changes{
      {"servo_rate_Hz", device([](auto& info) { info.servo_rate_Hz = 0; })},
      {"velocity_max_m_s", device([](auto& info) { info.velocity_max_m_s = std::nan(""); })},
      {"iteration_cap", proxy([](auto& settings) { settings.iteration_cap = 0; })},
      {"iteration_cap", proxy([](auto& settings) { settings.iteration_cap = 2'000'000'000; })},
      {"the proxy", proxy([](auto& settings) { settings.shading = static_cast<ShadingPasses>(9); })},
      {"period_s", commands([](auto& context) { context.spring.period_s = 0; })},
      {"period_s", commands([](auto& context) { context.spring.period_s = HUGE_VAL; })},
      {"stiffness_N_m", commands([](auto& context) { context.spring.stiffness_N_m = std::nan(""); })},
      {"stiffness", commands([](auto& context) { context.commands.surfaces.stiffness = 2; })},
      {"viscosity_Ns_m", commands([](auto& context) { context.commands.surfaces.viscosity_Ns_m = -1; })},
      {"radius", commands([](auto& context) { context.commands.radius_W = 0; })},
      {"workspace", commands([](auto& context) { context.commands.workspace.world_per_device = 0; })},
      {"the settings of a tick", commands([](auto& context) { context.spring.ledger = static_cast<LedgerMode>(7); })},
      {"no clock", ticks([](auto& message) { message.set_time_ns(0, INT64_MAX); })},
      {"no clock", ticks([](auto& message) { message.set_time_ns(message.time_ns_size() - 1, INT64_MIN); })},
      {"order", steps([](auto& message) { message.set_first(message.first() == 0 ? 0 : 1); })},
      {"order", ticks([](auto& message) { message.set_first(message.first() == 0 ? 0 : 1); })},
      {"order", ticks([](auto& message) { message.set_first(~0ULL); })},
      {"the servo's state", steps([](auto& message) { message.mutable_start()->set_integers(0, 99); })},
      {"the servo's settings",
       steps([](auto& message) { message.mutable_settings(0)->mutable_values()->set_integers(2, 99); })},
  };
  const std::string changed = (folder.path() / "b.hlr").string();
  for (const auto& [what, it] : changes) {
    rewrite(path, changed, it);
    try {
      replay(changed);
      ADD_FAILURE() << what << " was taken";
    } catch (const Error& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.find(changed + ": "), 0U) << line;
      EXPECT_NE(line.find(what), std::string::npos) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
  }
}

// The rings hold 8192 steps, six seconds and what rounding up has given.
TEST_F(Recording, ARecorderThatGetsNoTimeReportsWhatItHasMissed) {
  {
    Loops loops(settings(), false);
    loops.run(9000);
    loops.recorder().start();
  }
  const ReplayReport report = replay(path);
  EXPECT_FALSE(report.difference);
  EXPECT_EQ(report.lost_steps, 808u);
  EXPECT_EQ(report.lost_ticks, 808u);
  EXPECT_EQ(report.steps, 8192u);
  EXPECT_EQ(report.unchecked_ticks, 8192u);
}

/// A recording that a page asks for while the loops run.
class PageRecording : public Recording {
 protected:
  static constexpr std::uint32_t kPage = 7;
  using Phase = PageRecordingStatus::Phase;
  std::shared_ptr<PageRecordings> pages = std::make_shared<PageRecordings>();

  RecorderSettings forPages() const {
    RecorderSettings settings;
    settings.pages = pages;
    settings.version = "test";
    return settings;
  }
  void ask(bool on, std::uint32_t owner = kPage) const { pages->ask(owner, on, monotonicNow_ns()); }
  Phase phase() const { return pages->status().phase; }
  void begin(Loops& loops) const {
    ask(true);
    while (phase() == Phase::kStarting) {
      loops.step();
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    ASSERT_EQ(phase(), Phase::kRunning) << pages->status().text;
  }
  FilePointer end() const {
    ask(false);
    test::waitFor([&] { return phase() == Phase::kReady; });
    return pages->open(kPage);
  }
  static std::string pathOf(const FilePointer& file) { return "/proc/self/fd/" + std::to_string(file->descriptor()); }
};

TEST_F(PageRecording, BegunInTheMiddleOfASessionItIsReplayedBitForBit) {
  Loops loops(forPages());
  for (const int before : {300, 1700}) {
    loops.run(before);
    begin(loops);
    const int touching = loops.touching();
    loops.run(2500);
    EXPECT_GT(loops.touching(), touching);
    const FilePointer file = end();
    ASSERT_TRUE(file);
    const ReplayReport report = replay(pathOf(file));
    EXPECT_FALSE(report.difference) << report.difference->what << ' ' << report.difference->number << ": "
                                    << report.difference->text;
    EXPECT_GE(report.steps, 2500u);
    EXPECT_GE(report.ticks, 2500u);
    EXPECT_GE(report.scenes, 3u);
    EXPECT_EQ(report.lost_steps + report.lost_ticks + report.unchecked_ticks, 0u);
    EXPECT_EQ(report.end, "stopped");
    pages->drop();
  }
}

TEST_F(PageRecording, AMemoryOfTheProxyThatNoSessionHasIsRefused) {
  Loops loops(forPages());
  loops.run(300);
  begin(loops);
  loops.run(300);
  const FilePointer file = end();
  const std::string changed = (folder.path() / "b.hlr").string();
  const auto taken = [&](const std::function<void(proto::RecordedProxy&)>& change_it) {
    rewrite(pathOf(file), changed, [&](proto::RecordingBlock& block) {
      if (block.has_proxy()) change_it(*block.mutable_proxy());
    });
    replay(changed);
  };
  int numbers = 0;
  EXPECT_NO_THROW(taken([&](auto& proxy) { numbers = proxy.memory().numbers_size(); }));
  EXPECT_GT(numbers, 20);
  for (int i = 0; i < numbers; ++i) {
    for (const double wrong : {std::nan(""), HUGE_VAL})
      EXPECT_THROW(taken([&](auto& proxy) { proxy.mutable_memory()->set_numbers(i, wrong); }), Error) << i;
  }
  try {
    taken([&](auto& proxy) { proxy.mutable_memory()->set_numbers(numbers - 1, -1); });
    ADD_FAILURE() << "a drag below 0 was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("the last target before the recording makes no sense: field_drag_Ns_m"),
              std::string::npos)
        << error.what();
  }
  EXPECT_THROW(taken([](auto& proxy) { proxy.mutable_memory()->add_numbers(0); }), Error);
  EXPECT_THROW(taken([](auto& proxy) { proxy.add_adhering(1); }), Error);
  EXPECT_THROW(taken([](auto& proxy) {
                 for (const double number : {0.5, 0.0, 0.0, 1.0}) proxy.add_adhering(number);
               }),
               Error);
  EXPECT_THROW(taken([](auto& proxy) {
                 for (std::uint64_t key = 1; key <= 1 + PiercedObjects::capacity(); ++key) proxy.add_pierced(key);
               }),
               Error);
}

TEST_F(PageRecording, IsOneAtATimeAndForItsPageAlone) {
  Loops loops(forPages());
  loops.run(100);
  begin(loops);
  ask(true, kPage + 1);
  EXPECT_EQ(pages->status().owner, kPage);
  ask(false, kPage + 1);
  EXPECT_EQ(phase(), Phase::kRunning);
  EXPECT_FALSE(pages->open(kPage));
  loops.run(500);
  EXPECT_TRUE(end());
  EXPECT_FALSE(pages->open(kPage + 1));
  // What the page still repeats begins no other one.
  ask(true);
  EXPECT_EQ(phase(), Phase::kReady);
  EXPECT_EQ(pages->status().begun, 1u);
}

TEST_F(PageRecording, EndsAndIsGoneWhenItsPageFallsSilent) {
  Loops loops(forPages());
  loops.run(100);
  begin(loops);
  pages->ask(kPage, true, monotonicNow_ns() - static_cast<std::int64_t>(1e9 * PageRecordings::kMaxSilence_s) - 1);
  test::waitFor([&] { return phase() == Phase::kNone; });
  EXPECT_FALSE(pages->open(kPage));
}

TEST_F(PageRecording, OfASceneThatCannotBeRecordedSaysSo) {
  struct Still final : PoseSource {
    bool moves() const override { return false; }
    Pose to() const override { return {}; }
    Pose at(std::int64_t) const override { return {}; }
    std::int64_t straightUntil(std::int64_t, std::int64_t until_ns, double) const override { return until_ns; }
    std::int64_t restsFrom_ns() const override { return 0; }
    Box reach(const Box& object) const override { return object; }
  };
  std::vector<Instance> instances = sceneOf("teapot")->instances;
  instances[0].driver = std::make_shared<Still>();
  const auto scene = makeSnapshot(std::move(instances));
  Recorder recorder(forPages(), {SimulatedDevice().info(), 1000, 1000, {}});
  recorder.scene(scene);
  recorder.start();
  SnapshotSlot slot(scene);
  ProxyLoop proxy(slot, {});
  ask(true);
  for (std::int64_t now_ns = kPeriod_ns; phase() == Phase::kStarting; now_ns += kPeriod_ns) {
    const TickRequest request{now_ns, Vec3(0, 0.2, 0), {}, {}};
    const ProxyStep step = proxy.step(now_ns, request.finger_D, request.commands, request.spring);
    {
      const RealtimeGuard guard;  // also in the tick whose memory the recorder wants
      recorder.tick(request, step, proxy, 0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  EXPECT_EQ(phase(), Phase::kNone);
  EXPECT_EQ(pages->status().text, "an object that is driven cannot be recorded");
}

TEST_F(Recording, TheTapsDoNotAllocate) {
  Recorder recorder(settings(), {SimulatedDevice().info(), 1000, 1000, {}});
  ProxyStep tick;
  tick.scene = 1;
  SnapshotSlot scenes(sceneOf("teapot"));
  const ProxyLoop proxy(scenes, {});
  const ServoRecord step;
  const RealtimeGuard guard;
  recorder.step(step);
  recorder.tick({}, tick, proxy, 0);
}

TEST_F(Recording, ItEndsAtItsSizeAndTheSessionGoesOn) {
  RecorderSettings small = settings();
  small.most_bytes = 200'000;
  std::string reported;
  std::atomic<bool> ended{false};
  small.report = [&](const std::string&, const std::string& line) {
    reported = line;
    ended = true;
  };
  {
    Loops loops(small);
    while (!ended) loops.run(100);
    loops.run(1000);
  }
  EXPECT_NE(reported.find("200000 bytes are reached"), std::string::npos) << reported;
  const ReplayReport report = replay(path);
  EXPECT_FALSE(report.difference);
  EXPECT_EQ(report.end, "200000 bytes are reached");
  EXPECT_LT(std::filesystem::file_size(path), 1'500'000u);
}

// Files of this process may not grow beyond this, as on a disk that gets full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = std::signal(SIGXFSZ, SIG_IGN);
};

TEST_F(Recording, OfADiskThatGetsFullIsLostAndTheSessionGoesOn) {
  RecorderSettings full = settings();
  std::string reported;
  std::atomic<bool> lost{false};
  full.report = [&](const std::string&, const std::string& line) { reported = line; };
  full.lost = [&] { lost = true; };
  {
    const FullDisk disk(1'500'000);
    Loops loops(full);
    while (!lost) loops.run(100);
    loops.run(1000);
  }
  EXPECT_NE(reported.find("the recording ends: "), std::string::npos) << reported;
  const ReplayReport report = replay(path);
  EXPECT_FALSE(report.difference);
  EXPECT_GT(report.steps, 100u);
}

// The whole of what the recorder's thread had written is readable, to the last block, by others too while it goes on.
// The program makes fewer steps than the rings hold: however late that thread is, nothing is missed.
TEST_F(Recording, OfAKilledProgramIsReadable) {
  const pid_t child = fork();
  if (child == 0) {
    Loops loops(settings());
    loops.run(4000);
    while (true) pause();
  }
  test::waitFor([&] {
    try {
      const ReplayReport so_far = replay(path);
      return so_far.steps > 500 && so_far.ticks > 500;
    } catch (const Error&) {  // not yet begun
      return false;
    }
  });
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  const ReplayReport report = replay(path);
  EXPECT_FALSE(report.difference);
  EXPECT_GT(report.steps, 500u);
  EXPECT_GT(report.ticks, 500u);
  EXPECT_EQ(report.end, "");
}

TEST_F(Recording, AFaultLeavesABlackBoxThatReplays) {
  RecorderSettings box;
  box.black_box_folder = (folder.path() / "boxes").string();
  std::string reported;
  box.report = [&](const std::string&, const std::string& line) { reported = line; };
  {
    Loops loops(box);
    loops.run(990);
    loops.lose();
    loops.run(8);
  }
  ASSERT_EQ(boxes().size(), 1u);
  EXPECT_NE(reported.find(boxes()[0].string()), std::string::npos) << reported;
  SafetyState last{};
  const ReplayReport report =
      replay(boxes()[0].string(), [&](double, const ServoRecord& step) { last = step.out.safety; });
  EXPECT_FALSE(report.difference);
  EXPECT_TRUE(report.black_box);
  EXPECT_EQ(report.fault, faultText(FaultReason::kDeviceLost));
  EXPECT_EQ(report.steps, 998u);
  EXPECT_EQ(last, SafetyState::kFault);
}

TEST_F(Recording, BlackBoxesAreBounded) {
  RecorderSettings box;
  box.black_box_folder = (folder.path() / "boxes").string();
  box.black_boxes = 3;
  for (int i = 0; i < 6; ++i) {
    Loops loops(box);
    loops.run(400);
    loops.lose();
    loops.run(2);
  }
  EXPECT_EQ(boxes().size(), 3u);
}

TEST_F(Recording, AWholeSessionOnTheRealClockIsReproduced) {
  TouchSettings touch;
  touch.sink = recorderWith(settings());
  {
    TouchSession session(sceneOf("teapot"), touch);
    session.start();
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    session.live().setStiffness(700);
    session.publish(sceneOf("sphere:500"));
    session.live().setWorkspace({Vec3(0.01, 0, 0), 1.5});
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    session.stop();
    const ReplayReport report = replay(path);
    EXPECT_FALSE(report.difference) << report.difference->what << " " << report.difference->number << " "
                                    << report.difference->text;
    EXPECT_EQ(report.steps, session.servoTotals().steps);
    EXPECT_EQ(report.ticks, session.proxyTotals().steps);
    EXPECT_EQ(report.scenes, 2u);
  }
}

}  // namespace
}  // namespace hl::test_recorder
