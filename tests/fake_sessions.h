// A SessionHost without a scene: it remembers what clients send and answers as they ask, for tests of what carries the
// messages.
#pragma once

#include <hl.pb.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/error.h"
#include "session/client_session.h"

namespace hl::test {

/// What all sessions of a FakeHost have done. Any thread.
struct FakeRecord {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<proto::ClientMessage> received;  // but for uploads, of which only the bytes are counted
  std::size_t upload_bytes = 0;
  int alive = 0;
  int ever = 0;
  std::vector<int> states_taken;  // by session, in the order of their birth
  std::string end_all;            // why every session shall end
  bool hold = false;              // a Frame with objects is not taken in until this is false again
  int held = 0;                   // sessions that wait so
};

/// Answers Open with Welcome, a Frame with FrameShown, and sends states of `state_bytes` at the rate asked for.
class FakeSession : public ClientSession {
 public:
  FakeSession(std::shared_ptr<FakeRecord> record, std::size_t state_bytes)
      : record_(std::move(record)), state_bytes_(state_bytes) {
    const std::scoped_lock lock(record_->mutex);
    ++record_->alive;
    number_ = record_->ever++;
    record_->states_taken.push_back(0);
    record_->changed.notify_all();
  }
  ~FakeSession() override {
    const std::scoped_lock lock(record_->mutex);
    --record_->alive;
    record_->changed.notify_all();
  }

  void receive(proto::ClientMessage message) override {
    if (message.has_open()) {
      rate_Hz_ = message.open().state_rate_hz();
      replies_.emplace_back().mutable_welcome()->set_session(static_cast<std::uint32_t>(number_));
    }
    if (message.has_frame()) replies_.emplace_back().mutable_frame_shown()->set_number(message.frame().number());
    if (message.has_state_rate()) rate_Hz_ = message.state_rate().rate_hz();
    std::unique_lock lock(record_->mutex);
    if (message.frame().objects_size() > 0) {
      ++record_->held;
      record_->changed.notify_all();
      record_->changed.wait(lock, [this] { return !record_->hold; });
      --record_->held;
    }
    if (message.has_upload()) {
      record_->upload_bytes += message.ByteSizeLong();
    } else {
      record_->received.push_back(std::move(message));
    }
    record_->changed.notify_all();
  }

  void refuse(const proto::ClientMessage&, const std::string& why) override {
    replies_.emplace_back().mutable_refusal()->set_text(why);
  }

  bool take(proto::ServerReply& reply) override {
    if (!replies_.empty()) {
      reply = std::move(replies_.front());
      replies_.pop_front();
      return true;
    }
    if (takeEvent(reply)) return true;
    if (nextState_s() > 0) return false;
    due_ns_ = monotonicNow_ns() + static_cast<std::int64_t>(1e9 / rate_Hz_);
    reply.mutable_state()->set_time_s(++states_);
    reply.mutable_state()->set_fault(std::string(state_bytes_, 'x'));
    const std::scoped_lock lock(record_->mutex);
    ++record_->states_taken[static_cast<std::size_t>(number_)];
    record_->changed.notify_all();
    return true;
  }

  double nextState_s() const override {
    if (rate_Hz_ <= 0) return std::numeric_limits<double>::infinity();
    return std::max(0.0, 1e-9 * static_cast<double>(due_ns_ - monotonicNow_ns()));
  }

  std::string end() const override {
    const std::scoped_lock lock(record_->mutex);
    return record_->end_all;
  }

  std::atomic<int> events{0};  ///< that wait to be taken

 private:
  bool takeEvent(proto::ServerReply& reply) {
    if (events == 0) return false;
    --events;
    reply.mutable_event()->set_kind(proto::TOUCH);
    return true;
  }

  std::shared_ptr<FakeRecord> record_;
  std::size_t state_bytes_;
  std::deque<proto::ServerReply> replies_;
  double rate_Hz_ = 0;
  std::int64_t due_ns_ = 0;
  int states_ = 0;
  int number_ = 0;
};

class FakeHost : public SessionHost {
 public:
  explicit FakeHost(std::size_t state_bytes = 100, int most = 1'000'000) : state_bytes_(state_bytes), most_(most) {}

  std::unique_ptr<ClientSession> connect(WakeSession wake) override {
    const std::scoped_lock lock(mutex_);
    if (alive() >= most_) throw Error("no room for another session");
    auto session = std::make_unique<FakeSession>(record_, state_bytes_);
    newest_ = session.get();
    wake_newest_ = std::move(wake);
    return session;
  }

  /// An event for the session that came last, which must be alive.
  void pushEvent() {
    const std::scoped_lock lock(mutex_);
    ++newest_->events;
    wake_newest_();
  }

  void endAll(const std::string& why) {
    const std::scoped_lock lock(mutex_, record_->mutex);
    record_->end_all = why;
    if (wake_newest_) wake_newest_();
  }

  /// While `on`, a session that receives a Frame with objects stays in receive(), as if it had much to decode.
  void holdFrames(bool on) {
    const std::scoped_lock lock(record_->mutex);
    record_->hold = on;
    record_->changed.notify_all();
  }

  int alive() const {
    const std::scoped_lock lock(record_->mutex);
    return record_->alive;
  }
  int ever() const {
    const std::scoped_lock lock(record_->mutex);
    return record_->ever;
  }
  int statesTaken(std::size_t session) const {
    const std::scoped_lock lock(record_->mutex);
    return record_->states_taken.at(session);
  }
  std::size_t uploadBytes() const {
    const std::scoped_lock lock(record_->mutex);
    return record_->upload_bytes;
  }
  std::vector<proto::ClientMessage> received() const {
    const std::scoped_lock lock(record_->mutex);
    return record_->received;
  }
  /// Waits without end for what must come: a test that waits in vain ends by its own time limit.
  template <typename Condition>
  void waitUntil(Condition condition) const {
    std::unique_lock lock(record_->mutex);
    record_->changed.wait(lock, [&] { return condition(*record_); });
  }
  void waitForHeld(int count) const {
    waitUntil([count](const FakeRecord& record) { return record.held == count; });
  }
  void waitForAlive(int count) const {
    waitUntil([count](const FakeRecord& record) { return record.alive == count; });
  }

 private:
  std::shared_ptr<FakeRecord> record_ = std::make_shared<FakeRecord>();
  std::size_t state_bytes_;
  int most_;
  std::mutex mutex_;  // guards what follows
  FakeSession* newest_ = nullptr;
  WakeSession wake_newest_;
};

}  // namespace hl::test
