// LoopParts: what the two real-time loops share. All of it outlives them.
#pragma once

#include <cstdint>

#include "device/device.h"
#include "touch/live_settings.h"
#include "touch/loop_exchange.h"
#include "touch/step_sink.h"
#include "touch/ticker.h"
#include "touch/touch_views.h"

namespace hl {

struct LoopParts {
  Device& device;
  LiveSettings& live;
  LoopExchange& exchange;
  Ticker& ticker;
  TouchViews& views;
  StepSink& sink;
};

inline std::int64_t periodOf_ns(double rate_Hz) { return static_cast<std::int64_t>(1e9 / rate_Hz); }

}  // namespace hl
