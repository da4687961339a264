#include "touch/device_reader.h"

#include <utility>

#include "base/guarded_thread.h"

namespace hl {

DeviceSample DeviceReader::look(std::int64_t now_ns) noexcept {
  DeviceSample sample;
  const bool read = guarded([&] { sample = device_.read(now_ns); });
  if (!read) sample = DeviceSample{};
  if (!read) sample.time_ns = now_ns;
  if (std::exchange(step_failed_, false) || !read) sample.status = DeviceStatus::kLost;
  answered_ = sample.status == DeviceStatus::kOk;
  if (answered_) exchange_.finger_D.write(sample.position);
  sample.stylus = stylus_.read(answered_ ? sample.stylus : stylus_.last(), now_ns);
  return sample;
}

DeviceSample DeviceReader::read(std::int64_t now_ns) noexcept {
  const bool answered = answered_;
  const DeviceSample sample = look(now_ns);
  if (answered_ && !answered) exchange_.arrivals.fetch_add(1, std::memory_order_release);
  return sample;
}

}  // namespace hl
