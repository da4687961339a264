#include "touch/touch_session.h"

#include <algorithm>
#include <utility>

#include "touch/hand_group.h"

namespace hl {

namespace {

std::unique_ptr<StepSink> makeSink(const MakeStepSink& make, const SessionInfo& session) {
  if (make) return make(session);
  return std::make_unique<NoSink>();
}

SnapshotSlot::Bodies bodiesOf(const TouchSettings& settings) {
  return settings.hands ? SnapshotSlot::Bodies::kElsewhere : SnapshotSlot::Bodies::kHere;
}

}  // namespace

TouchSession::TouchSession(std::shared_ptr<const Snapshot> snapshot, const TouchSettings& settings,
                           std::unique_ptr<Device> device)
    : settings_(settings),
      device_(std::move(device)),
      servo_rate_Hz_(settings.servo_rate.of(device_->info())),
      scenes_(std::move(snapshot), bodiesOf(settings)),
      live_(settings, device_->info(), scenes_.newest()->bounds),
      sink_(makeSink(settings.sink,
                     {device_->info(), servo_rate_Hz_, settings.proxy_rate_Hz, ProxySettings{}, settings.label})),
      ticker_(scenes_, live_, exchange_, views_, *sink_, periodOf_ns(servo_rate_Hz_), settings.hands != nullptr),
      servo_(parts(), settings, servo_rate_Hz_),
      proxy_(parts(), settings.proxy_rate_Hz),
      hand_(*device_, settings, live_, exchange_, [this] { return this->snapshot(); }) {
  if (settings_.hands) settings_.hands->join(parts());
  sink_->scene(scenes_.newest());
  hand_.bringToStart();
  servo_.look();
}

TouchSession::~TouchSession() {
  stop();
  device_->close();
}

void TouchSession::start() {
  begin_ns_ = monotonicNow_ns();
  running_ = true;
  live_.rearm();
  sink_->start();
  proxy_.start();
  servo_.start(begin_ns_);
  hand_.start(begin_ns_);
  if (settings_.timer_reference) reference_.start(servo_rate_Hz_, servo_.grant().core);
}

void TouchSession::stop() {
  if (!running_.exchange(false)) return;
  hand_.stop();
  servo_.stop();
  proxy_.stop();
  reference_.stop();
  sink_->stop();
}

SnapshotSlot::Ready TouchSession::prepare(std::shared_ptr<const Snapshot> snapshot) const {
  return SnapshotSlot::prepare(std::move(snapshot), bodiesOf(settings_));
}

bool TouchSession::actOnBody(const BodyCommand& command) {
  return settings_.hands ? settings_.hands->actOnBody(command) : live_.actOnBody(command);
}

bool TouchSession::popEvent(BodyEvent& event) {
  if (!settings_.hands) return ticker_.popEvent(event);
  return settings_.label.number == 0 && settings_.hands->popEvent(event);
}

void TouchSession::publish(SnapshotSlot::Ready scene) noexcept {
  live_.fit(scene.front().snapshot->bounds);
  show(std::move(scene));
}

void TouchSession::publishAnew(SnapshotSlot::Ready scene) noexcept {
  live_.refit(scene.front().snapshot->bounds);
  show(std::move(scene));
}

bool TouchSession::moveHandAside(const Box& bounds, double most_s) {
  const Box there = snapshot()->bounds;
  const double top_D = there.empty() ? 0 : live_.workspace().toDevice(there.max).y();
  return hand_.moveAside(std::max(top_D, live_.topOfFitted_D(bounds)), most_s);
}

void TouchSession::show(SnapshotSlot::Ready scene) noexcept {
  sink_->scene(scene.front().snapshot);
  const std::lock_guard lock(scenes_mutex_);
  scenes_.publish(std::move(scene));
}

void TouchSession::dropSceneBefore() {
  const std::lock_guard lock(scenes_mutex_);
  scenes_.dropBefore();
}

std::shared_ptr<const Snapshot> TouchSession::snapshot() const {
  const std::lock_guard lock(scenes_mutex_);
  return scenes_.newest();
}

bool TouchSession::ready(std::int64_t since_ns) const {
  if (!running_ || servo_.stalled()) return true;
  return scenes_.taken() && ticker_.last_ns() >= since_ns;
}

void TouchSession::viewsForClients(ServoView& servo, ProxyView& proxy) {
  views_.servo.clients.read(servo);
  views_.proxy.clients.read(proxy);
  servo_.markStall(servo);
}

void TouchSession::views(ServoView& servo, ProxyView& proxy) {
  views_.servo.pages.read(servo);
  views_.proxy.pages.read(proxy);
  servo_.markStall(servo);
}

// A hand of a group is ticked by one of two threads, and its own may stand still meanwhile: both are looked at.
LoopTotals TouchSession::proxyTotals() const {
  LoopTotals totals = proxy_.totals();
  if (settings_.hands) totals += settings_.hands->totals();
  totals.steps = ticker_.ticks();
  return totals;
}

}  // namespace hl
