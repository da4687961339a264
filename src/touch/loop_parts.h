// LoopParts: what the two real-time loops share. All of it outlives them.
#pragma once

#include <cstdint>

#include "device/device.h"
#include "touch/fault_group.h"
#include "touch/live_settings.h"
#include "touch/loop_exchange.h"
#include "touch/step_sink.h"
#include "touch/ticker.h"
#include "touch/touch_views.h"

namespace hl {

/// The place of one device among those whose faults are joined. RT-safe.
struct FaultSeat {
  FaultGroup* group = nullptr;  ///< null: its faults are its own
  std::uint32_t number = 0;

  bool othersFail() const { return group != nullptr && group->othersFail(number); }
  void set(bool at_fault) const {
    if (group != nullptr) group->set(number, at_fault);
  }
};

struct LoopParts {
  Device& device;
  LiveSettings& live;
  LoopExchange& exchange;
  Ticker& ticker;
  TouchViews& views;
  StepSink& sink;
  FaultSeat faults;
};

inline std::int64_t periodOf_ns(double rate_Hz) { return static_cast<std::int64_t>(1e9 / rate_Hz); }

}  // namespace hl
