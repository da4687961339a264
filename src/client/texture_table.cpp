#include "client/texture_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "client/fault.h"

namespace hl::client {

namespace {

char quantized(HLfloat value) {
  requireFinite(value);
  return static_cast<char>(static_cast<unsigned char>(std::lround(255 * std::clamp(value, 0.0F, 1.0F))));
}

}  // namespace

void TextureTable::undoChanges() {
  changes_.undo(textures_);
  changed_.clear();
  removed_ = removed_before_;
}

void TextureTable::takeBack(TableChanges<Texture> taken, const std::set<HLuint>& removed) {
  changes_.inheritFrom(taken);
  taken.undo(textures_);
  for (const HLuint texture : removed) {
    if (hasImage(texture)) continue;
    removed_.insert(texture);
    removed_before_.insert(texture);
  }
}

void TextureTable::bind(HLuint texture) {
  if (texture == 0) return;
  if (!contains(texture)) changes_.remember(textures_, texture);
  textures_.try_emplace(texture);
  numbers_.choose(texture);
}

void TextureTable::remove(HLuint texture) {
  if (!contains(texture)) return;
  changes_.remember(textures_, texture);
  textures_.erase(texture);
  changed_.erase(texture);
  removed_.insert(texture);
}

bool TextureTable::hasImage(HLuint texture) const {
  const auto found = textures_.find(texture);
  return found != textures_.end() && found->second.hasImage();
}

Texture& TextureTable::change(HLuint texture) {
  changes_.remember(textures_, texture);
  changed_.insert(texture);
  return textures_.at(texture);
}

TextureTable::Changes TextureTable::takeChanges(const std::set<HLuint>& used) {
  Changes changes;
  for (const HLuint texture : changed_) {
    if (!hasImage(texture)) continue;
    changes.images[texture] = textures_.at(texture);
    removed_.erase(texture);
  }
  changed_.clear();
  std::erase_if(removed_, [&](HLuint texture) {
    if (used.contains(texture)) return false;
    changes.removed.insert(texture);
    return true;
  });
  removed_before_ = removed_;
  changes.before = std::exchange(changes_, {});
  return changes;
}

std::string readTexels(HLsizei width, HLsizei height, HLenum type, const void* texels) {
  if (type != HL_UNSIGNED_BYTE && type != HL_FLOAT)
    throw Fault(HL_INVALID_ENUM, "the type must be HL_UNSIGNED_BYTE or HL_FLOAT");
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (texels == nullptr) return std::string(count, '\0');
  if (type == HL_UNSIGNED_BYTE) return {static_cast<const char*>(texels), count};
  std::string bytes(count, '\0');
  for (std::size_t i = 0; i < count; ++i) {
    HLfloat value;
    std::memcpy(&value, static_cast<const char*>(texels) + i * sizeof value, sizeof value);
    bytes[i] = quantized(value);
  }
  return bytes;
}

}  // namespace hl::client
