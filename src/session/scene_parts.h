// What the clients have in the scene that is made next.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scene/placed_shape.h"

namespace hl {

struct ClientScene;

/// Of one client.
struct ScenePart {
  std::shared_ptr<ClientScene> client;
  bool gone = false;
  PlacedShapes placed;  ///< null: as it is shown
  std::int64_t move_ns = 0;
  std::size_t frames = 0;  ///< of the client's ready ones
  // By NextScene:
  std::size_t jumps = 0;               ///< as in Followed
  std::vector<const Instance*> shown;  ///< of the client, in the next scene
};

/// Of all.
struct SceneParts {
  std::vector<ScenePart> of_clients;
  std::optional<Vec3> gravity_m_s2;  ///< that a client has set last; absent: as the base has it
};

}  // namespace hl
