// Draft: a frame before it becomes messages. A draft that has to wait takes in those that are flushed after it.
#pragma once

#include <hl/hl_types.h>

#include <map>
#include <optional>
#include <set>

#include "client/item_list.h"
#include "client/texture_table.h"

namespace hl::client {

struct Draft {
  std::optional<ItemList> world;       ///< absent: the calls stay as they are
  std::map<HLuint, ItemList> objects;  ///< new or overwritten
  std::set<HLuint> deleted_objects;    ///< in none of `objects`
  std::map<HLuint, Texture> textures;  ///< new or overwritten; all with images
  std::set<HLuint> deleted_textures;   ///< in none of `textures`

  bool isEmpty() const;
  /// As if both frames were shown at the same moment.
  void merge(Draft&& later);
};

}  // namespace hl::client
