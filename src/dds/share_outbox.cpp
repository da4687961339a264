#include "dds/share_outbox.h"

#include <share.h>

#include <iterator>
#include <utility>

#include "dds/dds_node.h"

namespace hl {

namespace {

// Of an inbox, in each writer and reader: 8 MB of parts of contents.
constexpr std::int32_t kInboxSamples = 512;

// Nothing that is written waits: what does not fit is tried again.
Qos qosOf(Lane lane) {
  Qos qos = emptyQos();
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  if (lane == Lane::kStream) {
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
    return qos;
  }
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);
  if (lane == Lane::kInbox) {
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 1);
    dds_qset_resource_limits(qos.get(), kInboxSamples, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
    return qos;
  }
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED);
  return qos;
}

dds_entity_t topicOf(dds_entity_t participant, const ShareTask& task, Lane lane, ServerId to) {
  return made(
      dds_create_topic(participant, &hl_share_Packet_desc, shareTopic(task.world, lane, to).c_str(), nullptr, nullptr),
      "topic");
}

bool isThere(dds_entity_t writer) { return dds_get_matched_subscriptions(writer, nullptr, 0) > 0; }

}  // namespace

dds_entity_t makeShareWriter(dds_entity_t participant, const ShareTask& task, Lane lane, ServerId to) {
  return made(dds_create_writer(participant, topicOf(participant, task, lane, to), qosOf(lane).get(), nullptr),
              "writer");
}

dds_entity_t makeShareReader(dds_entity_t participant, const ShareTask& task, Lane lane) {
  return made(dds_create_reader(participant, topicOf(participant, task, lane, task.server), qosOf(lane).get(), nullptr),
              "reader");
}

ShareOutbox::ShareOutbox(dds_entity_t participant, const ShareTask& task)
    : participant_(participant),
      task_(task),
      items_(makeShareWriter(participant, task, Lane::kItems)),
      stream_(makeShareWriter(participant, task, Lane::kStream)) {}

bool ShareOutbox::write(dds_entity_t writer, std::uint64_t key, const std::string& bytes) const {
  hl_share_Packet packet{};
  packet.server = task_.server;
  packet.key = key;
  packet.bytes._length = packet.bytes._maximum = static_cast<std::uint32_t>(bytes.size());
  packet.bytes._buffer = reinterpret_cast<std::uint8_t*>(const_cast<char*>(bytes.data()));
  return dds_write(writer, &packet) != DDS_RETCODE_TIMEOUT;
}

void ShareOutbox::send(SharePacket packet, std::int64_t now_ns) {
  if (packet.lane == Lane::kStream) {
    write(stream_, packet.key, packet.bytes);
    return;
  }
  waiting_bytes_ += packet.bytes.size();
  if (packet.lane == Lane::kItems) {
    std::string& newest = waiting_items_[packet.key];
    waiting_bytes_ -= newest.size();
    newest = std::move(packet.bytes);
    return flushItems();
  }
  Inbox& inbox = inboxes_[packet.key];
  if (inbox.writer == 0) {
    inbox.writer = makeShareWriter(participant_, task_, Lane::kInbox, packet.key);
    inbox.seen_ns = now_ns;
  }
  inbox.waiting.push_back(std::move(packet.bytes));
  flush(packet.key, inbox, now_ns);
}

void ShareOutbox::flushItems() {
  for (auto item = waiting_items_.begin(); item != waiting_items_.end();) {
    if (!write(items_, item->first, item->second)) return;
    waiting_bytes_ -= item->second.size();
    item = waiting_items_.erase(item);
  }
}

void ShareOutbox::flush(ServerId to, Inbox& inbox, std::int64_t now_ns) {
  if (!isThere(inbox.writer)) return;
  inbox.seen_ns = now_ns;
  while (!inbox.waiting.empty() && write(inbox.writer, to, inbox.waiting.front())) {
    waiting_bytes_ -= inbox.waiting.front().size();
    inbox.waiting.pop_front();
  }
}

void ShareOutbox::flush(std::int64_t now_ns) {
  flushItems();
  for (auto one = inboxes_.begin(); one != inboxes_.end();) {
    flush(one->first, one->second, now_ns);
    const auto next = std::next(one);
    if (now_ns - one->second.seen_ns > kPatience_ns) {
      for (const std::string& bytes : one->second.waiting) waiting_bytes_ -= bytes.size();
      dds_delete(one->second.writer);
      inboxes_.erase(one);
    }
    one = next;
  }
}

}  // namespace hl
