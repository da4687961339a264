// TwinBench: two devices of one driver at once, and the fakes behind them. One entry for each way to name the two.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "device/fakes/bench.h"

namespace hl::test {

class TwinBench {
 public:
  virtual ~TwinBench() = default;
  virtual FakeArm& arm(std::size_t number) = 0;                    ///< 0 and 1
  virtual std::unique_ptr<Device> device(std::size_t number) = 0;  ///< not open; the bench outlives it
};

struct TwinKind {
  std::string name;
  std::unique_ptr<TwinBench> (*make)();
  double position_tolerance_m, force_tolerance_N;  ///< as of BenchKind
  bool virtual_time;                               ///< it does nothing between two calls: the same calls, the same bits
};

std::vector<TwinKind> twinKinds();

}  // namespace hl::test
