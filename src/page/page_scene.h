// PageScene: what pages are sent of the scene while it changes. A layout says which meshes are where; it is sent again
// only when something comes, goes or is scaled. What moves meanwhile is in each state, as a difference from the layout,
// so that a page that misses states, or layouts, is right again with the next ones.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "page/layout_bodies.h"
#include "page/layout_places.h"
#include "page/page_meshes.h"
#include "scene/snapshot.h"
#include "touch/proxy_loop.h"

namespace hl {

/// What one page has been sent.
struct PageMemory {
  std::set<std::uint32_t> meshes;
  std::uint32_t layout = 0;
  std::shared_ptr<const void> presence;  ///< while one lives, somebody looks
  std::string lacking{};                 ///< why it does not see everything
};

/// How large the proxy and the hand's space are in the scene.
struct PageScale {
  double radius_W = 0;  ///< m, of the proxy
  double world_per_device = 1;
  bool operator==(const PageScale&) const = default;
};

/// Used by one thread. Knows no sockets and no clock.
class PageScene {
 public:
  /// Objects that rest away from where the layout has them get a new layout after this time, and so do objects that
  /// jump, and bodies, joints, gravity, snaps and fields that change: no more often.
  static constexpr std::int64_t kSettle_ns = 1'000'000'000;

  /// What pages are shown is counted against `memory`.
  explicit PageScene(MemoryBudget memory = {}) : meshes_(std::move(memory)) {}

  /// For a page that has nothing yet.
  PageMemory open() const { return {{}, 0, presence_}; }
  /// Shows the newest snapshot as soon as its meshes are ready; never waits for them. Call it before each state. While
  /// nobody looks, nothing is kept.
  void follow(const std::shared_ptr<const Snapshot>& newest, const PageScale& scale, std::int64_t now_ns);
  /// The next message that the page lacks, which it then counts as having; empty when it has everything.
  PageMessage next(PageMemory& page) const;
  /// What has moved since the layout, what of it is touched, and the snap that holds the proxy.
  void describe(proto::State& state, std::span<const ObjectName> touched, const HoldingSnap& snap,
                std::int64_t now_ns) const;

 private:
  struct MeshPlacement {
    std::uint64_t key = 0;
    std::uint32_t mesh = 0, session = 0, object = 0, name = 0;
    std::shared_ptr<const Surfaces> surfaces{};
    std::shared_ptr<const Label> label{};
    bool operator==(const MeshPlacement& other) const;
  };
  struct Layout {
    std::uint32_t number = 0;
    std::string name;
    PageScale scale;
    std::vector<MeshPlacement> placements;  // of the instances of the snapshot, one by one
    std::vector<Pose> poses;
    std::set<std::uint32_t> meshes;
    std::int64_t made_ns = 0;
    LayoutBodies bodies{};
    LayoutPlaces places{};
    std::uint64_t compared_with =
        0;  // identity of the last snapshot whose bodies, snaps and fields were compared with these
    PageMessage message{};
  };

  void takeNewest(const std::shared_ptr<const Snapshot>& newest, std::int64_t now_ns);
  bool outdated(const PageScale& scale, std::int64_t now_ns);
  static void addPlacement(const MeshPlacement& place, const Instance& instance, proto::SceneLayout& layout);
  bool settledElsewhere(std::int64_t now_ns) const;
  bool hasOtherContents();
  std::optional<std::uint32_t> indexOf(std::uint64_t key) const;
  void layOut(const PageScale& scale, std::int64_t now_ns);

  std::shared_ptr<const void> presence_ = std::make_shared<char>();
  PageMeshes meshes_;
  std::shared_ptr<const Snapshot> shown_, waiting_;  // the second until its meshes are ready
  std::vector<MeshPlacement> shown_placements_, waiting_placements_;
  std::optional<Layout> layout_;  // of what is shown
  std::uint32_t last_layout_ = 0;
};

}  // namespace hl
