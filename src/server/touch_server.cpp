#include "server/touch_server.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/error.h"
#include "base/guarded_thread.h"
#include "io/replay_device.h"
#include "server/feed_messages.h"

namespace hl {

namespace {

constexpr std::uint32_t kPages = 1;  // they are one member of the budget
constexpr auto kEventPeriod = std::chrono::milliseconds(4);

std::vector<std::unique_ptr<TouchSession>> makeDevices(const std::shared_ptr<const Snapshot>& base,
                                                       const TouchServerSettings& settings) {
  std::vector<std::unique_ptr<TouchSession>> devices;
  for (std::uint32_t i = 0; i < std::max(1U, settings.devices); ++i) {
    std::unique_ptr<Device> device = openAnyDevice(settings.device);
    if (settings.devices > 1 && device->hand() == nullptr)
      throw Error("of '" + settings.device + "' there is one device; only simulated ones may be several");
    devices.push_back(std::make_unique<TouchSession>(base, settings.touch, std::move(device)));
  }
  return devices;
}

std::vector<TouchSession*> pointersOf(const std::vector<std::unique_ptr<TouchSession>>& devices) {
  std::vector<TouchSession*> pointers;
  for (const auto& device : devices) pointers.push_back(device.get());
  return pointers;
}

}  // namespace

TouchServer::TouchServer(std::shared_ptr<const Snapshot> base, const TouchServerSettings& settings)
    : settings_(settings),
      memory_(settings.limits.memory_bytes, settings.limits.sessions + settings.limits.kept + kPages),
      base_memory_(memory_),
      devices_(makeDevices(base, settings)),
      publisher_(base, pointersOf(devices_)),
      masters_(devices_.size(), 0),
      buttons_(devices_.size(), 0) {
  base_memory_.set(memoryOf(*base));
}

TouchServer::~TouchServer() { stop(); }

void TouchServer::start() {
  if (running_.exchange(true)) return;
  for (const auto& device : devices_) device->start();
  publisher_.start();
  events_ = startThread("events", [this] { runEvents(); });
}

void TouchServer::stop() {
  if (!running_.exchange(false)) return;
  for (const auto& device : devices_) device->stop();
  publisher_.stop();
  events_.join();
  const std::lock_guard lock(mutex_);
  for (HlSession* session : sessions_) session->end("the server is closing");
}

std::unique_ptr<ClientSession> TouchServer::connect(const std::string& peer, WakeCarrier wake) {
  const std::lock_guard lock(mutex_);
  if (sessions_.size() >= settings_.limits.sessions)
    throw Error("the server has " + std::to_string(sessions_.size()) + " clients already");
  auto session = std::make_unique<HlSession>(*this, ++last_session_, peer, std::move(wake));
  sessions_.push_back(session.get());
  return session;
}

std::size_t TouchServer::sessions() const {
  const std::lock_guard lock(mutex_);
  return sessions_.size();
}

bool TouchServer::becomeMaster(std::uint32_t device, std::uint32_t session) {
  const std::lock_guard lock(mutex_);
  if (masters_[device] == 0) masters_[device] = session;
  return masters_[device] == session;
}

bool TouchServer::hasMaster(std::uint32_t device) const {
  const std::lock_guard lock(mutex_);
  return masters_[device] != 0;
}

void TouchServer::leave(HlSession& session) {
  const std::lock_guard lock(mutex_);
  std::erase(sessions_, &session);
  std::replace(masters_.begin(), masters_.end(), session.number(), 0U);
}

void TouchServer::keep(const std::string& client_name, std::shared_ptr<ScenePublisher::Place> place) {
  const std::lock_guard lock(mutex_);
  const auto named = [&](const auto& one) { return one.first == client_name; };
  auto gone = std::find_if(kept_.begin(), kept_.end(), named);
  if (gone == kept_.end() && kept_.size() >= settings_.limits.kept) gone = kept_.begin();
  if (gone != kept_.end()) {
    publisher_.remove(gone->second);
    kept_.erase(gone);
  }
  kept_.emplace_back(client_name, std::move(place));
}

std::shared_ptr<ScenePublisher::Place> TouchServer::takeKept(const std::string& client_name) {
  const std::lock_guard lock(mutex_);
  const auto named = [&](const auto& one) { return one.first == client_name; };
  const auto found = std::find_if(kept_.begin(), kept_.end(), named);
  if (found == kept_.end()) return nullptr;
  auto place = std::move(found->second);
  kept_.erase(found);
  return place;
}

void TouchServer::setDeviceInfo(std::uint32_t device, proto::DeviceInfo& info) const {
  toProto(*devices_[device], info);
}

void TouchServer::describe(std::uint32_t device, proto::ClientState& state) {
  TouchSession& touch = *devices_[device];
  ServoView servo;
  ProxyView proxy;
  {
    const std::lock_guard lock(views_mutex_);
    touch.viewsForClients(servo, proxy);
  }
  toProto(touch, servo, proxy, state);
}

void TouchServer::runEvents() {
  while (running_) {
    std::this_thread::sleep_for(kEventPeriod);
    for (std::uint32_t device = 0; device < devices_.size(); ++device) {
      guarded([&] { tellTouched(device); });
      guarded([&] { tellButtons(device); });
    }
  }
}

void TouchServer::tellEach(const proto::Event& event, FunctionRef<bool(const HlSession&)> whom) {
  const std::lock_guard lock(mutex_);
  for (HlSession* session : sessions_) {
    if (whom(*session)) guarded([&] { session->tell(event); });
  }
}

// To the client whose object it is.
void TouchServer::tellTouched(std::uint32_t device) {
  TouchEvent event;
  while (devices_[device]->popEvent(event)) {
    proto::Event out;
    out.set_kind(event.touches ? proto::TOUCH : proto::UNTOUCH);
    out.set_time_s(devices_[device]->time_s(event.time_ns));
    out.set_object(event.object.object);
    out.set_name(event.object.name);
    toProto(event.position_W, *out.mutable_position());
    tellEach(out, [&](const HlSession& session) { return session.number() == event.object.session; });
  }
}

// To the clients of the device.
void TouchServer::tellButtons(std::uint32_t device) {
  ServoView servo;
  ProxyView proxy;
  {
    const std::lock_guard lock(views_mutex_);
    devices_[device]->viewsForClients(servo, proxy);
  }
  const std::uint32_t changed = servo.buttons ^ std::exchange(buttons_[device], servo.buttons);
  for (std::uint32_t button = 0; changed >> button != 0 && button < 32; ++button) {
    if ((changed >> button & 1U) == 0) continue;
    proto::Event out;
    out.set_kind(proto::BUTTON);
    out.set_time_s(devices_[device]->time_s());
    out.set_button(button);
    out.set_down((servo.buttons >> button & 1U) != 0);
    toProto(proxy.proxy, *out.mutable_position());
    tellEach(out, [&](const HlSession& session) { return session.device() == device; });
  }
}

}  // namespace hl
