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
  for (auto& [object, items] : closed.objects) {
    dropImageless(items, textures);
    objects.define(object, items);
  }
  if (closed.world) {
    dropImageless(*closed.world, textures);
    world_textures = closed.world->uses().textures;
  }
  auto changes = textures.takeChanges(textures.hasRemoved() ? usedTextures() : std::set<HLuint>{});
  closed.textures = std::move(changes.images);
  closed.deleted_textures = std::move(changes.removed);
  objects.keepChanges();
  return closed;
}

void HLcontext::unbindMissing() {
  for (hl::client::TextureUse& use : draw.attributes.now.textures.uses)
    if (!textures.contains(use.texture)) use.texture = 0;
}

void HLcontext::leaveDefinition() {
  draw = std::move(definition->outside);
  definition.reset();
}

void HLcontext::cancelFrame() {
  recorder.cancel();
  if (definition) leaveDefinition();
  frame = {};
  objects.undoChanges();
  textures.undoChanges();
  unbindMissing();
}

std::set<HLuint> HLcontext::usedTextures() const {
  std::set<HLuint> used = objects.usedTextures();
  used.insert(world_textures.begin(), world_textures.end());
  return used;
}
