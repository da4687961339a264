// ObjectTable: which objects are defined and what they use, so that a circle of calls is seen before anything is sent,
// and a texture is not taken away under an object; and how many vertices and surfaces of volumes they have.
// What is in them is not kept.
#pragma once

#include <hl/hl_types.h>

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "client/free_numbers.h"
#include "client/item_list.h"
#include "client/table_changes.h"

namespace hl::client {

/// What is known of an object that is defined.
struct KnownObject {
  Uses uses;
  std::vector<ItemVertices> vertices;
  std::vector<std::uint32_t> volumes;
};

class ObjectTable {
 public:
  /// A number > 0 that is not in use.
  HLuint generate() { return numbers_.next(objects_, "objects"); }
  bool isDefined(HLuint object) const { return objects_.contains(object); }
  /// Defines or redefines `object`.
  void define(HLuint object, const ItemList& items);
  /// Of a defined one.
  const std::vector<ItemVertices>& vertices(HLuint object) const { return objects_.at(object).vertices; }
  /// Numbers of its items that are surfaces of volumes, in order.
  const std::vector<std::uint32_t>& volumes(HLuint object) const { return objects_.at(object).volumes; }
  /// Returns whether it was defined.
  bool remove(HLuint object);
  /// What was defined and removed since the last call of either: as it was before, to be undone later; or undone now.
  TableChanges<KnownObject> takeChanges() { return std::exchange(changes_, {}); }
  void undoChanges() { changes_.undo(objects_); }
  /// Undoes changes that were taken, but for objects that have changed since.
  void takeBack(TableChanges<KnownObject> taken);
  /// Whether `from` is `to` or calls it, directly or not.
  bool reaches(HLuint from, HLuint to) const;
  /// Those of all objects.
  std::set<HLuint> usedTextures() const;

 private:
  std::map<HLuint, KnownObject> objects_;
  TableChanges<KnownObject> changes_;
  FreeNumbers numbers_;
};

}  // namespace hl::client
