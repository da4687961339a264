// Lifeline: brings a lost device back, on a thread of its own, for opening one takes long.
// The servo thread and this one hand the device to each other: while it is lost only this one calls it.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace hl {

class Lifeline {
 public:
  /// `reopen` lets go of the device and tries once to have it again; it must not throw.
  explicit Lifeline(std::function<bool()> reopen);
  ~Lifeline();
  Lifeline(const Lifeline&) = delete;
  Lifeline& operator=(const Lifeline&) = delete;

  /// Servo thread, RT-safe: whether it may call the device.
  bool holds() const { return holds_.load(std::memory_order_acquire); }
  /// Servo thread, RT-safe: the device does not answer; from now on it must not call it until holds().
  void lose() { holds_.store(false, std::memory_order_release); }

 private:
  void run();

  std::function<bool()> reopen_;
  std::atomic<bool> holds_{true};
  std::atomic<bool> running_{true};
  std::thread thread_;
};

}  // namespace hl
