#include "device/device_claim.h"

#include <mutex>
#include <set>
#include <utility>

#include "base/error.h"

namespace hl {

namespace {

struct ClaimedDevices {
  std::mutex mutex;
  std::set<std::string> keys;
};

// Never destroyed: devices may be closed by other destructors at the end of the process.
ClaimedDevices& claimedDevices() {
  static auto* const claimed = new ClaimedDevices;
  return *claimed;
}

}  // namespace

DeviceClaim::DeviceClaim(const std::string& key) {
  ClaimedDevices& claimed = claimedDevices();
  const std::lock_guard lock(claimed.mutex);
  if (!claimed.keys.insert(key).second)
    throw Error("the device " + key + " is open in this program already: two names lead to it, and one must go");
  key_ = key;
}

DeviceClaim& DeviceClaim::operator=(DeviceClaim&& other) noexcept {
  if (this == &other) return *this;
  release();
  key_ = std::move(other.key_);
  other.key_.clear();
  return *this;
}

void DeviceClaim::release() noexcept {
  if (key_.empty()) return;
  ClaimedDevices& claimed = claimedDevices();
  const std::lock_guard lock(claimed.mutex);
  claimed.keys.erase(key_);
  key_.clear();
}

bool DeviceClaim::isTaken(const std::string& key) {
  ClaimedDevices& claimed = claimedDevices();
  const std::lock_guard lock(claimed.mutex);
  return claimed.keys.contains(key);
}

}  // namespace hl
