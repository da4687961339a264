#include "client/server_view.h"

#include <limits>
#include <utility>

#include "base/clock.h"

namespace hl::client {

void ServerView::take(proto::ClientState state) {
  state_ = std::move(state);
  state_taken_ns_ = monotonicNow_ns();
}

const proto::DeviceInfo& ServerView::device() const {
  if (device_ < static_cast<std::uint32_t>(welcome_.devices_size())) return welcome_.devices(static_cast<int>(device_));
  return proto::DeviceInfo::default_instance();
}

double ServerView::stateAge_s() const {
  if (!state_taken_ns_) return std::numeric_limits<double>::infinity();
  return static_cast<double>(monotonicNow_ns() - *state_taken_ns_) * 1e-9;
}

bool ServerView::isMaster() const { return state_taken_ns_ ? state_.master() : welcome_.master(); }

}  // namespace hl::client
