#include "device/lifeline.h"

#include <chrono>
#include <utility>

#include "base/guarded_thread.h"

namespace hl {

namespace {

constexpr auto kLookEvery = std::chrono::milliseconds(50);  // between two looks; nobody waits for a shorter one

}  // namespace

Lifeline::Lifeline(std::function<bool()> reopen)
    : reopen_(std::move(reopen)), thread_(startThread("lifeline", [this] { run(); })) {}

Lifeline::~Lifeline() {
  running_ = false;
  thread_.join();
}

void Lifeline::run() {
  while (running_) {
    if (!holds() && reopen_()) holds_.store(true, std::memory_order_release);
    std::this_thread::sleep_for(kLookEvery);
  }
}

}  // namespace hl
