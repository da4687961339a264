// Bench: a driver and the fake it talks to. One entry for each driver; the contract runs over all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/device.h"
#include "device/fakes/fake_arm.h"

namespace hl::test {

class Bench {
 public:
  virtual ~Bench() = default;
  virtual FakeArm& arm() = 0;
  virtual std::unique_ptr<Device> device() = 0;  ///< not open; the bench outlives it
};

struct BenchKind {
  std::string name;
  std::unique_ptr<Bench> (*make)();
  double position_tolerance_m;  ///< between what the driver reads and the true tip
  double force_tolerance_N;     ///< between what it is commanded and what the motors make
};

std::vector<BenchKind> benchKinds();

}  // namespace hl::test
