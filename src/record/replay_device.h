// ReplayDevice: a recording as a device: the finger goes where it went then, on the clock it is given, to the end and
// back and so on, without a jump. Forces are taken and not felt.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/device.h"

namespace hl {

class ReplayDevice final : public Device {
 public:
  explicit ReplayDevice(std::string file) : file_(std::move(file)) {}

  /// Reads the file: as the device of the recording was, its samples that were good.
  void open() override;
  void close() override {}
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read(std::int64_t now_ns) override;
  void write(const Vec3&) override {}

 private:
  std::string file_;
  DeviceInfo info_;
  std::vector<DeviceSample> samples_;  // by rising time, the first at 0; at least two
  std::size_t at_ = 0;                 // the sample before the moment, never the last
  std::int64_t begin_ns_ = 0;
  bool begun_ = false;
};

/// Every device there is: those of openDevice() and replay:FILE. Throws hl::Error.
std::unique_ptr<Device> makeAnyDevice(const std::string& spec);
std::unique_ptr<Device> openAnyDevice(const std::string& spec);
/// The file that it replays; empty: none.
std::string replayedFile(const std::string& spec);
/// How to write every spec, with | between them.
std::string anyDeviceSpecs();

}  // namespace hl
