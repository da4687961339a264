// The Falcon's kinematics, its frames, its firmware and its homing.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <random>
#include <thread>

#include "base/error.h"
#include "device/fakes/falcon_line.h"
#include "device/falcon/falcon_device.h"
#include "device/falcon/falcon_firmware.h"
#include "device/falcon/falcon_kinematics.h"
#include "temp_folder.h"

namespace hl::test::test_falcon {
namespace {

Vec3 somewhere(std::mt19937& random) {
  std::uniform_real_distribution<> part(-0.04, 0.04);
  return kFalconCentre_F + Vec3(part(random), part(random), part(random));
}

TEST(FalconKinematics, TheTipIsFoundAgainFromTheAnglesThatItGives) {
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 tip = somewhere(random);
    Vec3 angles;
    ASSERT_TRUE(falconAngles(tip, angles)) << tip.transpose();
    Vec3 found = kFalconCentre_F;
    ASSERT_TRUE(falconTip(angles, found)) << tip.transpose();
    EXPECT_LT((found - tip).norm(), 1e-9);
  }
}

TEST(FalconKinematics, RatesAreTheDifferencesOfTheAngles) {
  constexpr double kStep_m = 1e-6;
  std::mt19937 random(2);
  for (int i = 0; i < 2'000; ++i) {
    const Vec3 tip = somewhere(random);
    Vec3 angles;
    ASSERT_TRUE(falconAngles(tip, angles));
    const Mat3 rates = falconAngleRates(tip, angles);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 before, after;
      ASSERT_TRUE(falconAngles(tip - kStep_m * Vec3::Unit(axis), before));
      ASSERT_TRUE(falconAngles(tip + kStep_m * Vec3::Unit(axis), after));
      EXPECT_LT(((after - before) / (2 * kStep_m) - rates.col(axis)).norm(), 1e-6 * rates.norm());
    }
  }
}

TEST(FalconKinematics, TorquesDoTheWorkOfTheForce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> part(-1, 1);
  for (int i = 0; i < 2'000; ++i) {
    const Vec3 tip = somewhere(random);
    const Vec3 force(part(random), part(random), part(random)), velocity(part(random), part(random), part(random));
    Vec3 angles, torques;
    ASSERT_TRUE(falconAngles(tip, angles));
    ASSERT_TRUE(falconTorques(tip, angles, force, torques));
    EXPECT_NEAR(torques.dot(falconAngleRates(tip, angles) * velocity), force.dot(velocity), 1e-10);
  }
}

// Three legs at 120 degrees: what is turned by that much about z exchanges the legs.
TEST(FalconKinematics, LegsAreAlike) {
  std::mt19937 random(4);
  const Mat3 turn = Eigen::AngleAxisd(2 * M_PI / 3, Vec3::UnitZ()).toRotationMatrix();
  for (int i = 0; i < 100; ++i) {
    const Vec3 tip = somewhere(random);
    Vec3 angles, turned;
    ASSERT_TRUE(falconAngles(tip, angles));
    if (!falconAngles(turn * tip, turned)) continue;
    EXPECT_LT((turned - Vec3(angles[1], angles[2], angles[0])).norm(), 1e-12);
  }
}

TEST(FalconKinematics, OutOfReachIsSaid) {
  Vec3 angles, tip = kFalconCentre_F;
  EXPECT_FALSE(falconAngles(Vec3(0, 0, 0.5), angles));
  EXPECT_FALSE(falconAngles(Vec3(0.3, 0, 0.1), angles));
  EXPECT_FALSE(falconTip(Vec3(3, -3, 3), tip));
  EXPECT_EQ(tip, kFalconCentre_F);
}

TEST(FalconProtocol, FramesAreAsTheDeviceExpectsThem) {
  const FalconFrame frame = encode({{0x1234, -1, 0}, true});
  EXPECT_EQ(std::string(frame.begin(), frame.end()), "<EDCBPPPPAAAABA>");
}

TEST(FalconProtocol, RepliesAreFoundWhateverIsAroundThem) {
  const std::string text = "AB>x<EDCBPPPPAAAADA><AAA";
  FalconReply reply;
  ASSERT_TRUE(decode({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, reply));
  EXPECT_EQ(reply.encoders, (std::array<std::int16_t, 3>{0x1234, -1, 0}));
  EXPECT_EQ(reply.buttons, 3);
  EXPECT_EQ(reply.homed, 0);
  for (const std::string bad : {"", "<", "<AAAAAAAAAAAAAA", "AAAAAAAAAAAAAAAA", "<AAAAAAAAAAAAA>"})
    EXPECT_FALSE(decode({reinterpret_cast<const std::uint8_t*>(bad.data()), bad.size()}, reply)) << bad;
}

struct Falcon : testing::Test {
  Falcon() {
    for (int i = 0; i < 1000; ++i) box.firmware.push_back(static_cast<std::uint8_t>(i * 7));
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(box.firmware.data()), static_cast<std::streamsize>(box.firmware.size()));
  }
  std::unique_ptr<FalconDevice> device(const std::string& firmware) {
    return std::make_unique<FalconDevice>(std::make_unique<FakeFalconLine>(box), firmware);
  }
  static void waitFor(FalconDevice& device, DeviceStatus status) {
    while (device.read(0).status != status) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  FalconBox box;
  const std::string file = tempFile("falcon.bin");
};

TEST_F(Falcon, TakesItsFirmwareOnce) {
  auto falcon = device(file);
  falcon->open();
  EXPECT_TRUE(box.running);
  waitFor(*falcon, DeviceStatus::kOk);
  falcon->close();
  device("/nonexistent")->open();  // it has it still
}

TEST_F(Falcon, WithoutItsFirmwareItSaysWhereItIsToBeHad) {
  unsetenv("HL_FALCON_FIRMWARE");
  const std::string other = fileWith("other.bin", "no firmware");
  for (const std::string& firmware : {std::string(), std::string("/nonexistent"), other}) {
    const auto falcon = device(firmware);
    EXPECT_THROW(falcon->open(), Error) << firmware;
    EXPECT_EQ(falcon->read(0).status, DeviceStatus::kNotReady);
  }
  EXPECT_FALSE(box.running);
}

TEST_F(Falcon, IsNotReadyAndHoldsNoForceUntilAllLegsAreHomed) {
  auto falcon = device(file);
  box.homed = 5;
  falcon->open();
  for (int i = 0; i < 50; ++i) {
    falcon->write(Vec3(0, 1, 0));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_EQ(falcon->read(0).status, DeviceStatus::kNotReady);
    ASSERT_EQ(box.arm.force_D(), Vec3(Vec3::Zero()));
  }
  EXPECT_TRUE(box.asked_to_home);
  box.homed = 7;
  waitFor(*falcon, DeviceStatus::kOk);
  while (box.asked_to_home) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace
}  // namespace hl::test::test_falcon
