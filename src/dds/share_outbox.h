// ShareOutbox: what a server sends to the others of its world, by writers of Cyclone DDS. A writer that is full, as
// another server is slow, holds up nothing else: its packets wait here.
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "share/share_link.h"
#include "share/share_task.h"

namespace hl {

/// One thread; nothing waits.
class ShareOutbox {
 public:
  ShareOutbox(dds_entity_t participant, const ShareTask& task);

  void send(SharePacket packet, std::int64_t now_ns);
  /// Tries again what waits.
  void flush(std::int64_t now_ns);
  /// Bytes of items and of inboxes.
  std::uint64_t waiting_bytes() const { return waiting_bytes_; }

 private:
  /// Whoever is not there for so long gets nothing of what waits: it was never there, or has gone.
  static constexpr std::int64_t kPatience_ns = 5'000'000'000;
  struct Inbox {
    dds_entity_t writer = 0;
    std::deque<std::string> waiting{};
    std::int64_t seen_ns = 0;  // when its server was there
  };
  bool write(dds_entity_t writer, std::uint64_t key, const std::string& bytes) const;
  void flushItems();
  void flush(ServerId to, Inbox& inbox, std::int64_t now_ns);

  const dds_entity_t participant_;
  const ShareTask task_;
  const dds_entity_t items_, stream_;
  std::map<std::uint64_t, std::string> waiting_items_;  // by key: the newest
  std::map<ServerId, Inbox> inboxes_;
  std::uint64_t waiting_bytes_ = 0;
};

/// Of a writer or reader of this lane.
dds_entity_t makeShareWriter(dds_entity_t participant, const ShareTask& task, Lane lane, ServerId to = 0);
dds_entity_t makeShareReader(dds_entity_t participant, const ShareTask& task, Lane lane);

}  // namespace hl
