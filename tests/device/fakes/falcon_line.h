// FalconLine: the other end of a Falcon's serial line, with a simulated arm behind it. After power-on it is a loader
// that takes one firmware and no other; then it answers each frame with one.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <vector>

#include "device/fakes/fake_arm.h"
#include "device/falcon/falcon_transport.h"

namespace hl::test {

/// What stays when the driver lets go of the line.
struct FalconBox {
  FakeArm arm;
  std::vector<std::uint8_t> firmware;      ///< the one that works
  std::atomic<bool> running{false};        ///< it has its firmware
  std::atomic<unsigned> homed{7};          ///< a bit for each leg
  std::atomic<bool> asked_to_home{false};  ///< by the last frame
};

class FakeFalconLine final : public FalconTransport {
 public:
  explicit FakeFalconLine(FalconBox& box) : box_(box) {}
  ~FakeFalconLine() override { close(); }

  void open() override;
  void close() override;
  bool set(FalconLine line) override;
  bool write(std::span<const std::uint8_t> bytes) override;
  std::size_t read(std::span<std::uint8_t> bytes) override;

 private:
  void load(std::span<const std::uint8_t> bytes);
  void obey(std::span<const std::uint8_t> frame);
  void answer();

  FalconBox& box_;
  bool open_ = false;
  bool loading_ = false;  // 'A' has been answered
  FalconLine line_ = FalconLine::kRun;
  std::vector<std::uint8_t> loaded_;
  std::deque<std::uint8_t> replies_;
};

}  // namespace hl::test
