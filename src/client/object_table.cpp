#include "client/object_table.h"

#include <vector>

namespace hl::client {

bool ObjectTable::remove(HLuint object) {
  if (!isDefined(object)) return false;
  changes_.remember(objects_, object);
  return objects_.erase(object) != 0;
}

void ObjectTable::define(HLuint object, const ItemList& items) {
  changes_.remember(objects_, object);
  objects_[object] = {items.uses(), items.vertices(), items.volumes()};
  numbers_.choose(object);
}

void ObjectTable::takeBack(TableChanges<KnownObject> taken) {
  changes_.inheritFrom(taken);
  taken.undo(objects_);
}

bool ObjectTable::reaches(HLuint from, HLuint to) const {
  std::set<HLuint> seen{from};
  std::vector<HLuint> open{from};
  while (!open.empty()) {
    const HLuint object = open.back();
    open.pop_back();
    if (object == to) return true;
    const auto found = objects_.find(object);
    if (found == objects_.end()) continue;
    for (const HLuint called : found->second.uses.objects)
      if (seen.insert(called).second) open.push_back(called);
  }
  return false;
}

std::set<HLuint> ObjectTable::usedTextures() const {
  std::set<HLuint> used;
  for (const auto& [object, known] : objects_) used.insert(known.uses.textures.begin(), known.uses.textures.end());
  return used;
}

}  // namespace hl::client
