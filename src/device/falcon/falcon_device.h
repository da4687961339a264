// FalconDevice: a Novint Falcon over its own USB protocol, with nothing of the vendor's but the firmware that the user
// has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/guarded_thread.h"
#include "device/device.h"
#include "device/exchange.h"
#include "device/falcon/falcon_protocol.h"
#include "device/falcon/falcon_transport.h"

namespace hl {

/// Which of several Falcons is meant, and the file of its firmware.
struct FalconChoice {
  std::size_t index = 0;  ///< in the order of USB bus and ports
  std::string firmware;

  /// From INDEX, FIRMWARE, INDEX,FIRMWARE, or nothing. What is all digits is an index. Throws hl::Error.
  static FalconChoice parse(const std::string& text);
};

/// A thread of its own exchanges frames with the device, a thousand a second.
class FalconDevice final : public Device {
 public:
  /// `firmware`: the user's file; empty: the one that HL_FALCON_FIRMWARE names, if any. It is read when it is needed.
  explicit FalconDevice(std::unique_ptr<FalconTransport> transport, const std::string& firmware = "");
  ~FalconDevice() override { close(); }

  void open() override;
  void close() override;
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read(std::int64_t now_ns) override { return exchange_->newest(now_ns); }
  void write(const Vec3& force_N) override { exchange_->pull(force_N); }

  /// What is there. Throws hl::Error with what to do.
  static std::string find();

 private:
  void begin();  // throws
  bool beginAgain();
  void run();
  bool talk(const FalconCommand& command, FalconReply& reply);
  bool step(const Vec3& force_D);

  std::unique_ptr<FalconTransport> transport_;
  std::string firmware_file_;
  std::vector<std::uint8_t> firmware_;  // once it was needed
  DeviceInfo info_;
  std::unique_ptr<Exchange> exchange_;
  bool home_ = true;
  Vec3 tip_F_;
  Vec3 angles_ = Vec3::Zero();
  bool located_ = false;  // tip and angles are those of the last reply
  LoopThread thread_;
};

}  // namespace hl
