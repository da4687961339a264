// ReplyInbox: replies on their way from the link's thread to the program's, in order; of states only the newest.
#pragma once

#include <hl.pb.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace hl {

/// Any thread.
class ReplyInbox {
 public:
  /// A state takes the place of one that still waits. Returns how many replies wait.
  std::size_t put(proto::ServerReply reply) {
    const std::scoped_lock lock(mutex_);
    const bool is_state = reply.has_state();
    if (is_state && state_) {
      replies_.erase(*state_);
      state_.reset();
    }
    replies_.push_back(std::move(reply));
    if (is_state) state_ = std::prev(replies_.end());
    arrived_.notify_all();
    return replies_.size();
  }

  bool take(proto::ServerReply& reply) {
    const std::scoped_lock lock(mutex_);
    if (replies_.empty()) return false;
    if (state_ == replies_.begin()) state_.reset();
    reply = std::move(replies_.front());
    replies_.pop_front();
    return true;
  }

  /// Until there is a reply or the end has come, but not longer; whether there is a reply.
  bool wait(std::chrono::nanoseconds longest) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, longest, [this] { return !replies_.empty() || !end_.empty(); });
    return !replies_.empty();
  }

  /// The first reason stays.
  void end(const std::string& why) {
    const std::scoped_lock lock(mutex_);
    if (end_.empty()) end_ = why;
    arrived_.notify_all();
  }

  std::string ended() const {
    const std::scoped_lock lock(mutex_);
    return end_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::list<proto::ServerReply> replies_;
  std::optional<std::list<proto::ServerReply>::iterator> state_;  // the one that waits
  std::string end_;
};

}  // namespace hl
