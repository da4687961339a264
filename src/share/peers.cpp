#include "share/peers.h"

#include <algorithm>
#include <cstdlib>

#include "base/utf8.h"
#include "share/share_messages.h"

namespace hl {

namespace {

constexpr std::int64_t kForget_ns = 60'000'000'000, kSameName_ns = 3'000'000'000, kTogether_ns = 1'000'000'000;
constexpr std::int64_t kLongest_ns = std::int64_t{1} << 60;  // 36 years
constexpr std::uint32_t kMaxOfAServer = 16;

std::string shortName(const std::string& name) { return validUtf8(name.substr(0, kMaxShareName)); }

}  // namespace

bool Peers::hear(ServerId from, std::int64_t now_ns) {
  if (from == 0 || from == self_.id) return false;
  auto found = peers_.find(from);
  if (found == peers_.end()) {
    if (peers_.size() >= kMaxPeers) return false;
    found = peers_.emplace(from, Peer{}).first;
    found->second.first_ns = now_ns;
  }
  found->second.heard_ns = now_ns;
  return true;
}

void Peers::hear(const proto::ShareBeat& beat, std::int64_t now_ns) {
  if (!hear(beat.from(), now_ns)) return;
  Peer& peer = peers_[beat.from()];
  peer.name = shortName(beat.name());
  peer.version = shortName(beat.version());
  peer.adopts = beat.adopts();
  peer.begin_ns = now_ns - std::clamp<std::int64_t>(beat.there_ns(), 0, kLongest_ns);
  peer.echo.set_server(beat.from());
  peer.echo.set_sent_ns(beat.sent_ns());
  peer.echo.set_heard_ns(now_ns);
  for (const proto::ShareEcho& echo : beat.echoes()) {
    if (echo.server() == self_.id) peer.clock.add({echo.sent_ns(), echo.heard_ns(), beat.sent_ns(), now_ns});
  }
}

void Peers::hear(const proto::ShareHand& hand, std::int64_t now_ns) {
  if (hand.number() >= kMaxOfAServer || !isHand(hand.hand()) || !hear(hand.from(), now_ns)) return;
  proto::ShareHand& kept = peers_[hand.from()].hands[hand.number()];
  if (hand.time_ns() >= kept.time_ns()) kept = hand;
}

void Peers::addTransit(ServerId from, std::int64_t sent_there_ns, std::int64_t now_ns) {
  const auto peer = peers_.find(from);
  if (peer == peers_.end()) return;
  const std::optional<std::int64_t> offset_ns = peer->second.clock.offset_ns();
  if (offset_ns) peer->second.delay.add(now_ns + *offset_ns - sent_there_ns);
}

proto::ShareBeat Peers::beat(std::int64_t now_ns) const {
  proto::ShareBeat beat;
  beat.set_from(self_.id);
  beat.set_name(self_.name);
  beat.set_there_ns(now_ns - begin_ns_);
  beat.set_version(self_.version);
  beat.set_adopts(self_.adopts);
  beat.set_sent_ns(now_ns);
  for (const auto& [id, peer] : peers_) {
    if (peer.echo.server() != 0 && isThere(id, now_ns)) *beat.add_echoes() = peer.echo;
  }
  return beat;
}

bool Peers::isThere(ServerId id, std::int64_t now_ns) const {
  const auto peer = peers_.find(id);
  return peer != peers_.end() && now_ns - peer->second.heard_ns < kLease_ns;
}

std::optional<std::int64_t> Peers::shownTimeThere_ns(ServerId id, std::int64_t now_ns) const {
  const auto peer = peers_.find(id);
  if (peer == peers_.end()) return std::nullopt;
  const std::optional<std::int64_t> lag_ns = peer->second.lag.lag_ns();
  return lag_ns ? std::optional(now_ns - *lag_ns) : std::nullopt;
}

void Peers::followClocks(std::int64_t now_ns) {
  for (auto& [_, peer] : peers_) {
    const std::optional<std::int64_t> offset_ns = peer.clock.offset_ns();
    if (offset_ns) peer.lag.follow(now_ns, peer.delay.delay_ns() - *offset_ns);
  }
}

bool Peers::isAdopter(std::int64_t now_ns) const {
  if (!self_.adopts) return false;
  return std::none_of(peers_.begin(), peers_.end(), [&](const auto& entry) {
    return entry.first < self_.id && entry.second.adopts && isThere(entry.first, now_ns);
  });
}

const Peer* Peers::sameName(std::int64_t now_ns) const {
  for (const auto& [id, peer] : peers_) {
    if (peer.name == self_.name && isThere(id, now_ns) && peer.heard_ns - peer.first_ns > kSameName_ns) return &peer;
  }
  return nullptr;
}

// Clocks and lines say when it began to a part of a second: within that the numbers decide, alike for both.
bool Peers::isSecondOfItsName(std::int64_t now_ns) const {
  const Peer* const other = sameName(now_ns);
  if (other == nullptr) return false;
  const std::int64_t before_ns = begin_ns_ - other->begin_ns;
  return std::abs(before_ns) < kTogether_ns ? self_.id > other->echo.server() : before_ns > 0;
}

std::vector<ServerId> Peers::there(std::int64_t now_ns) const {
  std::vector<ServerId> ids;
  for (const auto& [id, _] : peers_) {
    if (isThere(id, now_ns)) ids.push_back(id);
  }
  return ids;
}

void Peers::hearAgain(std::int64_t deaf_ns, std::int64_t now_ns) {
  for (auto& [_, peer] : peers_) {
    if (deaf_ns - peer.heard_ns < kLease_ns) peer.heard_ns = now_ns;
  }
}

void Peers::forget(std::int64_t now_ns) {
  std::erase_if(peers_, [&](const auto& entry) { return now_ns - entry.second.heard_ns > kForget_ns; });
}

}  // namespace hl
