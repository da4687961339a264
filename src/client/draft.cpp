#include "client/draft.h"

#include <algorithm>
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
  return !world && objects.empty() && deleted_objects.empty() && moved.empty() && isos.empty() && compliances.empty() &&
         textures.empty() && deleted_textures.empty() && !gravity_m_s2;
}

bool Draft::hasBodies() const {
  return std::any_of(objects.begin(), objects.end(),
                     [](const auto& object) { return object.second.body().has_value(); });
}

void Draft::move(VertexUpdate update) {
  const auto covered = [&](const VertexUpdate& before) {
    return before.object == update.object && before.item == update.item && before.first >= update.first &&
           before.first + before.vertices.size() <= update.first + update.vertices.size() &&
           (before.vertices.normals.empty() || !update.vertices.normals.empty());
  };
  std::erase_if(moved, covered);
  moved.push_back(std::move(update));
}

void Draft::forgetUpdates(HLuint object) {
  std::erase_if(isos, [object](const auto& iso) { return iso.first.first == object; });
  std::erase_if(moved, [object](const VertexUpdate& update) { return update.object == object; });
}

void Draft::merge(Draft&& later) {
  for (const HLuint object : later.deleted_objects) {
    forgetUpdates(object);
    forgetCompliance(object);
  }
  for (const auto& [object, items] : later.objects) forgetUpdates(object);
  for (VertexUpdate& update : later.moved) move(std::move(update));
  for (const auto& [item, iso] : later.isos) isos[item] = iso;
  for (const auto& [object, compliance] : later.compliances) compliances[object] = compliance;
  if (later.gravity_m_s2) gravity_m_s2 = later.gravity_m_s2;
  if (later.world) world = std::move(later.world);
  mergeNumbered(objects, deleted_objects, std::move(later.objects), later.deleted_objects);
  mergeNumbered(textures, deleted_textures, std::move(later.textures), later.deleted_textures);
  changes.merge(std::move(later.changes));
}

}  // namespace hl::client
