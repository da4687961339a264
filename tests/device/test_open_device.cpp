// Devices by name: the one asked for, or a line that says what there is.
#include "device/open_device.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "device/named_device.h"
#include "device/simulated_hand.h"

namespace hl::test_open_device {
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

TEST(OpenDevice, WhichOfSeveralIsWrittenBehindTheKind) {
  for (const char* spec : {"dhd", "dhd:0", "dhd:15", "dhd:serial=1234", "falcon", "falcon:1", "falcon:file.bin",
                           "falcon:1,file.bin", "hd", "hd:Left Device", "haply", "haply:049D", "haply:ws://lab/049D"})
    EXPECT_EQ(refusalOf(spec), "") << spec;
  for (const char* spec : {"dhd:16", "dhd:-1", "dhd:one", "dhd:serial=", "dhd:serial=x", "dhd:serial=70000", "dhd:1 "})
    EXPECT_NE(refusalOf(spec).find("dhd:serial=1234"), std::string::npos) << spec;
  EXPECT_NE(refusalOf("falcon:100").find("falcon:1"), std::string::npos);
  EXPECT_NE(refusalOf("hd:Left\nDevice").find("control character"), std::string::npos);
}

TEST(OpenDevice, SpecsOfOneDeviceHaveOneKey) {
  EXPECT_EQ(deviceKey("sim"), "");
  EXPECT_EQ(deviceKey("replay:a.hlr"), "");
  EXPECT_EQ(deviceKey("dhd"), deviceKey("dhd:0"));
  EXPECT_NE(deviceKey("dhd"), deviceKey("dhd:1"));
  EXPECT_EQ(deviceKey("falcon:firmware.bin"), deviceKey("falcon:0"));
  EXPECT_EQ(deviceKey("falcon:1,a.bin"), deviceKey("falcon:1"));
  EXPECT_EQ(deviceKey("haply"), deviceKey("haply:ws://localhost:10001"));
  EXPECT_EQ(deviceKey("haply:049D"), deviceKey("haply:ws://localhost/049D"));
  EXPECT_NE(deviceKey("haply:049D"), deviceKey("haply:04A1"));
  EXPECT_NE(deviceKey("hd"), deviceKey("hd:Right Device"));
}

std::string namesOf(const std::vector<std::string>& texts) {
  std::vector<NamedDevice> devices;
  std::string names;
  try {
    for (const std::string& text : texts) devices.push_back(parseNamedDevice(text));
    for (const NamedDevice& device : withNames(devices)) names += device.name + "=" + device.spec + ";";
  } catch (const Error& error) {
    return error.what();
  }
  return names;
}

TEST(NamedDevices, HaveTheNamesOfTheirUserOrThoseOfTwoHands) {
  EXPECT_EQ(namesOf({"sim"}), "=sim;");
  EXPECT_EQ(namesOf({"pen=sim"}), "pen=sim;");
  EXPECT_EQ(namesOf({"sim", "sim"}), "left=sim;right=sim;");
  EXPECT_EQ(namesOf({"sim", "sim", "sim:touch"}), "device0=sim;device1=sim;device2=sim:touch;");
  EXPECT_EQ(namesOf({"hd:Left Device", "camera=sim"}), "left=hd:Left Device;camera=sim;");
  EXPECT_EQ(namesOf({"dhd:serial=1", "b-2_x=dhd:serial=2"}), "left=dhd:serial=1;b-2_x=dhd:serial=2;");
  EXPECT_EQ(namesOf({"left=haply:ws://lab/A=B"}), "left=haply:ws://lab/A=B;");
}

TEST(NamedDevices, OfOneNameOrOfOneDeviceAreRefused) {
  for (const char* text :
       {"=sim", "1st=sim", "a b=sim", "a\"=sim", "ümlaut=sim", "-a=sim", "a23456789012345678901234567890123=sim"})
    EXPECT_NE(namesOf({text}).find("is no name of a device"), std::string::npos) << text;
  EXPECT_NE(namesOf({"sim", "left=sim"}).find("two devices have the name 'left'"), std::string::npos);
  EXPECT_NE(namesOf({"dhd", "dhd:0"}).find("'left' and 'right' are one device"), std::string::npos);
  EXPECT_NE(namesOf({"hd", "sim", "x=hd"}).find("'device0' and 'x' are one device: hd and hd"), std::string::npos);
}

TEST(OpenDevice, EveryKindDescribesItself) {
  const auto found = findDevices();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, "sim");
  for (const DevicePresence& device : found) {
    EXPECT_NE(deviceSpecs().find(device.kind), std::string::npos);
    EXPECT_FALSE(device.text.empty()) << device.kind;
  }
}

}  // namespace
}  // namespace hl::test_open_device
