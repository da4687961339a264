#include "session/touch_world.h"

#include <algorithm>

#include "base/error.h"
#include "bodies/scene_world.h"
#include "record/replay_device.h"
#include "session/check_bodies.h"
#include "session/state_messages.h"

namespace hl {

namespace {

constexpr std::uint32_t kPages = 1;  // they are one member of the budget

std::uint64_t bytesOfBase(const Snapshot& base) {
  std::uint64_t bytes = memoryOf(base) + partsIn(base) * kBody_bytes;
  for (const JointSpec& joint : base.mechanics.joints) bytes += bytesOfJoint(joint);
  return bytes;
}

// The user's name for it is reported with what is wrong.
std::unique_ptr<Device> openNamed(const NamedDevice& named) {
  try {
    return openAnyDevice(named.spec);
  } catch (const Error& error) {
    if (named.name.empty()) throw;
    throw Error("device '" + named.name + "': " + error.what());
  }
}

// All are open before the first one serves: a vendor's library may hold up the others while it opens one.
std::vector<std::unique_ptr<TouchSession>> makeDevices(const std::shared_ptr<const Snapshot>& base,
                                                       const TouchServerSettings& settings,
                                                       const std::shared_ptr<HandGroup>& hands) {
  if (settings.devices.empty() || settings.devices.size() > TouchServerSettings::kMaxDevices)
    throw Error("a server has 1 to " + std::to_string(TouchServerSettings::kMaxDevices) + " devices");
  checkHandsAtBodies(*base, settings.devices.size());
  std::vector<std::unique_ptr<Device>> open;
  for (const NamedDevice& named : settings.devices) open.push_back(openNamed(named));
  TouchSettings touch = settings.touch;
  touch.hands = hands;
  if (settings.faults_joined) touch.faults = std::make_shared<FaultGroup>();
  std::vector<std::unique_ptr<TouchSession>> devices;
  for (std::uint32_t i = 0; i < open.size(); ++i) {
    touch.label = {settings.devices[i].name, i, static_cast<std::uint32_t>(open.size())};
    devices.push_back(std::make_unique<TouchSession>(base, touch, std::move(open[i])));
  }
  return devices;
}

std::shared_ptr<HandGroup> makeHands(const std::shared_ptr<const Snapshot>& base, const TouchServerSettings& settings) {
  if (settings.devices.size() < 2) return nullptr;
  return std::make_shared<HandGroup>(base, settings.touch.proxy_rate_Hz);
}

std::vector<TouchSession*> pointersOf(const std::vector<std::unique_ptr<TouchSession>>& devices) {
  std::vector<TouchSession*> pointers;
  for (const auto& device : devices) pointers.push_back(device.get());
  return pointers;
}

}  // namespace

TouchWorld::TouchWorld(std::shared_ptr<const Snapshot> base, const TouchServerSettings& settings)
    : settings_(settings),
      memory_(settings.limits.memory_bytes, settings.limits.sessions + settings.limits.kept + kPages),
      base_memory_(memory_),
      hands_(makeHands(base, settings)),
      devices_(makeDevices(base, settings, hands_)),
      publisher_(base, pointersOf(devices_), hands_.get()),
      masters_(devices_.size(), 0) {
  base_memory_.set(bytesOfBase(*base));
}

std::optional<std::uint32_t> TouchWorld::deviceNamed(const std::string& name) const {
  for (const auto& device : devices_) {
    if (!name.empty() && device->label().name == name) return device->label().number;
  }
  return {};
}

void TouchWorld::start() {
  if (hands_) hands_->start();
  for (const auto& device : devices_) device->start();
  publisher_.start();
}

// The loop of all hands first: it writes into what the sessions keep.
void TouchWorld::stop() {
  if (hands_) hands_->stop();
  for (const auto& device : devices_) device->stop();
  publisher_.stop();
}

// While it lives hands may be held aside; then they are free, however that came.
class TouchWorld::HandsAside {
 public:
  explicit HandsAside(TouchWorld& world) : world_(world) {}
  ~HandsAside() { world_.freeHands(); }
  HandsAside(const HandsAside&) = delete;
  HandsAside& operator=(const HandsAside&) = delete;

 private:
  TouchWorld& world_;
};

void TouchWorld::replaceBase(const std::shared_ptr<const Snapshot>& base) {
  checkHandsAtBodies(*base, devices_.size());
  worldOf(*base);  // one that cannot be made is refused here
  MemoryShare share(memory_);
  share.take(bytesOfBase(*base));
  clients().admitBase(partsOf(*base));
  const HandsAside hands(*this);
  if (!showBase(base)) throw Error("the server is closing");
  clients().setBase(partsOf(*base));
  base_memory_ = std::move(share);
}

bool TouchWorld::moveHandsAside(const Box& bounds, double most_s) {
  bool aside = true;
  for (const auto& device : devices_) aside &= device->moveHandAside(bounds, most_s);
  return aside;
}

// Where the scene before keeps a hand from its way, that scene goes first. Then nothing but a busy machine is in its
// way, or objects whose client has gone.
bool TouchWorld::showBase(const std::shared_ptr<const Snapshot>& base) {
  constexpr double kPatience_s = 1, kPatienceInTheOpen_s = 10;
  if (!moveHandsAside(base->bounds, kPatience_s)) {
    if (!publisher_.replaceBase(makeSnapshot(std::vector<Instance>{}, base->name))) return false;
    moveHandsAside(base->bounds, kPatienceInTheOpen_s);
  }
  return publisher_.replaceBase(base);
}

void TouchWorld::fitHands(const Box& bounds, double most_s) {
  for (const auto& device : devices_) {
    if (device->live().isPlaced()) continue;
    device->moveHandAside(bounds, most_s);
    device->live().fitToOthers(bounds);
  }
}

void TouchWorld::freeHands() {
  for (const auto& device : devices_) device->hand().free();
}

bool TouchWorld::becomeMaster(std::uint32_t device, std::uint32_t session) {
  const std::lock_guard lock(mutex_);
  if (masters_[device] == 0) masters_[device] = session;
  return masters_[device] == session;
}

bool TouchWorld::hasMaster(std::uint32_t device) const {
  const std::lock_guard lock(mutex_);
  return masters_[device] != 0;
}

void TouchWorld::giveUpMaster(std::uint32_t session) {
  const std::lock_guard lock(mutex_);
  std::replace(masters_.begin(), masters_.end(), session, 0U);
}

void TouchWorld::keep(const std::string& client_name, std::shared_ptr<ClientScene> place) {
  const std::lock_guard lock(mutex_);
  const auto named = [&](const auto& one) { return one.first == client_name; };
  auto gone = std::find_if(kept_.begin(), kept_.end(), named);
  if (gone == kept_.end() && kept_.size() >= settings_.limits.kept) gone = kept_.begin();
  if (gone != kept_.end()) {
    clients().remove(gone->second);
    kept_.erase(gone);
  }
  kept_.emplace_back(client_name, std::move(place));
}

std::shared_ptr<ClientScene> TouchWorld::takeKept(const std::string& client_name) {
  const std::lock_guard lock(mutex_);
  const auto named = [&](const auto& one) { return one.first == client_name; };
  const auto found = std::find_if(kept_.begin(), kept_.end(), named);
  if (found == kept_.end()) return nullptr;
  auto place = std::move(found->second);
  kept_.erase(found);
  return place;
}

void TouchWorld::views(std::uint32_t device, ServoView& servo, ProxyView& proxy) {
  const std::lock_guard lock(views_mutex_);
  devices_[device]->viewsForClients(servo, proxy);
}

void TouchWorld::describe(std::uint32_t device, proto::ClientState& state) {
  ServoView servo;
  ProxyView proxy;
  views(device, servo, proxy);
  toProto(*devices_[device], servo, proxy, state);
  const std::lock_guard lock(mutex_);
  for (const proto::OtherDevice& hand : remote_) *state.add_remote() = hand;
}

void TouchWorld::setRemoteHands(std::vector<proto::OtherDevice> hands) {
  const std::lock_guard lock(mutex_);
  remote_.swap(hands);
}

}  // namespace hl
