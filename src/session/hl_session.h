// HlSession: the protocol of one HL client: what may come when, what is refused, and what is sent in return.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/memory_budget.h"
#include "session/client_session.h"
#include "session/limits.h"
#include "session/message_rate.h"
#include "session/reply_queue.h"
#include "session/scene_publisher.h"
#include "session/session_bodies.h"
#include "session/touch_world.h"
#include "session/upload_store.h"

namespace hl {

class HlSession final : public ClientSession {
 public:
  /// `leave` is called first of all that the destructor does: from then on nobody may call its notify().
  HlSession(TouchWorld& world, std::uint32_t number, WakeSession wake, std::function<void(const HlSession&)> leave);
  ~HlSession() override;

  void receive(proto::ClientMessage message) override;
  void refuse(const proto::ClientMessage& outline, const std::string& why) override;
  MemoryBudget memory() const override { return memory_; }
  bool take(proto::ServerReply& reply) override;
  double nextState_s() const override;
  std::string end() const override { return replies_.end(); }

  std::uint32_t number() const { return number_; }
  const SessionBodies& bodies() const { return bodies_; }
  std::uint32_t device() const { return device_; }
  /// An object of this session was touched or left, or a button of its device moved. Any thread.
  void notify(const proto::Event& event);
  /// Ends the session with this reason. Any thread.
  void end(const std::string& why) { replies_.end(why); }

 private:
  /// When the client is sent the state.
  struct StateTimer {
    double period_s = 0;  // 0: never
    double next_s = 0;    // server's clock
  };

  /// Numbers of the device's moments that are to be sent next; none: the client wants none.
  struct MomentsToSend {
    std::optional<std::uint64_t> sample, contact;
    bool reported = false;  // the contacts, before the state that comes next
  };

  void open(const proto::Open& open);
  void keepUploads(proto::Uploads uploads);
  void keepUpload(proto::Upload upload);
  void submit(proto::Frame frame);
  void refuseUpload(std::uint64_t id, const std::string& why);
  std::optional<std::uint32_t> chosenDevice(const proto::Open& open) const;
  std::string missingDevice(const proto::Open& open) const;
  void setDevice(const proto::DeviceSettings& settings);
  void setStateRate(double rate_Hz);
  void want(bool wanted, std::optional<std::uint64_t>& next) const;
  void wantBodies(const proto::BodyRequest& request);
  void act(const proto::BodyCommand& command);
  void act(const proto::BodyCommands& message);
  void setIso(const proto::IsoChange& change);
  void refuse(const std::string& why, std::uint64_t frame = 0);
  FrameCallbacks callbacks();

  TouchWorld& world_;
  const std::uint32_t number_;
  const std::function<void(const HlSession&)> leave_;
  const MemoryBudget memory_;  // of all that this client makes the server keep
  ReplyQueue replies_;

  // Of the connection's thread:
  bool opened_ = false, master_ = false, keep_objects_ = false;
  std::string client_name_;
  std::atomic<std::uint32_t> device_{0};  // read by others
  std::shared_ptr<ClientScene> place_;
  UploadStore uploads_;
  std::uint64_t last_frame_ = 0;
  StateTimer states_;
  MomentsToSend next_;
  SessionBodies bodies_;
  MessageRate frame_rate_;
};

}  // namespace hl
