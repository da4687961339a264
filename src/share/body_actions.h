// BodyActions: what other servers do to the bodies of this one, on its way to the loop that steps them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "share/local_scene.h"
#include "share/replicas_here.h"
#include "share/shared_world.h"
#include "touch/body_command.h"
#include "touch/touch_session.h"

namespace hl {

/// One thread. All outlive it.
class BodyActions {
 public:
  BodyActions(TouchSession& session, const LocalScene& local, const ReplicasHere& replicas)
      : session_(session), local_(local), replicas_(replicas) {}

  /// Of bodies that are not there any more nothing comes.
  void add(const ReturnedItem& returned);
  void add(const ItemPush& push);
  /// As many as the loops have room for; the others wait for the next call.
  void give();

 private:
  static constexpr std::size_t kMaxCommands = 1000;
  void add(ItemId id, BodyCommand command, const std::optional<Vec3>& point_O);

  TouchSession& session_;
  const LocalScene& local_;
  const ReplicasHere& replicas_;
  std::vector<BodyCommand> commands_;
};

}  // namespace hl
