// ClientCallbacks: how a client is told what becomes of its frames.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/function_ref.h"
#include "base/guarded_thread.h"

namespace hl {

/// What becomes of a client's frames; all three are needed. Called by builders and by the publisher, one call at a time
/// for one client.
struct FrameCallbacks {
  std::function<void(std::uint64_t number, double part)> progress;
  std::function<void(std::uint64_t number, std::size_t primitives, const std::vector<std::string>& warnings)> shown;
  std::function<void(std::uint64_t number, const std::string& why)> refused;
};

/// Any thread.
class ClientCallbacks {
 public:
  using Call = FunctionRef<void(const FrameCallbacks&)>;

  explicit ClientCallbacks(FrameCallbacks callbacks) : callbacks_(std::move(callbacks)) {}

  /// Unless the client has gone.
  void call(Call call) {
    const std::lock_guard lock(mutex_);
    if (callbacks_.shown) call(callbacks_);
  }
  /// As call(), and once more while it throws and `wanted` holds: a client gets the answer that it waits for in the
  /// end, however short memory is meanwhile.
  void answer(const std::atomic<bool>& wanted, Call call) noexcept {
    keepTrying([&] { return wanted.load(); }, [&] { this->call(call); });
  }
  /// The client has gone: no call is under way or comes after this.
  void drop() {
    const std::lock_guard lock(mutex_);
    callbacks_ = {};
  }

 private:
  std::mutex mutex_;
  FrameCallbacks callbacks_;
};

}  // namespace hl
