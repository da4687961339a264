// What only Haply's service does: dialects, grips, silence, a service that goes and comes.
#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "device/fakes/haply_service.h"
#include "device/haply/haply_device.h"
#include "device/haply/haply_messages.h"
#include "device/open_device.h"
#include "wait_for.h"

namespace hl::test::test_haply {
namespace {

std::string failureOf(const std::string& spec) {
  try {
    openDevice(spec);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(HaplyMessages, TheDialectGoesByTheVersion) {
  for (const char* version : {"3.5", "3.5.1", "{\"version\":\"3.10.0\"}", "v4.0", "4"})
    EXPECT_EQ(haplyDialectOf(version), HaplyDialect::kVector) << version;
  for (const char* version : {"3.1.2", "{\"version\":\"3.0\"}", "2.9", "", "none"})
    EXPECT_EQ(haplyDialectOf(version), HaplyDialect::kValues) << version;
}

TEST(HaplyMessages, WhatIsNotAsExpectedChangesNothing) {
  HaplyState state;
  ASSERT_TRUE(readHaplyMessage(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"x":1,"y":2,"z":3}}}],
      "verse_grip":[{"state":{"buttons":{"a":true,"c":true}}}]})",
                               state));
  ASSERT_TRUE(state.located);
  EXPECT_LT((state.position - Vec3(1, 2.8, -2.14)).norm(), 1e-12);
  EXPECT_EQ(state.buttons, 5U);
  for (const char* text : {"", "[]", "{", "7", "nan"}) EXPECT_FALSE(readHaplyMessage(text, state)) << text;
  for (const char* text :
       {"{}", R"({"inverse3":{}})", R"({"inverse3":[]})", R"({"inverse3":[7]})", R"({"inverse3":[{"device_id":3}]})",
        R"({"inverse3":[{"state":{"cursor_position":{"x":1,"y":"2","z":3}}}]})",
        R"({"inverse3":[{"state":{"cursor_position":{"x":1,"y":2}}}]})",
        R"({"wireless_verse_grip":[{"state":{"buttons":[true]}}]})"}) {
    EXPECT_TRUE(readHaplyMessage(text, state)) << text;
    EXPECT_FALSE(state.located) << text;
    EXPECT_EQ(state.device_id, "A") << text;
    EXPECT_EQ(state.buttons, 5U) << text;
  }
}

TEST(HaplyMessages, ButtonsHaveManyNames) {
  HaplyState state;
  ASSERT_TRUE(readHaplyMessage(R"({"verse_grip":[{"state":{"buttons":{"button_0":false,"button_3":true,"hall":true,
      "button_12":true,"b":1}}}]})",
                               state));
  EXPECT_EQ(state.buttons, 8U);
}

TEST(HaplyMessages, TheDeviceThatIsWantedIsReadWithItsOwnGrip) {
  constexpr const char* kTwo = R"({"inverse3":[
      {"device_id":"A","state":{"cursor_position":{"x":1,"y":2,"z":3}},"status":{"calibrated":true}},
      {"device_id":"B","state":{"cursor_position":{"x":4,"y":5,"z":6}},"status":{"calibrated":false}}],
      "wireless_verse_grip":[{"state":{"buttons":{"a":true}}},{"state":{"buttons":{"b":true}}}]})";
  EXPECT_EQ(haplyDevicesOf(kTwo), (std::vector<std::string>{"A", "B"}));
  EXPECT_TRUE(haplyDevicesOf("{").empty());
  HaplyState first, second, third;
  second.device_id = "B";
  third.device_id = "C";
  for (HaplyState* state : {&first, &second, &third}) ASSERT_TRUE(readHaplyMessage(kTwo, *state));
  EXPECT_EQ(first.device_id, "A");
  EXPECT_LT((first.position - Vec3(1, 2.8, -2.14)).norm(), 1e-12);
  EXPECT_EQ(first.buttons, 1U);
  EXPECT_TRUE(first.calibrated);
  EXPECT_LT((second.position - Vec3(4, 5.8, -5.14)).norm(), 1e-12);
  EXPECT_EQ(second.buttons, 2U);
  EXPECT_FALSE(second.calibrated);
  EXPECT_FALSE(third.located);
  EXPECT_EQ(third.device_id, "C");
  EXPECT_EQ(third.buttons, 0U);
}

TEST(HaplyAddress, IsAWebSocketsOrIsRefused) {
  EXPECT_EQ(HaplyAddress::parse("").text(), "ws://localhost:10001");
  EXPECT_EQ(HaplyAddress::parse("ws://lab").text(), "ws://lab:10001");
  EXPECT_EQ(HaplyAddress::parse("ws://lab:7/").text(), "ws://lab:7");
  EXPECT_EQ(HaplyAddress::parse("ws://lab").device_id, "");
  EXPECT_EQ(HaplyAddress::parse("ws://lab/049D").device_id, "049D");
  EXPECT_EQ(HaplyAddress::parse("ws://lab:7/049D").text(), "ws://lab:7");
  EXPECT_EQ(HaplyAddress::parse("049D").device_id, "049D");
  EXPECT_EQ(HaplyAddress::parse("049D").text(), "ws://localhost:10001");
  for (const char* url : {"lab:7", "ws://", "ws://:5", "wss://lab", "ws://lab:", "ws://lab:0", "ws://lab:70000",
                          "ws://lab:1x", "ws://lab/a/b", "ws://lab/049D?x=1", "ws://la\nb"})
    EXPECT_THROW(HaplyAddress::parse(url), Error) << url;
}

TEST(Haply, NoServiceOrNoDeviceIsALineThatSaysWhatToDo) {
  FakeArm arm;
  std::string url;
  {
    HaplyService service(arm, "3.5.0");
    url = service.url();
    service.has_device = false;
    EXPECT_NE(failureOf("haply:" + url).find("no Inverse3: check"), std::string::npos);
  }
  const std::string why = failureOf("haply:" + url);
  EXPECT_NE(why.find("install"), std::string::npos) << why;
  EXPECT_NE(why.find(url), std::string::npos) << why;
}

TEST(Haply, ADeviceThatIsNotThereIsReportedWithThoseThatAre) {
  FakeArm arm, other;
  HaplyService service(std::vector<FakeArm*>{&arm, &other}, "3.5.0");
  const std::string why = failureOf("haply:" + service.url() + "/FFFF");
  EXPECT_NE(why.find("no Inverse3 'FFFF': it has 049D, 04A1"), std::string::npos) << why;
}

TEST(Haply, SpeaksBothDialects) {
  for (const char* version : {"3.1.0", "3.5.0"}) {
    FakeArm arm;
    HaplyService service(arm, version);
    HaplyDevice device(service.url());
    device.open();
    EXPECT_EQ(device.info().name, "Haply Inverse3 049D");
    EXPECT_EQ(service.introductions, 1) << version;
    arm.buttons = 4;
    const Vec3 force(1, -0.5, 0.25);
    waitFor([&] {
      device.write(force);
      return (arm.force_D() - force).norm() < 2e-3 && device.read(0).buttons == 4;
    });
  }
}

TEST(Haply, AServiceThatFallsSilentIsLostAndComesBack) {
  FakeArm arm;
  HaplyService service(arm, "3.5.0");
  HaplyDevice device(service.url());
  device.open();
  waitFor([&] { return device.read(0).status == DeviceStatus::kOk; });
  service.silent = true;
  waitFor([&] { return device.read(0).status == DeviceStatus::kLost; });
  service.silent = false;
  waitFor([&] { return device.read(0).status == DeviceStatus::kOk; });
}

TEST(Haply, ADeviceThatIsNotCalibratedIsNotReady) {
  FakeArm arm;
  arm.not_ready = true;
  HaplyService service(arm, "3.5.0");
  HaplyDevice device(service.url());
  device.open();
  EXPECT_EQ(device.read(0).status, DeviceStatus::kNotReady);
  arm.not_ready = false;
  waitFor([&] { return device.read(0).status == DeviceStatus::kOk; });
}

TEST(Haply, AServoThatFeedsNoForceHoldsNone) {
  FakeArm arm;
  HaplyService service(arm, "3.5.0");
  HaplyDevice device(service.url());
  device.open();
  waitFor([&] {
    device.write(Vec3(0, 1, 0));
    return arm.force_D().y() > 0.9;
  });
  waitFor([&] { return arm.force_D().norm() < 1e-12; });
  EXPECT_EQ(device.read(0).status, DeviceStatus::kOk);
}

}  // namespace
}  // namespace hl::test::test_haply
