#include "touch/ticker.h"

namespace hl {

Ticker::Ticker(SnapshotSlot& scenes, LiveSettings& live, LoopExchange& exchange, TouchViews& views, StepSink& sink,
               std::int64_t servo_period_ns, bool grouped)
    : live_(live),
      exchange_(exchange),
      views_(views),
      sink_(sink),
      loop_(scenes, ProxySettings{}),
      chooser_(servo_period_ns),
      grouped_(grouped) {}

// The loop of a group ticks where there are bodies, and nowhere else: whoever finds that it is not its turn any more
// gives it away before it ticks.
bool Ticker::isTurnOf(Turn who) {
  if (chooser_.turn() != who) return false;
  if (!grouped_) return true;
  const bool bodies = loop_.newestHasBodies();
  if (bodies == (who == Turn::kGroup)) return true;
  chooser_.give(bodies ? Turn::kGroup : Turn::kServo);
  return false;
}

const ProxyCommands& Ticker::follow() {
  const std::uint64_t arrivals = exchange_.arrivals.load(std::memory_order_acquire);
  live_.proxyCommands(commands_);
  // While the device does not answer there are no steps: what clients do waits in their queue, which refuses more.
  if (!loop_.waiting()) {
    live_.takeBodyCommands(on_bodies_);
    loop_.act(on_bodies_);
  }
  commands_.restarts += arrivals;
  return commands_;
}

void Ticker::done(const TickRequest& request, const ProxyStep* step, std::int64_t begin_ns, std::int64_t work_ns) {
  if (step != nullptr) {
    TickRequest whole = request;
    whole.on_bodies = loop_.done();
    sink_.tick(whole, *step, loop_, work_ns);
  }
  meter_.add(begin_ns, work_ns);
  show(step);
  ticks_.fetch_add(1, std::memory_order_relaxed);
  if (chooser_.turn() == Turn::kServo) ticks_in_servo_steps_.fetch_add(1, std::memory_order_relaxed);
  last_ns_.store(begin_ns, std::memory_order_release);
  chooser_.took(work_ns);
}

void Ticker::show(const ProxyStep* step) {
  const ProxyState& state = loop_.state();
  view_.proxy = state.position;
  view_.contacts.clear();
  view_.touched.clear();
  view_.snap = {};
  view_.slipping = false;
  if (step != nullptr) {
    view_.contacts = step->report.contacts;
    view_.touched = step->touched;
    view_.snap = step->snap;
    view_.slipping = state.touching && state.sticking.since_slip_s == 0;
    view_.ended.add(step->report.ending);
  }
  view_.ledger = state.ledger;
  view_.bodies = loop_.bodies() != nullptr ? loop_.bodies()->view() : BodyView{};
  view_.loop = meter_.summary();
  views_.proxy.write(view_);
}

}  // namespace hl
