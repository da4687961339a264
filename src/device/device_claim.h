// DeviceClaim: one device is opened once in this process. Two names may lead to one device (its index and its serial
// number), and vendors' libraries do not all refuse the second.
#pragma once

#include <string>

namespace hl {

/// Held from open() to close(), also while the device is lost. Any thread.
class DeviceClaim {
 public:
  DeviceClaim() = default;
  /// `key` identifies the device. Throws hl::Error when another claim has it.
  explicit DeviceClaim(const std::string& key);
  ~DeviceClaim() { release(); }
  DeviceClaim(DeviceClaim&& other) noexcept : key_(std::move(other.key_)) { other.key_.clear(); }
  DeviceClaim& operator=(DeviceClaim&& other) noexcept;
  DeviceClaim(const DeviceClaim&) = delete;
  DeviceClaim& operator=(const DeviceClaim&) = delete;

  void release() noexcept;
  const std::string& key() const { return key_; }  ///< empty: it claims nothing
  static bool isTaken(const std::string& key);

 private:
  std::string key_;
};

}  // namespace hl
