#include "share/share_bridge.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "base/guarded_thread.h"
#include "session/hand_messages.h"

namespace hl {

namespace {

// Of one pass: what comes faster waits, so that the scene is looked at in time.
constexpr int kMaxPackets = 1000;
// Looks at a scene of thousands of objects are made less often: from one to the next as many times as long as it takes.
constexpr std::int64_t kLooksApart = 4;
// A simulated hand goes there in less; the beats of this server may wait so long.
constexpr double kMoveHands_s = 0.3;
// After that what is placed is shown.
constexpr std::int64_t kFreeHands_ns = 500'000'000;

// The first lines about objects: a server may publish broken ones for ever.
ShareBridge::ReportLine someOf(ShareBridge::ReportLine report) {
  return [report = std::move(report), left = 20](const std::string& line) mutable {
    if (left == 0) return;
    --left;
    report(left > 0 ? line : line + " (no more of these are told)");
  };
}

}  // namespace

ShareBridge::ShareBridge(std::unique_ptr<ShareLink> link, const std::string& world, const ShareSelf& self,
                         TouchServer& server, ReportLine report)
    : link_(std::move(link)),
      server_(server),
      report_(std::move(report)),
      client_(server.placeClient()),
      world_(self, monotonicNow_ns(), [this](const SharePacket& packet) { return link_->send(packet); }),
      local_(self, client_->session(), work_, world_.contents(), someOf(report_)),
      replicas_(*client_, server.devices() <= kMaxHands, work_, world_.contents(), fitOfHands(), someOf(report_)),
      pushes_(client_->session()),
      actions_(server.device(), local_, replicas_),
      view_{world, self.name, {}} {}

void ShareBridge::start() {
  thread_.start("share", [this] { run(); });
}

void ShareBridge::stop() { thread_.stop(); }

// A scene of its own is fitted already.
ReplicasHere::FitHands ShareBridge::fitOfHands() {
  if (!server_.device().snapshot()->instances.empty()) return {};
  return [this](const Box& bounds) {
    server_.fitHands(bounds, kMoveHands_s);
    free_hands_ns_ = monotonicNow_ns() + kFreeHands_ns;
  };
}

ShareView ShareBridge::view() const {
  const std::lock_guard lock(view_mutex_);
  return view_;
}

void ShareBridge::run() {
  std::int64_t next_ns = monotonicNow_ns();
  std::int64_t next_look_ns = next_ns;
  StartPauses pauses;
  while (thread_.running()) {
    link_->wait(std::max<std::int64_t>(1, next_ns - monotonicNow_ns()));
    const std::int64_t now_ns = monotonicNow_ns();
    hearAll(now_ns);
    if (link_->ended()) {
      startAgain(pauses, now_ns);
      continue;
    }
    guarded([&] { world_.step(now_ns); });
    if (now_ns >= next_ns) {
      guarded([&] { work_.finish(); });
      if (now_ns >= next_look_ns) {
        guarded([&] { look(now_ns); });
        next_look_ns = now_ns + kLooksApart * (monotonicNow_ns() - now_ns);
      }
      guarded([&] { showOthers(now_ns); });
      next_ns = std::max(next_ns + kLook_ns, now_ns);
    }
    if (!world_.peers().isSecondOfItsName(now_ns)) continue;
    guarded([&] { replicas_.clear(); });
    return endFor("a server that was in this world before is called " + view_.name +
                  " as well: give one another --share-name");
  }
}

// Meanwhile what others have stays where it is.
void ShareBridge::startAgain(StartPauses& pauses, std::int64_t deaf_ns) {
  endFor("hl-share has ended; it is started again");
  while (thread_.running()) {
    pauses.wait([this] { return thread_.running().load(); });
    if (!thread_.running() || !link_->startAgain()) continue;
    guarded([&] { world_.linkAgain(deaf_ns, monotonicNow_ns()); });
    guarded([&] { report_("hl-share is there again"); });
    const std::lock_guard lock(view_mutex_);
    view_.ended.clear();
    ++view_.starts;
    return;
  }
}

void ShareBridge::hearAll(std::int64_t now_ns) {
  for (int i = 0; i < kMaxPackets; ++i) {
    const std::optional<SharePacket> packet = link_->receive();
    if (!packet) return;
    guarded([&] { world_.hear(*packet, now_ns); });
  }
}

void ShareBridge::look(std::int64_t now_ns) {
  publishScene(now_ns);
  publishHands(now_ns);
  actOnBodies();
  reportPeers(now_ns);
  writeView(now_ns);
}

void ShareBridge::publishScene(std::int64_t now_ns) {
  const std::shared_ptr<const Snapshot> scene = server_.device().snapshot();
  local_.look(*scene, now_ns);
  LocalItems items = local_.items();
  replicas_.addOwn(*scene, items);
  world_.publish(items, local_.complete(), now_ns);
}

void ShareBridge::publishHands(std::int64_t now_ns) {
  for (std::uint32_t number = 0; number < server_.devices(); ++number) {
    ServoView servo;
    ProxyView proxy;
    server_.views(number, servo, proxy);
    proto::OtherDevice hand;
    toProto(server_.device(number), servo, proxy, hand);
    world_.publishHand(number, hand, now_ns);
  }
  for (const ItemPush& push : pushes_.take(server_, replicas_)) world_.press(push);
}

void ShareBridge::actOnBodies() {
  for (const ReturnedItem& returned : world_.takeReturned()) actions_.add(returned);
  for (const ItemPush& push : world_.takePushes()) actions_.add(push);
  actions_.give();
}

// Those of this server that are still being written are there already, as its own.
void ShareBridge::showOthers(std::int64_t now_ns) {
  std::vector<Replica> others = world_.replicas(now_ns);
  std::erase_if(others, [this](const Replica& replica) { return local_.has(replica.id); });
  replicas_.look(others, world_.takeJumped(), now_ns);
  if (free_hands_ns_ && now_ns > *free_hands_ns_) {
    server_.freeHands();
    free_hands_ns_.reset();
  }
}

void ShareBridge::reportPeers(std::int64_t now_ns) {
  std::map<ServerId, std::string> there;
  for (const ServerId id : world_.peers().there(now_ns)) {
    const Peer& peer = world_.peers().all().at(id);
    if (!peer.name.empty()) there[id] = peer.name;
  }
  for (const auto& [id, name] : there) {
    if (!reported_peers_.contains(id)) report_("server " + name + " is in the world");
  }
  for (const auto& [id, name] : reported_peers_) {
    if (!there.contains(id))
      report_("server " + name + " is lost: what it had stays where it is, until others take it over");
  }
  reported_peers_ = std::move(there);
}

void ShareBridge::writeView(std::int64_t now_ns) {
  ShareView view{view_.world, view_.name, {}, view_.starts, world_.counts(now_ns)};
  std::multimap<std::string, const Peer*> by_name;
  for (const auto& [id, name] : reported_peers_) by_name.emplace(name, &world_.peers().all().at(id));
  for (const auto& [name, peer] : by_name) {
    view.peers.push_back({name, 1e-6 * static_cast<double>(peer->clock.roundTrip_ns()),
                          1e-6 * static_cast<double>(peer->delay.delay_ns())});
    for (const auto& [_, hand] : peer->hands) {
      view.hands.push_back(hand.hand());
      view.hands.back().set_server(name);
    }
  }
  server_.setRemoteHands(view.hands);
  if (view.counts.left_out > 0 && view_.counts.left_out == 0)
    report_("objects of other servers are left out: there are more than " + std::to_string(SharedWorld::kMaxRecords));
  const std::lock_guard lock(view_mutex_);
  view_ = std::move(view);
}

void ShareBridge::endFor(const std::string& why) {
  guarded([&] { report_(why); });
  server_.setRemoteHands({});
  const std::lock_guard lock(view_mutex_);
  view_.ended = why;
  view_.peers.clear();
  view_.hands.clear();
}

}  // namespace hl
