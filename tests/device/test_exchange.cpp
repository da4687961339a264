// Between the servo and a driver's own thread: what is reported late keeps its time.
#include "device/exchange.h"

#include <gtest/gtest.h>

namespace hl::test_exchange {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

TEST(Exchange, ASampleReportedLateIsAsOldAsTheQuestionThatItAnswers) {
  Exchange exchange;
  exchange.report(monotonicNow_ns() - 40 * kMillisecond_ns, {1, 2, 3}, 5, DeviceStatus::kOk);
  const DeviceSample sample = exchange.newest(7);  // the servo's clock is its own
  EXPECT_EQ(sample.time_ns, 7);
  EXPECT_EQ(sample.position, Vec3(1, 2, 3));
  EXPECT_EQ(sample.buttons, 5U);
  EXPECT_EQ(sample.status, DeviceStatus::kOk);
  EXPECT_GE(sample.age_ns, 40 * kMillisecond_ns);
}

TEST(Exchange, TheSameSampleGrowsOlderByTheClockOfTheServo) {
  Exchange exchange;
  exchange.report(monotonicNow_ns(), Vec3::Zero(), 0, DeviceStatus::kOk);
  const std::int64_t age_ns = exchange.newest(1000).age_ns;
  EXPECT_EQ(exchange.newest(1250).age_ns, age_ns + 250);
}

TEST(Exchange, WhatIsTooOldOrWasNeverReportedIsNoPlace) {
  Exchange exchange;
  EXPECT_EQ(exchange.newest(0).status, DeviceStatus::kNotReady);
  exchange.report(monotonicNow_ns() - 200 * kMillisecond_ns, Vec3::Zero(), 0, DeviceStatus::kOk);
  EXPECT_EQ(exchange.newest(0).status, DeviceStatus::kLost);
  exchange.report(monotonicNow_ns(), Vec3::Zero(), 0, DeviceStatus::kOk);
  exchange.reportLost();
  EXPECT_EQ(exchange.newest(0).status, DeviceStatus::kLost);
}

}  // namespace
}  // namespace hl::test_exchange
