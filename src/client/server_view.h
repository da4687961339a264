// ServerView: what the server has sent so far. Queries answer from it.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <optional>
#include <string>

namespace hl::client {

class ServerView {
 public:
  explicit ServerView(proto::Welcome welcome, std::uint32_t device) : welcome_(std::move(welcome)), device_(device) {}

  void take(proto::ClientState state);
  void take(proto::FrameShown shown) { shown_ = std::move(shown); }
  void take(const proto::Progress& progress) { progress_ = progress; }

  const proto::Welcome& welcome() const { return welcome_; }
  const proto::Limits& limits() const { return welcome_.limits(); }
  std::uint32_t deviceNumber() const { return device_; }
  /// The context's device; empty when the server has not sent it.
  const proto::DeviceInfo& device() const;
  /// The newest state; empty before the first.
  const proto::ClientState& state() const { return state_; }
  /// Seconds since the newest state was taken; infinite before the first.
  double stateAge_s() const;
  /// As the newest state says, before it as the welcome says.
  bool isMaster() const;
  /// The frame that is shown; number 0: none.
  const proto::FrameShown& shown() const { return shown_; }
  const proto::Progress& progress() const { return progress_; }

 private:
  proto::Welcome welcome_;
  std::uint32_t device_;
  proto::ClientState state_;
  std::optional<std::int64_t> state_taken_ns_;
  proto::FrameShown shown_;
  proto::Progress progress_;
};

}  // namespace hl::client
