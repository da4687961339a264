// ShareProcess: hl-share, started with a socket to it.
#pragma once

#include <string>

#include "ros/dds_process.h"
#include "share/share_link.h"
#include "share/share_task.h"

namespace hl {

inline constexpr DdsProgram kShareProgram{
    "hl-share",
    "worlds are shared by hl-share, which is not here: install the package hl-share, or run scripts/deps --ros and "
    "scripts/build"};

/// Ends with this object. What hl-share cannot send at once, as others are slow, waits there, up to kMaxWaiting_bytes;
/// then send() takes the stream alone, until receive() has heard that less waits.
class ShareProcess final : public ShareLink {
 public:
  /// As DdsProcess.
  explicit ShareProcess(const ShareTask& task) : process_(kShareProgram, wordsOf(task)) {}

  void wait(std::int64_t most_ns) override { process_.wait(most_ns); }
  bool send(const SharePacket& packet) override;
  std::optional<SharePacket> receive() override;
  bool ended() const override { return process_.ended(); }
  bool startAgain() override;

  static constexpr std::uint64_t kMaxWaiting_bytes = 16'000'000;

 private:
  DdsProcess process_;
  std::uint64_t waiting_bytes_ = 0;
  std::string buffer_ = std::string(kMaxShareMessage_bytes + 1, '\0');
};

}  // namespace hl
