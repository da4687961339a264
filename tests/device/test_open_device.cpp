// Devices by name: the one asked for, or a line that says what there is.
#include "device/open_device.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "device/simulated_hand.h"

namespace hl {
namespace {

std::string refusalOf(const std::string& spec) {
  try {
    makeDevice(spec);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(OpenDevice, TheSimulatedOneIsHeldByAHand) {
  for (const char* spec : {"sim", "sim:premium1.5"}) {
    const auto device = openDevice(spec);
    EXPECT_NE(device->hand(), nullptr);
    EXPECT_EQ(device->read(0).status, DeviceStatus::kOk);
    EXPECT_EQ(device->info().name, "simulated PHANToM Premium 1.5");
  }
}

TEST(OpenDevice, WhatIsNoDeviceIsRefusedWithWhatThereIs) {
  for (const char* spec : {"", "theremin", ":", "simulated", "sim2:premium1.5"})
    EXPECT_NE(refusalOf(spec).find(deviceSpecs()), std::string::npos) << spec << ": " << refusalOf(spec);
  EXPECT_NE(refusalOf("sim:abacus").find("premium1.5"), std::string::npos);
}

TEST(OpenDevice, EveryKindTellsOfItself) {
  const auto found = findDevices();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, "sim");
  for (const DevicePresence& device : found) {
    EXPECT_NE(deviceSpecs().find(device.kind), std::string::npos);
    EXPECT_FALSE(device.text.empty()) << device.kind;
  }
}

}  // namespace
}  // namespace hl
