// ShareParticipant: a server of a shared world as the others see it, by Cyclone DDS. In the program hl-share only.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <thread>

#include "dds/dds_node.h"
#include "dds/share_outbox.h"

namespace hl {

class ShareParticipant {
 public:
  /// Called by a thread of its own; it may wait, and throws nothing. What comes meanwhile waits too, but for packets of
  /// the stream, in the place of which newer ones come. What is malformed or too long is an empty packet of the stream.
  using Send = std::function<void(const SharePacket&)>;

  /// Others can find it when it is there. Throws hl::Error.
  ShareParticipant(const ShareTask& task, Send send);
  ~ShareParticipant();
  ShareParticipant(const ShareParticipant&) = delete;
  ShareParticipant& operator=(const ShareParticipant&) = delete;

  /// Before it nothing is sent.
  void start();
  /// Of one thread.
  ShareOutbox& out() { return out_; }

 private:
  struct Reader {
    Lane lane;
    dds_entity_t entity;
  };
  Reader makeReader(Lane lane) const;
  void run();
  bool takeOne(const Reader& reader) const;

  const ShareTask task_;
  const Send send_;
  std::atomic<std::uint64_t> malformed_{0};  // that have not been sent
  DdsNode node_;
  const dds_entity_t waitset_;
  const std::array<Reader, 3> readers_;
  ShareOutbox out_;
  std::atomic<bool> running_{false};
  std::thread thread_;
};

}  // namespace hl
