#include "share/shared_world.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "base/clock.h"
#include "io/vec_messages.h"

namespace hl {

namespace {

// An object that has not moved for so many looks rests: encoders and solvers pause for a moment.
constexpr int kStillLooks = 6;
// What moves is sent so often for those who join, and for those who have lost many packets.
constexpr std::int64_t kKeyItem_ns = 1'000'000'000;
// What was defined by this server before it was started anew ends, unless it has been defined again by then.
constexpr std::int64_t kSettled_ns = 2'000'000'000;
// In one packet of the stream: 1200 bytes, less than a frame of Ethernet, so that a lost frame costs one packet.
constexpr int kPosesInPacket = 8;
constexpr std::size_t kMaxInboxOut = 1000;

// Packets of the stream replace older ones of their key.
std::uint64_t streamKey(ServerId from, std::uint64_t slot) { return from * 0x9e3779b97f4a7c15U + slot; }
enum Slot : std::uint64_t { kBeatSlot = 0, kHandSlots = 1, kPoseSlots = 100 };

}  // namespace

SharedWorld::SharedWorld(const ShareSelf& self, std::int64_t now_ns, Send send)
    : self_(self),
      send_(std::move(send)),
      begin_ns_(now_ns),
      peers_(self, now_ns),
      contents_(self.id, [this](ServerId to, const proto::ShareMessage& m) { return sendTo(Lane::kInbox, to, m); }),
      beat_ns_(now_ns - Peers::kBeat_ns) {}

bool SharedWorld::sendTo(Lane lane, std::uint64_t key, const proto::ShareMessage& message) const {
  return send_({lane, key, message.SerializeAsString()});
}

void SharedWorld::hear(const SharePacket& packet, std::int64_t now_ns) {
  const proto::ShareMessage message = messageOf(packet.bytes);
  switch (message.body_case()) {
    case proto::ShareMessage::kBeat:
      peers_.hear(message.beat(), now_ns);
      return peers_.addTransit(message.beat().from(), message.beat().sent_ns(), now_ns);
    case proto::ShareMessage::kHand:
      return peers_.hear(message.hand(), now_ns);
    case proto::ShareMessage::kItem:
      return hearItem(message.item(), now_ns);
    case proto::ShareMessage::kPoses:
      return hearPoses(message.poses(), now_ns);
    case proto::ShareMessage::kPush:
      return hearPush(message.push());
    case proto::ShareMessage::kRequest:
      return contents_.hear(message.request());
    case proto::ShareMessage::kPart:
      return contents_.hear(message.part(), now_ns);
    case proto::ShareMessage::BODY_NOT_SET:
      ++counts_.refused;
  }
}

void SharedWorld::hearItem(const proto::ShareItem& item, std::int64_t now_ns) {
  if (item.owner() == self_.id) return;  // an old one of our own
  if (!isItem(item)) {
    ++counts_.refused;
    return;
  }
  if (!records_.contains(item.id()) && !hasRoom()) {
    counts_.left_out += item.gone() ? 0 : 1;
    return;
  }
  Record& record = records_[item.id()];
  const bool known = record.item.id() != 0;
  const bool newer = isNewer(item, record.item);
  if (known && record.item.owner() != item.owner()) sendWinner(newer ? item : record.item, newer ? record.item : item);
  if (!newer) return;
  if (known && record.item.owner() != item.owner()) {
    counts_.lost_claims += isOwn(record) && record.item.epoch() == item.epoch() ? 1 : 0;
    record.track.clear();
    jumped_ = true;
  }
  if (!known || record.item.content().SerializeAsString() != item.content().SerializeAsString())
    record.content = std::make_shared<const proto::ShareContent>(item.content());
  record.item = item;
  record.heard_ns = now_ns;
  names_changed_ = true;
  const ItemMotion motion = motionOf(item.motion()).value_or(ItemMotion{});
  item.moving() ? record.track.add(item.time_ns(), motion) : record.track.rest(item.time_ns(), motion);
}

// Two servers say that they own it. That of the older item may know nothing of the other one, whose server may be lost:
// it is sent the newer one, so that it can claim the object anew.
void SharedWorld::sendWinner(const proto::ShareItem& winner, const proto::ShareItem& older) {
  if (older.owner() == self_.id) return;
  proto::ShareMessage message;
  *message.mutable_item() = winner;
  post(older.owner(), std::move(message));
}

void SharedWorld::post(ServerId to, proto::ShareMessage message) {
  if (inbox_out_.size() >= kMaxInboxOut) inbox_out_.pop_front();
  inbox_out_.emplace_back(to, std::move(message));
}

void SharedWorld::hearPoses(const proto::SharePoses& poses, std::int64_t now_ns) {
  if (!peers_.hear(poses.from(), now_ns)) return;
  peers_.addTransit(poses.from(), poses.time_ns(), now_ns);
  for (const proto::ItemPose& item : poses.items()) {
    const auto found = records_.find(item.id());
    if (found == records_.end()) continue;
    Record& record = found->second;
    const std::optional<ItemMotion> motion = motionOf(item.motion());
    if (!motion || record.item.owner() != poses.from() || record.item.epoch() != item.epoch()) continue;
    // What comes late, after the item that says where it rests, says nothing any more.
    const bool late = !record.item.moving() && poses.time_ns() <= record.item.time_ns();
    if (!late) record.track.add(poses.time_ns(), *motion);
  }
}

void SharedWorld::hearPush(const proto::SharePush& push) {
  const auto found = records_.find(push.id());
  const Vec3 impulse = vecOf(push.impulse_n_s()), point = vecOf(push.point_m());
  constexpr double kMaxImpulse_N_s = 1e3, kMaxPoint_m = 1e9, kLongest_s = 10;
  const bool sensible = impulse.allFinite() && impulse.norm() < kMaxImpulse_N_s && point.allFinite() &&
                        point.norm() < kMaxPoint_m && push.duration_s() >= 0 && push.duration_s() <= kLongest_s;
  if (found == records_.end() || !isOwn(found->second) || !sensible) {
    ++counts_.refused;
    return;
  }
  std::uint64_t& last = found->second.pushed[push.from()];
  if (push.number() <= last) return;
  last = push.number();
  ++counts_.pushes_taken;
  pushes_.push_back({push.id(), impulse, point, push.duration_s()});
}

// This server owns it from now on.
void SharedWorld::own(Record& record, std::uint64_t epoch, const ItemMotion& motion, std::int64_t now_ns) {
  record.item.set_epoch(epoch);
  record.item.set_owner(self_.id);
  record.item.set_gone(false);
  record.track.clear();
  record.sent = {motion, now_ns, now_ns, 0, true};
  setMotion(record, motion, now_ns, false);
}

// Of an object of its own that is to be published to others.
void SharedWorld::setMotion(Record& record, const ItemMotion& motion, std::int64_t time_ns, bool moving) {
  record.item.clear_motion();
  toProto(motion, *record.item.mutable_motion());
  record.item.set_time_ns(time_ns);
  record.item.set_moving(moving);
  change(record);
}

void SharedWorld::change(Record& record) {
  record.item.set_change(record.item.change() + 1);
  record.sent.dirty = true;
}

// An object of this server's own, whoever has published it meanwhile.
void SharedWorld::define(ItemId id, const LocalItem& local, std::int64_t now_ns) {
  Record& record = records_[id];
  const bool is_new = record.item.id() == 0 || record.item.gone();
  const bool was_away = !is_new && !isOwn(record);
  // Another server of this name, or this one before it was started anew: it is waited for.
  if (was_away && record.item.definer_name() == self_.name && record.item.definer() == record.item.owner() &&
      peers_.isThere(record.item.owner(), now_ns))
    return;
  if (is_new || was_away) {
    ItemMotion motion = local.motion;
    if (was_away && local.content->body()) {
      motion = record.track.newest();
      returned_.push_back({id, motion});
    }
    counts_.returned += was_away ? 1 : 0;
    record.item.set_id(id);
    own(record, record.item.epoch() + 1, motion, now_ns);
  } else if (record.content != local.content) {
    change(record);
  }
  if (record.content == local.content && record.item.definer() == self_.id) return;
  names_changed_ = true;
  record.content = local.content;
  *record.item.mutable_content() = *local.content;
  record.item.set_definer(self_.id);
  record.item.set_definer_name(self_.name);
}

void SharedWorld::publish(const LocalItems& local, bool complete, std::int64_t now_ns) {
  for (const auto& [id, item] : local) {
    if (item.content) define(id, item, now_ns);
    const auto record = records_.find(id);
    if (record != records_.end() && isOwn(record->second)) look(record->second, item.motion, now_ns);
  }
  endDeleted(local, complete, now_ns);
  streamMoving(now_ns);
}

// What is sent of it: that it begins to move, where it is once a second, and where it has come to rest.
void SharedWorld::look(Record& record, const ItemMotion& motion, std::int64_t now_ns) {
  Sent& sent = record.sent;
  const bool moved = !(motion.pose == sent.motion.pose);
  sent.still = moved ? 0 : sent.still + 1;
  if (moved && !record.item.moving()) {
    setMotion(record, sent.motion, sent.time_ns, true);  // until the last look it was there
    sent.item_ns = now_ns;
  }
  sent.motion = motion;
  sent.time_ns = now_ns;
  const bool rests = sent.still >= kStillLooks;
  if (!record.item.moving() || (!rests && now_ns - sent.item_ns < kKeyItem_ns)) return;
  if (rests) sent.motion.velocity_m_s = sent.motion.spin_rad_s = Vec3::Zero();
  setMotion(record, sent.motion, now_ns, !rests);
  sent.item_ns = now_ns;
}

// What this server has defined and does not any more; and what it had defined before it was started anew.
void SharedWorld::endDeleted(const LocalItems& local, bool complete, std::int64_t now_ns) {
  const bool settled = complete && now_ns - begin_ns_ > kSettled_ns && peers_.sameName(now_ns) == nullptr;
  for (auto& [id, record] : records_) {
    if (record.item.gone() || local.contains(id)) continue;
    const bool ours = record.item.definer() == self_.id;
    const bool left = record.item.definer_name() == self_.name && !peers_.isThere(record.item.definer(), now_ns);
    if (!ours && !(left && settled)) continue;
    own(record, isOwn(record) ? record.item.epoch() : record.item.epoch() + 1, {}, now_ns);
    names_changed_ = true;
    record.item.set_gone(true);
    record.item.clear_content();
    record.item.clear_motion();
    record.content = nullptr;
  }
}

void SharedWorld::streamMoving(std::int64_t now_ns) {
  proto::ShareMessage message;
  proto::SharePoses& poses = *message.mutable_poses();
  std::uint64_t slot = kPoseSlots;
  const auto flush = [&] {
    if (poses.items_size() == 0) return;
    poses.set_from(self_.id);
    poses.set_time_ns(now_ns);
    sendTo(Lane::kStream, streamKey(self_.id, slot++), message);
    poses.Clear();
  };
  for (const auto& [id, record] : records_) {
    if (!isOwn(record) || record.item.gone() || !record.item.moving()) continue;
    proto::ItemPose& pose = *poses.add_items();
    pose.set_id(id);
    pose.set_epoch(record.item.epoch());
    toProto(record.sent.motion, *pose.mutable_motion());
    if (poses.items_size() >= kPosesInPacket) flush();
  }
  flush();
}

void SharedWorld::publishHand(std::uint32_t number, const proto::OtherDevice& hand, std::int64_t now_ns) {
  proto::ShareMessage message;
  message.mutable_hand()->set_from(self_.id);
  message.mutable_hand()->set_time_ns(now_ns);
  message.mutable_hand()->set_number(number);
  *message.mutable_hand()->mutable_hand() = hand;
  sendTo(Lane::kStream, streamKey(self_.id, kHandSlots + number), message);
}

void SharedWorld::press(const ItemPush& push) {
  const auto found = records_.find(push.id);
  if (found == records_.end() || isOwn(found->second) || !found->second.item.content().body()) return;
  proto::ShareMessage message;
  proto::SharePush& out = *message.mutable_push();
  out.set_from(self_.id);
  out.set_id(push.id);
  out.set_number(++push_numbers_[push.id]);
  out.set_duration_s(push.duration_s);
  toProto(push.impulse_N_s, *out.mutable_impulse_n_s());
  toProto(push.point_O, *out.mutable_point_m());
  ++counts_.pushes_sent;
  post(found->second.item.owner(), std::move(message));
}

void SharedWorld::sendInbox() {
  while (!inbox_out_.empty() && sendTo(Lane::kInbox, inbox_out_.front().first, inbox_out_.front().second))
    inbox_out_.pop_front();
}

// Objects whose owner is lost: they rest where they were shown last, but for bodies, which go on from there.
void SharedWorld::adoptOrphans(std::int64_t now_ns) {
  if (!peers_.isAdopter(now_ns)) return;
  for (auto& [id, record] : records_) {
    if (isOwn(record) || record.item.gone() || peers_.isThere(record.item.owner(), now_ns)) continue;
    if (now_ns - record.heard_ns < Peers::kLease_ns) continue;  // its owner may be about to be heard
    ItemMotion motion = record.track.newest();
    if (!record.item.content().body() || record.item.content().jointed())
      motion.velocity_m_s = motion.spin_rad_s = Vec3::Zero();
    own(record, record.item.epoch() + 1, motion, now_ns);
    record.begin = motion;
    ++counts_.adopted;
  }
}

// What was deleted a minute ago: whoever joins now hears nothing of it but that.
void SharedWorld::forget(std::int64_t now_ns) {
  constexpr std::int64_t kKept_ns = 60'000'000'000;
  peers_.forget(now_ns);
  forgetDeleted(records_.size() > kMaxRecords ? now_ns : now_ns - kKept_ns);
  full_ = false;
}

void SharedWorld::forgetDeleted(std::int64_t before_ns) {
  std::erase_if(records_, [&](const auto& entry) {
    const Record& record = entry.second;
    return record.item.gone() && !record.sent.dirty && std::max(record.heard_ns, record.sent.time_ns) < before_ns;
  });
}

// What was deleted makes room. Where there is none it is looked for once a beat, as the look takes long.
bool SharedWorld::hasRoom() {
  if (records_.size() >= kMaxRecords && !full_) {
    forgetDeleted(std::numeric_limits<std::int64_t>::max());
    full_ = records_.size() >= kMaxRecords;
  }
  return records_.size() < kMaxRecords;
}

void SharedWorld::linkAgain(std::int64_t deaf_ns, std::int64_t now_ns) {
  peers_.hearAgain(deaf_ns, now_ns);
  for (auto& [_, record] : records_) record.sent.dirty |= isOwn(record);
}

void SharedWorld::sendItems() {
  for (auto& [id, record] : records_) {
    if (!isOwn(record) || !record.sent.dirty) continue;
    proto::ShareMessage message;
    *message.mutable_item() = record.item;
    if (!sendTo(Lane::kItems, id, message)) return;
    record.sent.dirty = false;
  }
}

// What of the objects of others is not here, of their owner first; what no object has goes. When an object has changed,
// and with each beat, as other servers may be there.
void SharedWorld::chooseContents(std::int64_t now_ns) {
  names_changed_ = false;
  std::set<std::string> wanted;
  const std::vector<ServerId> there = peers_.there(now_ns);
  for (const auto& [id, record] : records_) {
    if (record.item.gone()) continue;
    const ServerId owner = record.item.owner();
    std::vector<ServerId> from{owner};
    std::copy_if(there.begin(), there.end(), std::back_inserter(from), [&](ServerId peer) { return peer != owner; });
    for (const ContentName& name : {nameOf(record.item.content().shape()), nameOf(record.item.content().surfaces())}) {
      wanted.insert(name.sha256);
      if (!isOwn(record) && !contents_.find(name)) contents_.want(name, from, now_ns);
    }
  }
  contents_.keepOnly([&](const std::string& sha256) { return wanted.contains(sha256); });
}

void SharedWorld::step(std::int64_t now_ns) {
  peers_.followClocks(now_ns);
  if (now_ns - beat_ns_ >= Peers::kBeat_ns) {
    beat_ns_ = now_ns;
    proto::ShareMessage message;
    *message.mutable_beat() = peers_.beat(now_ns);
    sendTo(Lane::kStream, streamKey(self_.id, kBeatSlot), message);
    forget(now_ns);
    adoptOrphans(now_ns);
    names_changed_ = true;
  }
  sendItems();
  sendInbox();
  if (names_changed_) chooseContents(now_ns);
  contents_.step(now_ns);
  if (counts_.join_s == 0 && !peers_.all().empty() && contents_.fetching() == 0 && !replicas(now_ns).empty())
    counts_.join_s = seconds(now_ns - begin_ns_);
}

std::vector<Replica> SharedWorld::replicas(std::int64_t now_ns) const {
  std::vector<Replica> replicas;
  for (const auto& [id, record] : records_) {
    if (record.item.gone() || record.item.definer() == self_.id) continue;
    Replica replica{id, record.item.owner(), record.content, record.sent.motion.pose, isOwn(record), record.begin};
    if (!replica.own) {
      const auto shown_ns = peers_.shownTimeThere_ns(record.item.owner(), now_ns);
      replica.pose = shown_ns ? record.track.at(*shown_ns) : record.track.newest().pose;
    }
    replicas.push_back(std::move(replica));
  }
  return replicas;
}

ShareCounts SharedWorld::counts(std::int64_t now_ns) const {
  ShareCounts counts = counts_;
  counts.peers = peers_.there(now_ns).size();
  for (const auto& [_, record] : records_) {
    counts.items += record.item.gone() ? 0 : 1;
    counts.own_items += !record.item.gone() && isOwn(record) ? 1 : 0;
  }
  for (const auto& [_, peer] : peers_.all()) {
    counts.playout_ms = std::max(counts.playout_ms, 1e-6 * static_cast<double>(peer.delay.delay_ns()));
    counts.round_trip_ms = std::max(counts.round_trip_ms, 1e-6 * static_cast<double>(peer.clock.roundTrip_ns()));
  }
  counts.fetching = contents_.fetching();
  counts.fetched_bytes = contents_.fetched_bytes();
  return counts;
}

}  // namespace hl
