#include "client/context.h"

using hl::client::Draft;
using hl::client::ItemList;

namespace {

// A texture without an image is none, as in GL.
void dropImageless(ItemList& list, const hl::client::TextureTable& textures) {
  for (hl::client::Item& item : list.items())
    std::erase_if(item.look.textures, [&](const auto& use) { return !textures.hasImage(use.texture); });
}

}  // namespace

ItemList& HLcontext::target() {
  if (definition) return definition->items;
  if (!frame.world) frame.world.emplace();
  return *frame.world;
}

Draft HLcontext::closeFrame() {
  Draft closed = std::exchange(frame, {});
  for (auto& [object, items] : closed.objects) dropImageless(items, textures);
  if (closed.world) {
    dropImageless(*closed.world, textures);
    world_calls = closed.world->calls();
  }
  auto removals = objects.takeRemovals(world_calls);
  for (const HLuint object : removals.empty) closed.objects[object];
  closed.deleted_objects.insert(removals.deleted.begin(), removals.deleted.end());
  auto changes = textures.takeChanges();
  closed.textures = std::move(changes.images);
  closed.deleted_textures = std::move(changes.removed);
  return closed;
}
