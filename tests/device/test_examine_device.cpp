// A device looked at closely: each thing that can be wrong is found, and says what to do.
#include "device/examine_device.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"
#include "device/fakes/bench.h"
#include "device/open_device.h"

namespace hl::test::test_examine_device {
namespace {

const UsbDevice kFalcon{0x0403, 0xcb48, "Novint Falcon", true}, kMouse{0x046d, 0xc077, "Mouse", true};

Finding findingOf(const std::vector<Finding>& findings, const std::string& what) {
  for (const Finding& finding : findings)
    if (finding.what == what) return finding;
  return {"none", false, "", ""};
}

std::unique_ptr<Bench> benchOf(const std::string& name) {
  for (const BenchKind& kind : benchKinds())
    if (kind.name == name) return kind.make();
  return nullptr;
}

TEST(ExamineDevice, ADeviceThatIsNotSeenIsReportedWithWhatIs) {
  const Finding usb = findingOf(examineSurroundings("falcon", {kMouse}), "usb");
  EXPECT_FALSE(usb.good);
  EXPECT_EQ(usb.text, "expected 0403:cb48, seen: 046d:c077 Mouse");
  EXPECT_NE(usb.advice.find("cable"), std::string::npos);
  EXPECT_EQ(findingOf(examineSurroundings("dhd", {}), "usb").text, "expected 1451:*, seen: nothing");
}

TEST(ExamineDevice, ADeviceThatMayNotBeUsedComesWithTheRuleForIt) {
  UsbDevice barred = kFalcon;
  barred.may_be_used = false;
  const Finding usb = findingOf(examineSurroundings("falcon", {kMouse, barred}), "usb");
  EXPECT_FALSE(usb.good);
  EXPECT_NE(usb.advice.find(udevRuleFor({0x0403, 0xcb48})), std::string::npos);
  EXPECT_TRUE(findingOf(examineSurroundings("falcon", {kFalcon}), "usb").good);
}

TEST(ExamineDevice, TheTouchIsKnownByAllItsIds) {
  for (const UsbDevice& touch :
       {UsbDevice{0x2988, 0x0302, "", true}, UsbDevice{0x2988, 0x0304, "", true}, UsbDevice{0x0301, 0x2988, "", true}})
    EXPECT_TRUE(findingOf(examineSurroundings("hd", {touch}), "usb").good);
}

TEST(ExamineDevice, ALibraryThatIsThereIsNamedAndOneThatIsNotComesWithWhatToInstall) {
  setenv("HL_DHD_LIBRARY", HL_FAKE_DHD, 1);
  const Finding there = findingOf(examineSurroundings("dhd", {}), "library");
  EXPECT_TRUE(there.good);
  EXPECT_EQ(there.text.rfind("libdhd.so", 0), 0U) << there.text;
  setenv("HL_DHD_LIBRARY", "/nonexistent/libdhd.so.3", 1);
  const Finding missing = findingOf(examineSurroundings("dhd", {}), "library");
  EXPECT_FALSE(missing.good);
  EXPECT_NE(missing.advice.find("Force Dimension SDK"), std::string::npos);
}

TEST(ExamineDevice, ASimulatedOneIsGood) {
  const auto device = makeDevice("sim:touch");
  EXPECT_TRUE(allGood(examineSurroundings("sim:touch", {})));
  EXPECT_TRUE(allGood(examineOpening("sim:touch", *device, 1)));
}

TEST(ExamineDevice, EachFakeIsGood) {
  for (const char* name : {"ForceDimension", "TouchHd", "Falcon"}) {
    const auto bench = benchOf(name);
    const auto device = bench->device();
    EXPECT_TRUE(allGood(examineOpening("dhd", *device, 60))) << name;
  }
}

TEST(ExamineDevice, OneThatIsNotCalibratedSaysHowToCalibrateIt) {
  const auto bench = benchOf("ForceDimension");
  bench->arm().not_ready = true;
  const auto device = bench->device();
  const Finding ready = findingOf(examineOpening("dhd", *device, 0.01), "ready");
  EXPECT_FALSE(ready.good);
  EXPECT_NE(ready.advice.find("calibrate it"), std::string::npos);
  bench->arm().not_ready = false;
}

TEST(ExamineDevice, OneThatCannotBeOpenedSaysWhy) {
  const auto bench = benchOf("ForceDimension");
  bench->arm().lost = true;
  const auto device = bench->device();
  const auto findings = examineOpening("dhd", *device, 0.01);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_FALSE(findings[0].good);
  EXPECT_NE(findings[0].text.find("no Force Dimension device answers"), std::string::npos);
  bench->arm().lost = false;
}

TEST(ExamineDevice, EveryKindOfDeviceIsKnown) {
  for (const DevicePresence& device : findDevices()) EXPECT_FALSE(examineSurroundings(device.kind, {}).empty());
}

TEST(ExamineDevice, WhatIsNoDeviceIsRefused) { EXPECT_THROW(examineSurroundings("theremin", {}), Error); }

}  // namespace
}  // namespace hl::test::test_examine_device
