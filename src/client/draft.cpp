#include "client/draft.h"

#include <utility>

namespace hl::client {

namespace {

// What is deleted later goes, what is defined later overwrites, and a definition undoes a deletion before it.
template <typename Definition>
void mergeNumbered(std::map<HLuint, Definition>& defined, std::set<HLuint>& deleted,
                   std::map<HLuint, Definition>&& later_defined, const std::set<HLuint>& later_deleted) {
  for (const HLuint number : later_deleted) {
    defined.erase(number);
    deleted.insert(number);
  }
  for (auto& [number, definition] : later_defined) {
    deleted.erase(number);
    defined.insert_or_assign(number, std::move(definition));
  }
}

}  // namespace

bool Draft::isEmpty() const {
  return !world && objects.empty() && deleted_objects.empty() && textures.empty() && deleted_textures.empty();
}

void Draft::merge(Draft&& later) {
  if (later.world) world = std::move(later.world);
  mergeNumbered(objects, deleted_objects, std::move(later.objects), later.deleted_objects);
  mergeNumbered(textures, deleted_textures, std::move(later.textures), later.deleted_textures);
}

}  // namespace hl::client
