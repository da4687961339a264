// BodyLoop: a step of the bodies as a loop makes it: first what clients do to them, then the step, then the events of
// it.
#pragma once

#include <cstdint>
#include <span>

#include "touch/body_command.h"
#include "touch/body_events.h"
#include "touch/body_world.h"

namespace hl {

/// pop() by one thread, the rest by one other; RT-safe.
class BodyLoop {
 public:
  /// Whether what clients do waits for the next step().
  bool waiting() const { return !to_do_.empty(); }
  /// Keeps what is to be done to the bodies in the next step(). What there is no room for is dropped: one call between
  /// two steps.
  void act(const BodyCommands& commands) {
    for (const BodyCommand& command : commands) to_do_.push(command);
  }
  /// Takes what was kept for the next step(), for another loop whose step does it to the bodies; done() gives it
  /// too.
  const BodyCommands& takeCommands();
  /// What was done to the bodies in the last step.
  const BodyCommands& done() const { return done_; }
  /// `bodies`: those of `scene`; null: it has none.
  void step(const Snapshot& scene, BodyWorld* bodies, std::int64_t now_ns, double period_s,
            std::span<const HandAtBodies> hands);
  /// In place of step(): nothing was done to the bodies.
  void skip() { done_.clear(); }
  bool pop(BodyEvent& event) { return events_.pop(event); }

 private:
  BodyCommands to_do_, done_;
  BodyEvents events_;
};

}  // namespace hl
