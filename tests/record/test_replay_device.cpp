// A recording as a device: the same positions at the same times, there and back without a jump.
#include "record/replay_device.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "guard/realtime_guard.h"
#include "io/value_messages.h"
#include "record/recorded_servo.h"
#include "record/recording_file.h"
#include "temp_folder.h"

namespace hl::test_replay_device {
namespace {

constexpr int kSteps = 500;
constexpr std::int64_t kPeriod_ns = 1'000'000, kBegin_ns = 77'000'000;

Vec3 way(int i) { return 0.03 * Vec3(std::sin(0.01 * i), std::cos(0.02 * i), 0.001 * i); }

class Replayed : public testing::Test {
 protected:
  test::TempFolder folder;
  std::string path = (folder.path() / "a.hlr").string();

  static DeviceInfo pen() {
    DeviceInfo info;
    info.force_max_N = 3;
    info.friction_N = 0.1;
    return info;
  }
  void record(int steps, const DeviceInfo& info = pen(), std::int64_t period_ns = kPeriod_ns) const {
    RecordingWriter writer(path);
    proto::RecordingBlock start;
    start.mutable_start()->set_device_name("pen");
    toProto(valuesOf(info), *start.mutable_start()->mutable_device());
    writer.write(start);
    if (steps == 0) return;
    std::vector<ServoRecord> records(static_cast<std::size_t>(steps));
    for (int i = 0; i < steps; ++i) {
      DeviceSample& sample = records[static_cast<std::size_t>(i)].sample;
      sample.time_ns = kBegin_ns + i * period_ns;
      sample.position = way(i);
      sample.buttons = i > steps / 2 ? 1 : 0;
      sample.status = i % 50 == 7 ? DeviceStatus::kLost : DeviceStatus::kOk;
    }
    proto::RecordingBlock block;
    toProto(records, 0, *block.mutable_steps());
    writer.write(block);
  }
};

TEST_F(Replayed, TheFingerIsWhereItWasThenThereAndBack) {
  record(kSteps);
  const auto device = openAnyDevice("replay:" + path);
  EXPECT_EQ(device->info().name, "replay of pen");
  EXPECT_EQ(device->info().force_max_N, 3);
  EXPECT_EQ(device->info().friction_N, 0);
  const RealtimeGuard guard;
  for (int i = 0; i < 5 * kSteps; ++i) {
    const int lap = i % (2 * (kSteps - 1));
    const int then = lap < kSteps ? lap : 2 * (kSteps - 1) - lap;
    const DeviceSample sample = device->read(900 + i * kPeriod_ns);
    device->write(Vec3(1, 2, 3));
    ASSERT_EQ(sample.status, DeviceStatus::kOk);
    ASSERT_EQ(sample.time_ns, 900 + i * kPeriod_ns);
    if (then % 50 == 7) {  // lost then: between the two beside it
      ASSERT_LT((sample.position - 0.5 * (way(then - 1) + way(then + 1))).norm(), 1e-15) << i;
    } else {
      ASSERT_EQ(sample.position, way(then)) << i;
      ASSERT_EQ(sample.buttons, then > kSteps / 2 ? 1U : 0U) << i;
    }
  }
}

TEST_F(Replayed, ALongPauseOfTheClockIsNoHarm) {
  record(kSteps);
  const auto device = openAnyDevice("replay:" + path);
  device->read(0);
  const std::int64_t laps_ns = 1'000'003 * 2 * (kSteps - 1) * kPeriod_ns;
  EXPECT_EQ(device->read(laps_ns + 300 * kPeriod_ns).position, way(300));
}

TEST_F(Replayed, ADeviceThatThereIsNotIsRefusedInOneLine) {
  using Change = void (*)(DeviceInfo&);
  for (const Change change : std::vector<Change>{
           [](DeviceInfo& info) { info.servo_rate_Hz = 0; },
           [](DeviceInfo& info) { info.servo_rate_Hz = -1000; },
           [](DeviceInfo& info) { info.servo_rate_Hz = 1e300; },
           [](DeviceInfo& info) { info.servo_rate_Hz = std::nan(""); },
           [](DeviceInfo& info) { info.servo_rate_max_Hz = 0; },
           [](DeviceInfo& info) { info.force_max_N = -1; },
           [](DeviceInfo& info) { info.stiffness_max_N_m = HUGE_VAL; },
           [](DeviceInfo& info) { info.velocity_max_m_s = std::nan(""); },
           [](DeviceInfo& info) { info.workspace_min.y() = 1; },
           [](DeviceInfo& info) { info.workspace_max.z() = std::nan(""); },
       }) {
    DeviceInfo info = pen();
    change(info);
    record(kSteps, info);
    try {
      openAnyDevice("replay:" + path);
      ADD_FAILURE() << "it was taken";
    } catch (const Error& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.find(path + ": the device makes no sense"), 0U) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos);
    }
  }
}

TEST_F(Replayed, TimesThatNoClockGivesAreRefused) {
  record(3, pen(), std::int64_t{1} << 61);
  EXPECT_THROW(openAnyDevice("replay:" + path), Error);
}

TEST_F(Replayed, WhatCanNotBeReplayedIsReportedInOneLine) {
  EXPECT_THROW(makeAnyDevice("replay:"), Error);
  EXPECT_THROW(openAnyDevice("replay:" + path), Error);
  EXPECT_THROW(makeAnyDevice("replays"), Error);
  for (const int steps : {0, 1}) {
    record(steps);
    EXPECT_THROW(openAnyDevice("replay:" + path), Error) << steps;
  }
  EXPECT_NE(anyDeviceSpecs().find("|replay:FILE"), std::string::npos);
}

}  // namespace
}  // namespace hl::test_replay_device
