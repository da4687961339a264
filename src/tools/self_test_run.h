// runSelfTest: a SelfTest on the real clock, with the servo's priority and watchdog.
#pragma once

#include <functional>

#include "base/histogram.h"
#include "base/realtime.h"
#include "tools/self_test.h"

namespace hl {

struct SelfTestRun {
  SelfTestReport report;
  double rate_Hz = 0;
  std::uint64_t steps = 0, deadlines_missed = 0;
  Histogram calls;  ///< time in the driver, for each step: read and write
  RealtimeGrant grant;
  std::vector<std::string> faults;  ///< empty: passed
};

/// Tests `device`, which is open and ready, for 20 s. `report` is called with each part as it begins, on this thread.
SelfTestRun runSelfTest(Device& device, const std::function<void(SelfTestPart)>& report);

}  // namespace hl
