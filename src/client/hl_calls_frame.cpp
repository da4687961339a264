// The calls about frames: hlClear, hlFlush, hlFinish and what belongs to them; and hlPoll.
#include <hl/hl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/clock.h"
#include "base/duration.h"
#include "client/call.h"

using hl::client::call;
using hl::client::callOr;
using hl::client::Fault;
using hl::client::Outbox;
using hl::client::requireFinite;
using hl::client::When;

namespace {

constexpr double kForever_s = 1e9;  // decades; 1e18 ns still count in 64 bits

// The frame goes to those that wait. After the end of the conversation nobody waits any more.
void closeFrame(HLcontext& context) {
  hl::client::Draft frame = context.closeFrame();
  if (!context.conversation.hasEnded()) context.conversation.add(std::move(frame));
}

HLboolean finish(HLcontext& context, double seconds) {
  closeFrame(context);
  const std::int64_t wait_ns = hl::durationOf(std::min(seconds, kForever_s)).count();
  return context.conversation.finish(hl::monotonicNow_ns() + wait_ns, context.errors, context.events) ? HL_TRUE
                                                                                                      : HL_FALSE;
}

}  // namespace

void hlClear(void) {
  call(__func__, When::kNotInDefinition, [](HLcontext& context) { context.frame.world.emplace(); });
}

void hlCancelFrame(void) {
  call(__func__, When::kAlways, [](HLcontext& context) { context.cancelFrame(); });
}

void hlFlush(void) {
  call(__func__, When::kNotInDefinition, [](HLcontext& context) {
    context.conversation.takeReplies(context.errors, context.events);
    closeFrame(context);
    if (context.conversation.sendFrame() == Outbox::Outcome::kTooMuchQueued)
      throw Fault(HL_BUSY, "much is still on its way to the server; the frame waits");
  });
}

void hlFinish(void) {
  call(__func__, When::kNotInDefinition, [](HLcontext& context) { finish(context, kForever_s); });
}

HLboolean hlFinishTimeout(HLdouble seconds) {
  return callOr<HLboolean>(HL_FALSE, __func__, When::kNotInDefinition, [&](HLcontext& context) {
    requireFinite(seconds);
    if (seconds < 0) throw Fault(HL_INVALID_VALUE, "the time must not be negative");
    return finish(context, seconds);
  });
}

void hlFrameInterval(HLdouble seconds) {
  call(__func__, [&](HLcontext& context) {
    requireFinite(seconds);
    context.conversation.setInterval(seconds < 0 ? std::nullopt : std::optional(seconds));
  });
}

HLint hlPoll(void) {
  return callOr<HLint>(0, __func__, When::kOutside, [](HLcontext& context) {
    if (context.events.isDelivering()) throw Fault(HL_INVALID_OPERATION, "not in a callback of hlPoll");
    context.conversation.takeReplies(context.errors, context.events);
    context.conversation.sendFrame();
    return context.events.deliver();
  });
}
