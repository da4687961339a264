// ShareParticipant: a server of a shared world as the others see it, by Cyclone DDS. In the program hl-share only.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

#include "dds/dds_node.h"
#include "dds/share_outbox.h"

namespace hl {

class ShareParticipant {
 public:
  /// Called by a thread of its own; it may wait, and throws nothing. What comes meanwhile waits too, but for packets of
  /// the stream, in the place of which newer ones come.
  using Tell = std::function<void(const SharePacket&)>;

  /// Others can find it when it is there. Throws hl::Error.
  ShareParticipant(const ShareTask& task, Tell tell);
  ~ShareParticipant();
  ShareParticipant(const ShareParticipant&) = delete;
  ShareParticipant& operator=(const ShareParticipant&) = delete;

  /// Of one thread.
  ShareOutbox& out() { return out_; }

 private:
  void run();
  void take(Lane lane, dds_entity_t reader) const;

  const ShareTask task_;
  const Tell tell_;
  DdsNode node_;
  ShareOutbox out_;
  std::atomic<bool> running_{true};
  std::thread thread_;
};

}  // namespace hl
