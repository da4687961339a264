// FrameChanges: what a frame changes in the tables of a context, as it was before: the tables hold what the frame says
// as soon as it is flushed, and go back if the server refuses it.
#pragma once

#include <hl/hl_types.h>

#include <optional>
#include <set>
#include <utility>

#include "client/object_table.h"
#include "client/table_changes.h"
#include "client/texture_table.h"

namespace hl::client {

struct FrameChanges {
  TableChanges<KnownObject> objects;
  TableChanges<Texture> textures;
  std::set<HLuint> removed_textures;               ///< that the server is to forget
  std::optional<std::set<HLuint>> world_textures;  ///< that the world used before; absent: it stays

  /// Both become one: these, and then `later`.
  void merge(FrameChanges&& later) {
    objects.merge(std::move(later.objects));
    textures.merge(std::move(later.textures));
    removed_textures.merge(later.removed_textures);
    if (!world_textures) world_textures = std::move(later.world_textures);
  }
  /// See TableChanges.
  void inheritFrom(FrameChanges& earlier) {
    objects.inheritFrom(earlier.objects);
    textures.inheritFrom(earlier.textures);
    if (world_textures && earlier.world_textures) world_textures = std::exchange(earlier.world_textures, std::nullopt);
  }
};

}  // namespace hl::client
