// Two devices of one driver at once: each is its own, and one that goes and comes back is not felt at the other.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/error.h"
#include "device/device_claim.h"
#include "device/fakes/twin_bench.h"
#include "device/open_device.h"
#include "guard/realtime_guard.h"
#include "wait_for.h"

namespace hl::test::test_two_devices {
namespace {

const std::array<Vec3, 2> kGoals{Vec3(-0.02, 0.01, 0), Vec3(0.02, -0.01, 0.01)};
const std::array<Vec3, 2> kForces{Vec3(0.6, 0, 0.2), Vec3(-0.3, 0.5, 0)};

class TwoDevices : public testing::TestWithParam<TwinKind> {
 protected:
  void SetUp() override {
    bench_ = GetParam().make();
    for (std::size_t i = 0; i < 2; ++i) {
      bench_->arm(i).useVirtualClock();
      devices_[i] = bench_->device(i);
      bench_->arm(i).setHandGoal(kGoals[i]);
    }
  }
  void openAll() {
    for (const auto& device : devices_) device->open();
  }
  DeviceSample step(std::size_t number, const Vec3& force_N = Vec3::Zero()) {
    bench_->arm(number).advance(1e-3);
    const RealtimeGuard guard;
    const DeviceSample sample = devices_[number]->read(bench_->arm(number).now_ns());
    devices_[number]->write(force_N);
    return sample;
  }
  // Both make steps, with their forces, until `done`.
  template <typename Done>
  void until(const Done& done) {
    for (;;) {
      std::array<DeviceSample, 2> samples;
      for (std::size_t i = 0; i < 2; ++i) samples[i] = step(i, kForces[i]);
      expectNoMixing(samples);
      if (done(samples) || HasFailure()) return;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }
  // Whatever happens: a place that is reported is the device's own, and a force that is there is its own or none.
  void expectNoMixing(const std::array<DeviceSample, 2>& samples) {
    if (!settled_) return;
    for (std::size_t i = 0; i < 2; ++i) {
      if (samples[i].status == DeviceStatus::kOk) {
        EXPECT_LT((samples[i].position - bench_->arm(i).trueTip_D()).norm(), 0.01) << i;
      }
      constexpr double kSame_N = 0.1;  // the arm may have moved since its motors were set; the forces are 1 N apart
      const Vec3 force = bench_->arm(i).force_D();
      EXPECT_TRUE((force - kForces[i]).norm() < kSame_N || force.norm() < 1e-12) << i << ": " << force.transpose();
    }
  }
  bool feels(std::size_t number) const {
    return (bench_->arm(number).force_D() - kForces[number]).norm() < GetParam().force_tolerance_N;
  }
  bool agrees(std::size_t number, const DeviceSample& sample) const {
    const Vec3 tip = bench_->arm(number).trueTip_D();
    return sample.status == DeviceStatus::kOk && (sample.position - tip).norm() <= GetParam().position_tolerance_m;
  }
  void untilBothFeelTheirOwn() {
    until([&](const auto& samples) { return agrees(0, samples[0]) && agrees(1, samples[1]) && feels(0) && feels(1); });
  }

  std::unique_ptr<TwinBench> bench_;
  std::array<std::unique_ptr<Device>, 2> devices_;
  bool settled_ = false;
};

TEST_P(TwoDevices, EachReportsItsOwnPlaceAndButtonsAndMakesItsOwnForce) {
  openAll();
  for (int i = 0; i < 1500; ++i) {
    for (std::size_t device : {0U, 1U}) step(device);
  }
  untilBothFeelTheirOwn();
  EXPECT_GT((bench_->arm(0).trueTip_D() - bench_->arm(1).trueTip_D()).norm(), 0.03);
  bench_->arm(1).buttons = 2;
  until([](const auto& samples) { return samples[1].buttons == 2 && samples[0].buttons == 0; });
  bench_->arm(0).buttons = 1;
  until([](const auto& samples) { return samples[1].buttons == 2 && samples[0].buttons == 1; });
}

TEST_P(TwoDevices, OneIsLostAndComesBackAndTheOtherGoesOn) {
  openAll();
  for (int i = 0; i < 1500; ++i) {
    for (std::size_t device : {0U, 1U}) step(device);
  }
  untilBothFeelTheirOwn();
  settled_ = true;
  for (const std::size_t lost : {0U, 1U, 0U}) {
    const std::size_t other = 1 - lost;
    bench_->arm(lost).lost = true;
    until([&](const auto& samples) { return samples[lost].status == DeviceStatus::kLost; });
    until([&](const auto& samples) { return agrees(other, samples[other]) && feels(other); });
    // A few tries to open it again.
    const auto tried = std::chrono::steady_clock::now() + std::chrono::milliseconds(250);
    until([&](const auto&) { return std::chrono::steady_clock::now() > tried; });
    bench_->arm(lost).lost = false;
    untilBothFeelTheirOwn();
  }
}

TEST_P(TwoDevices, OneIsClosedAndOpenedAndTheOtherGoesOn) {
  openAll();
  untilBothFeelTheirOwn();
  devices_[0]->close();
  waitFor([this] { return bench_->arm(0).force_D().norm() < 1e-12; });
  until([&](const auto& samples) { return agrees(1, samples[1]) && feels(1); });
  devices_[0]->open();
  untilBothFeelTheirOwn();
  devices_[1]->close();
  until([&](const auto& samples) { return agrees(0, samples[0]) && feels(0); });
}

// With a driver that does nothing between two calls: what the second device reads and feels are the same bits whether
// the first one is lost, comes back, or was never there.
TEST_P(TwoDevices, TheOtherIsTheSameBitsAsAlone) {
  if (!GetParam().virtual_time) return;
  const auto run = [this](bool with_first) {
    bench_.reset();
    SetUp();
    if (with_first) devices_[0]->open();
    devices_[1]->open();
    std::vector<Vec3> seen;
    for (int i = 0; i < 600; ++i) {
      if (with_first) bench_->arm(0).lost = i >= 100 && i < 300;
      if (with_first) step(0, kForces[0]);
      const DeviceSample sample = step(1, kForces[1] * (i % 50) / 50.0);
      seen.push_back(sample.position);
      seen.push_back(bench_->arm(1).force_D());
      seen.emplace_back(sample.status == DeviceStatus::kOk, sample.buttons, 0);
      if (i % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the lost one is tried meanwhile
    }
    for (const auto& device : devices_) device->close();
    return seen;
  };
  const std::vector<Vec3> alone = run(false), beside = run(true);
  ASSERT_EQ(alone.size(), beside.size());
  for (std::size_t i = 0; i < alone.size(); ++i) ASSERT_EQ(alone[i], beside[i]) << i / 3;
}

TEST_P(TwoDevices, OneOpenedTwiceIsRefusedAndStaysAsItWas) {
  openAll();
  untilBothFeelTheirOwn();
  if (GetParam().name == "Falcons") return;  // what refuses there is the transport's
  const auto again = bench_->device(1);
  EXPECT_THROW(again->open(), Error);
  untilBothFeelTheirOwn();
}

INSTANTIATE_TEST_SUITE_P(Drivers, TwoDevices, testing::ValuesIn(twinKinds()),
                         [](const auto& of) { return of.param.name; });

std::unique_ptr<TwinBench> twinsOf(const std::string& name) {
  for (const TwinKind& kind : twinKinds()) {
    if (kind.name == name) return kind.make();
  }
  return nullptr;
}

// The vendor's scheduler is never stopped for a device that is opened again, and none of its rounds leaves out another.
TEST(TwoTouchHd, TheSchedulerGoesOnWhileOneIsOpenedAgain) {
  const auto bench = twinsOf("HdByName");
  void* const fake = dlopen(HL_FAKE_HD, RTLD_NOW | RTLD_LOCAL);
  const auto starts = reinterpret_cast<unsigned (*)()>(dlsym(fake, "hlFakeStarts"));
  const auto rounds = reinterpret_cast<unsigned (*)()>(dlsym(fake, "hlFakeRounds"));
  const auto frames = reinterpret_cast<unsigned (*)(std::size_t)>(dlsym(fake, "hlFakeFrames"));
  const auto left = bench->device(0), right = bench->device(1);
  left->open();
  right->open();
  const auto statusOf = [](Device& device) { return device.read(monotonicNow_ns()).status; };
  waitFor([&] { return statusOf(*left) == DeviceStatus::kOk && statusOf(*right) == DeviceStatus::kOk; });
  const unsigned starts_before = starts();
  const unsigned frames_before = frames(1), rounds_before = rounds();
  bench->arm(0).lost = true;
  waitFor([&] { return statusOf(*left) == DeviceStatus::kLost; });
  const unsigned lost_at = rounds();
  waitFor([&] { return rounds() > lost_at + 400; });
  bench->arm(0).lost = false;
  waitFor([&] { return statusOf(*left) == DeviceStatus::kOk; });
  const unsigned rounds_after = rounds(), frames_after = frames(1);
  EXPECT_EQ(starts(), starts_before);
  EXPECT_GE(frames_after - frames_before + 1, rounds_after - rounds_before);
  left->close();
  waitFor([&] { return statusOf(*right) == DeviceStatus::kOk; });
  EXPECT_EQ(starts(), starts_before);
  right->close();
  dlclose(fake);
}

TEST(TwoForceDimension, AnIndexThatIsNotThereIsReportedWithHowManyThereAre) {
  const auto bench = twinsOf("DhdByIndex");
  try {
    openDevice("dhd:2");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no dhd:2: the library finds 2"), std::string::npos) << error.what();
  }
  for (const DevicePresence& found : findDevices()) {
    if (found.kind == "dhd") {
      EXPECT_EQ(found.text, "2 Force Dimension devices: dhd:0 to dhd:1");
    }
  }
}

TEST(DeviceClaim, IsOnesUntilItIsReleased) {
  DeviceClaim one("hand 1");
  EXPECT_TRUE(DeviceClaim::isTaken("hand 1"));
  EXPECT_THROW(DeviceClaim("hand 1"), Error);
  DeviceClaim moved = std::move(one);
  EXPECT_TRUE(DeviceClaim::isTaken("hand 1"));
  moved = DeviceClaim("hand 2");
  EXPECT_FALSE(DeviceClaim::isTaken("hand 1"));
  moved.release();
  EXPECT_FALSE(DeviceClaim::isTaken("hand 2"));
}

}  // namespace
}  // namespace hl::test::test_two_devices
