// LayoutPlaces: the snaps and force fields of a layout, so that a page can draw them and save them.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scene/snapshot.h"
#include "touch/touch_events.h"

namespace hl {

/// What a layout describes of the snaps and fields of a snapshot: those that count.
struct LayoutPlaces {
  std::vector<std::shared_ptr<const SnapList>> snap_lists;  ///< one for each instance; null: it has none
  std::vector<std::shared_ptr<const FieldList>> field_lists;
  std::vector<PlacedSnap> snaps;  ///< in the order of the layout
  std::vector<PlacedField> fields;

  static LayoutPlaces of(const Snapshot& snapshot);
  /// Whether pages would be sent the same.
  bool operator==(const LayoutPlaces& other) const;
  /// The place in the layout of a snap of an instance; absent: it is not sent.
  std::optional<std::uint32_t> indexOf(const PlacedSnap& snap) const;
};

void addPlaces(const LayoutPlaces& contents, proto::SceneLayout& layout);

}  // namespace hl
