// TickBeside: a tick by another thread than the servo's: what goes into it, and who gets what comes out. The servo
// follows its contacts until the next one has come.
#pragma once

#include <cstdint>

#include "touch/loop_parts.h"

namespace hl {

/// By the thread that ticks, while it is its turn. RT-safe.
class TickBeside {
 public:
  TickBeside(const LoopParts& parts, double rate_Hz) : parts_(parts), period_s_(1 / rate_Hz) {}

  Ticker& ticker() const { return parts_.ticker; }
  /// A tick begins: with the newest finger and settings.
  const TickRequest& begin(std::int64_t now_ns);
  void end(const ProxyStep& step);

 private:
  LoopParts parts_;
  const double period_s_;
  TickRequest request_;
};

}  // namespace hl
