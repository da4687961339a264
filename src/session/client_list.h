// ClientList: the clients whose objects are in the world or on their way there.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "session/check_bodies.h"
#include "session/scene_parts.h"

namespace hl {

/// Looks into their entries: of ClientTable, under its mutex.
class ClientList {
 public:
  void add(std::shared_ptr<ClientScene> client) { clients_.push_back(std::move(client)); }
  /// Those that have gone and whose objects are shown no more. Who is with a builder stays.
  void erase(const std::vector<ScenePart>& gone);

  /// Who has waited longest for a builder; null: no frame waits.
  std::shared_ptr<ClientScene> withFrame() const;
  /// Who has an outdated hierarchy; null: nobody, or a builder is at one already, as the others are for frames.
  std::shared_ptr<ClientScene> withOutdated() const;

  WorldParts partsOfAll() const;
  /// But for the one that this client replaces.
  WorldParts partsOfAllBut(const ClientScene& client) const;

  /// What all have in the scene that is made next. When it throws, nothing has been taken.
  SceneParts take();
  /// What could not be shown: the next time, unless there is something newer by then.
  void giveBack(std::vector<ScenePart>& parts);

 private:
  std::optional<Vec3> newestGravity_m_s2() const;

  std::vector<std::shared_ptr<ClientScene>> clients_;
};

}  // namespace hl
