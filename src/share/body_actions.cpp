#include "share/body_actions.h"

#include <algorithm>

#include "base/clock.h"

namespace hl {

void BodyActions::add(const ReturnedItem& returned) {
  BodyCommand command;
  command.position_m = returned.motion.pose.origin;
  command.rotation = returned.motion.pose.rotation;
  command.velocity_m_s = returned.motion.velocity_m_s;
  command.spin_rad_s = returned.motion.spin_rad_s;
  add(returned.id, command, std::nullopt);
}

void BodyActions::add(const ItemPush& push) {
  BodyCommand command;
  command.impulse_N_s = push.impulse_N_s;
  command.duration_s = push.duration_s;
  add(push.id, command, push.point_O);
}

// `point_O`: where an impulse acts; it goes to the point of the body that is there now.
void BodyActions::add(ItemId id, BodyCommand command, const std::optional<Vec3>& point_O) {
  const std::optional<std::uint64_t> own = local_.bodyOf(id), taken_over = replicas_.bodyOf(id);
  if ((!own && !taken_over) || commands_.size() >= kMaxCommands) return;
  command.key = own ? *own : *taken_over;
  const std::shared_ptr<const Snapshot> scene = session_.snapshot();
  std::uint32_t number = 0;
  if (!scene->find(command.key, number)) return;
  if (point_O) command.point_m = scene->instances[number].shownAt(monotonicNow_ns()).toWorld(*point_O);
  commands_.push_back(command);
}

void BodyActions::give() {
  const auto waiting = std::find_if(commands_.begin(), commands_.end(),
                                    [this](const BodyCommand& command) { return !session_.actOnBody(command); });
  commands_.erase(commands_.begin(), waiting);
}

}  // namespace hl
