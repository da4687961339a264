#include "scene/scene_items.h"

#include <utility>

#include "scene/scene_limits.h"

namespace hl {

std::size_t bytesOfItems(std::size_t count) { return kObject_bytes + count * sizeof(SceneItem); }

std::size_t bytesApart(const SceneItem& item) {
  std::size_t bytes = item.placement ? kPointer_bytes + sizeof(Placement) : 0;
  if (!item.surface) return bytes;
  bytes += kPointer_bytes + sizeof(SurfaceChange);
  for (const auto& use : item.surface->textures) {
    if (use) bytes += use->texture.capacity();
  }
  return bytes;
}

std::shared_ptr<SceneItems> copyOf(const SceneItems& items, const MemoryBudget& budget) {
  MemoryShare memory(budget);
  memory.take(bytesOfItems(items.size()));
  for (const SceneItem& item : items) memory.take(bytesApart(item));
  for (const CalledJoint& joint : items.joints) memory.take(bytesOf(joint));
  return withShare(std::make_shared<SceneItems>(items), std::move(memory));
}

}  // namespace hl
