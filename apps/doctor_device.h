// One device looked at closely: what stands between it and its user, and a test of what it does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "device/examine_device.h"
#include "tools/self_test_run.h"

namespace hl {

struct DeviceExamination {
  std::string kind;
  std::string name;  ///< as the driver has it; empty: it did not open
  std::vector<Finding> findings;
  std::optional<SelfTestRun> test;

  bool opened() const { return !name.empty(); }
  /// Ids of USB are a hint: a device that works need not have one that is known.
  bool good() const;
};

/// Looks, prints what it finds while it goes on, and with `self_test` tests what is ready for it. Throws hl::Error when
/// `spec` is no device.
DeviceExamination examineDevice(const std::string& spec, bool self_test);

}  // namespace hl
