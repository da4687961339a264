#include "session/touch_server.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/error.h"
#include "base/guarded_thread.h"
#include "session/state_messages.h"

namespace hl {

namespace {

constexpr auto kEventPeriod = std::chrono::milliseconds(4);

}  // namespace

TouchServer::TouchServer(std::shared_ptr<const Snapshot> base, const TouchServerSettings& settings)
    : world_(std::move(base), settings), buttons_(world_.devices(), 0) {}

TouchServer::~TouchServer() { stop(); }

void TouchServer::start() {
  if (running_.exchange(true)) return;
  world_.start();
  events_ = startThread("events", [this] { runEvents(); });
}

void TouchServer::stop() {
  if (!running_.exchange(false)) return;
  world_.stop();
  if (events_.joinable()) events_.join();
  const std::lock_guard lock(mutex_);
  for (HlSession* session : sessions_) session->end("the server is closing");
}

std::unique_ptr<ClientSession> TouchServer::connect(WakeSession wake) {
  const std::lock_guard lock(mutex_);
  if (sessions_.size() >= world_.limits().sessions)
    throw Error("the server has " + std::to_string(sessions_.size()) + " clients already");
  auto session = std::make_unique<HlSession>(world_, ++last_session_, std::move(wake),
                                             [this](const HlSession& gone) { leave(gone); });
  sessions_.push_back(session.get());
  return session;
}

std::unique_ptr<PlacedClient> TouchServer::placeClient() {
  const std::lock_guard lock(mutex_);
  return std::make_unique<PlacedClient>(world_.clients(), ++last_session_, world_.memory().member());
}

std::vector<TouchSession*> TouchServer::otherDevices() {
  std::vector<TouchSession*> others;
  for (std::size_t i = 1; i < devices(); ++i) others.push_back(&device(i));
  return others;
}

std::size_t TouchServer::sessions() const {
  const std::lock_guard lock(mutex_);
  return sessions_.size();
}

void TouchServer::replaceScene(const std::shared_ptr<const Snapshot>& scene) {
  if (sessions() > 0) throw Error("a program is connected and has its own objects in this scene: end it first");
  world_.replaceBase(scene);
}

void TouchServer::leave(const HlSession& session) {
  const std::lock_guard lock(mutex_);
  std::erase(sessions_, &session);
}

void TouchServer::runEvents() {
  while (running_) {
    std::this_thread::sleep_for(kEventPeriod);
    for (std::uint32_t device = 0; device < world_.devices(); ++device) {
      guarded([&] { notifyOfTouches(device); });
      guarded([&] { notifyOfBodies(device); });
      guarded([&] { notifyOfButtons(device); });
    }
  }
}

void TouchServer::notifyEach(const proto::Event& event, FunctionRef<bool(const HlSession&)> whom) {
  const std::lock_guard lock(mutex_);
  for (HlSession* session : sessions_) {
    if (whom(*session)) guarded([&] { session->notify(event); });
  }
}

// To the client whose object it is.
void TouchServer::notifyOfTouches(std::uint32_t device) {
  TouchEvent event;
  while (world_.device(device).popEvent(event)) {
    proto::Event out;
    out.set_kind(event.touches ? proto::TOUCH : proto::UNTOUCH);
    out.set_time_s(world_.device(device).time_s(event.time_ns));
    out.set_object(event.object.object);
    out.set_name(event.object.name);
    toProto(event.position_W, *out.mutable_position());
    notifyEach(out, [&](const HlSession& session) { return session.number() == event.object.session; });
  }
}

// To the client whose body it is, if it listens.
void TouchServer::notifyOfBodies(std::uint32_t device) {
  BodyEvent event;
  while (world_.device(device).popEvent(event)) {
    proto::Event out;
    out.set_kind(static_cast<proto::EventKind>(proto::SLEEP + static_cast<int>(event.kind)));
    out.set_time_s(world_.device(device).time_s(event.time_ns));
    out.set_object(event.object.object);
    out.set_name(event.object.name);
    out.set_impulse_n_s(event.impulse_N_s);
    toProto(event.position_W, *out.mutable_position());
    notifyEach(out, [&](const HlSession& session) { return session.bodies().wantsEvent(event); });
  }
}

// To the clients of the device.
void TouchServer::notifyOfButtons(std::uint32_t device) {
  ServoView servo;
  ProxyView proxy;
  world_.views(device, servo, proxy);
  const std::uint32_t changed = servo.buttons ^ std::exchange(buttons_[device], servo.buttons);
  for (std::uint32_t button = 0; changed >> button != 0 && button < 32; ++button) {
    if ((changed >> button & 1U) == 0) continue;
    proto::Event out;
    out.set_kind(proto::BUTTON);
    out.set_time_s(world_.device(device).time_s());
    out.set_button(button);
    out.set_down((servo.buttons >> button & 1U) != 0);
    toProto(proxy.proxy, *out.mutable_position());
    notifyEach(out, [&](const HlSession& session) { return session.device() == device; });
  }
}

}  // namespace hl
