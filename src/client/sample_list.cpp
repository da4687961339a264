#include "client/sample_list.h"

#include <algorithm>

namespace hl::client {

namespace {

HLsample sampleOf(const proto::DeviceSample& in) {
  const proto::Rotation& turned = in.stylus().rotation();
  const proto::Vec3& spin = in.stylus().spin_rad_s();
  return {in.time_s(),
          {in.finger().x(), in.finger().y(), in.finger().z()},
          {in.force_n().x(), in.force_n().y(), in.force_n().z()},
          in.buttons(),
          {turned.x(), turned.y(), turned.z(), in.stylus().has_rotation() ? turned.w() : 1},
          {spin.x(), spin.y(), spin.z()},
          in.stylus().gripper_rad(),
          in.stylus().gripper_n()};
}

}  // namespace

void SampleList::keep(std::size_t most) {
  most_ = most;
  dropOldest();
}

void SampleList::add(const proto::ClientState& state) {
  if (most_ == 0) return;  // of a state that was on its way
  for (const proto::DeviceSample& sample : state.samples()) samples_.push_back(sampleOf(sample));
  dropOldest();
}

std::size_t SampleList::take(std::size_t most, HLsample* samples) {
  const std::size_t count = std::min(most, samples_.size());
  const auto end = samples_.begin() + static_cast<std::ptrdiff_t>(count);
  std::copy(samples_.begin(), end, samples);
  samples_.erase(samples_.begin(), end);
  return count;
}

void SampleList::dropOldest() {
  if (samples_.size() > most_) samples_.erase(samples_.begin(), samples_.end() - static_cast<std::ptrdiff_t>(most_));
}

}  // namespace hl::client
