// ReplicasHere: the objects of other servers in the scene of this one, so that its hands touch them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/placed_shape.h"
#include "session/placed_client.h"
#include "share/background_work.h"
#include "share/item_content.h"
#include "share/local_scene.h"
#include "share/shared_world.h"

namespace hl {

/// One thread.
class ReplicasHere {
 public:
  using ReportLine = std::function<void(const std::string&)>;
  using FitHands = std::function<void(const Box& bounds)>;
  /// How long a replica takes to its next place: to the next look; to one where it was not before: as long as the force
  /// fades.
  static constexpr std::int64_t kMove_ns = 8'333'333, kJump_ns = kAbruptBlend_ns;

  /// `bodies`: this server moves rigid bodies, so those that it has taken over go on. All outlive it.
  /// `fit`: fits hands to the bounds of the first that are placed; empty: they stay as they are.
  ReplicasHere(PlacedClient& client, bool bodies, BackgroundWork& work, const Contents& contents, FitHands fit,
               ReportLine report);

  /// As they are now; `jumped`: one has gone elsewhere at once. Those of which a part is not here yet are placed later;
  /// where hands are to be fitted, all of them wait for that, kPatience_ns at most.
  void look(const std::vector<Replica>& replicas, bool jumped, std::int64_t now_ns);
  static constexpr std::int64_t kPatience_ns = 10'000'000'000;
  /// None of them is there any more.
  void clear() { look({}, false, 0); }
  /// What this server has taken over, as it is in `scene`.
  void addOwn(const Snapshot& scene, LocalItems& items) const;
  /// A replica by its number in the scene, PlacedShape::object.
  std::optional<ItemId> idOf(std::uint32_t number) const;
  /// The key in the scene of one that this server moves as a body.
  std::optional<std::uint64_t> bodyOf(ItemId id) const;
  /// Where it is, as shown last.
  Pose poseOf(ItemId id) const;

 private:
  struct Row {
    std::uint32_t number = 0;
    std::uint64_t look = 0;
    std::shared_ptr<const proto::ShareContent> asked{};  // that is being read, or was last
    std::optional<Instance> instance{};                  // null: nothing of it has been read yet
    Replica replica{};
    std::shared_ptr<const BodySpec> body{};  // null: it is not moved by this server
  };
  void readNew(Row& row);
  void setBody(Row& row, const Replica& replica) const;
  PlacedShape placedOf(const Row& row) const;
  bool waitsForOthers(const PlacedList& placed, std::int64_t now_ns);
  void place(const PlacedShapes& placed, std::int64_t move_ns);
  bool isAsPlaced(const PlacedList& placed) const;

  PlacedClient& client_;
  const bool bodies_;
  BackgroundWork& work_;
  const Contents& contents_;
  FitHands fit_;  // empty: done, or not wanted
  const ReportLine report_;
  const std::shared_ptr<ItemReader> reader_;  // of the background work
  std::map<ItemId, Row> rows_;
  std::map<std::uint32_t, ItemId> ids_;  // by number
  PlacedShapes placed_ = std::make_shared<PlacedList>();
  std::uint32_t last_number_ = 0;
  std::uint64_t looks_ = 0;
  std::int64_t first_ns_ = 0;  // when the first one was here
  std::string refused_;        // why the last list was, reported once
};

}  // namespace hl
