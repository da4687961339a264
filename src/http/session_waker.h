// SessionWaker: wakes the writer of a session from any thread, and never after the session has gone.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

#include "base/guarded_thread.h"
#include "http/connection.h"

namespace hl {

class SessionWaker : public std::enable_shared_from_this<SessionWaker> {
 public:
  explicit SessionWaker(boost::asio::io_context& context) : context_(context), timer_(std::in_place, context) {}

  /// Any thread; returns at once and throws nothing. Several calls before the writer wakes count as one. Without memory
  /// to wake it, it sees the call when it wakes by itself.
  void wake() noexcept {
    const std::scoped_lock lock(mutex_);
    if (closed_) return;
    woken_ = true;
    if (on_its_way_) return;
    on_its_way_ = guarded([this] {
      boost::asio::post(context_, [self = shared_from_this()] {
        if (self->timer_) self->timer_->cancel();
      });
    });
  }

  /// The context's thread: returns when woken, but after `longest` at the latest. A call of wake() since the last wait
  /// counts.
  boost::asio::awaitable<void> wait(std::chrono::nanoseconds longest) {
    if (take()) co_return;
    timer_->expires_after(longest);
    co_await timer_->async_wait(kAwait);
    take();
  }

  /// The context's thread, when nothing waits: from now on wake() does nothing, and the context may go.
  void close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    timer_.reset();
  }

 private:
  bool take() {
    const std::scoped_lock lock(mutex_);
    const bool woken = woken_;
    woken_ = on_its_way_ = false;
    return woken;
  }

  boost::asio::io_context& context_;
  std::optional<boost::asio::steady_timer> timer_;
  std::mutex mutex_;
  bool woken_ = false;
  bool on_its_way_ = false;  // the posted call, to the context's thread
  bool closed_ = false;
};

}  // namespace hl
