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

HLcontext::HLcontext(hl::client::Conversation with) : conversation(std::move(with)) {
  conversation.onTakeBack([this](hl::client::FrameChanges&& refused) { takeBack(std::move(refused)); });
}

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
    closed.changes.world_textures = std::exchange(world_textures, closed.world->uses().textures);
  }
  auto changes = textures.takeChanges(textures.hasRemoved() ? usedTextures() : std::set<HLuint>{});
  closed.textures = std::move(changes.images);
  closed.deleted_textures = std::move(changes.removed);
  closed.changes.textures = std::move(changes.before);
  closed.changes.removed_textures = closed.deleted_textures;
  closed.changes.objects = objects.takeChanges();
  return closed;
}

void HLcontext::takeBack(hl::client::FrameChanges&& refused) {
  objects.takeBack(std::move(refused.objects));
  textures.takeBack(std::move(refused.textures), refused.removed_textures);
  if (refused.world_textures) world_textures = std::move(*refused.world_textures);
  unbindMissing();
}

void HLcontext::unbindMissing() {
  const auto unbind = [this](hl::client::DrawState& state) {
    for (hl::client::TextureUse& use : state.attributes.now.textures.uses)
      if (!textures.contains(use.texture)) use.texture = 0;
  };
  unbind(draw);
  if (definition) unbind(definition->outside);
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
