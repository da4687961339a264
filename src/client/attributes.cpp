#include "client/attributes.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "client/fault.h"

namespace hl::client {

namespace {

// As hl_types.h has them.
constexpr std::array<std::string_view, kNumbers> kQuantityNames{
#define HL_QUANTITY(quantity, field, NAME, ...) "HL_" #NAME,
#include "base/quantities.def"
#undef HL_QUANTITY
};

}  // namespace

std::optional<std::size_t> numberOf(HLenum quantity) {
  const auto found = std::find(kQuantityEnums.begin(), kQuantityEnums.end(), quantity);
  if (found == kQuantityEnums.end()) return {};
  return static_cast<std::size_t>(found - kQuantityEnums.begin());
}

bool hasTextures(const Attributes& attributes) {
  const TextureUnits& units = attributes.textures;
  for (std::size_t unit = 0; unit < kTextureUnits; ++unit)
    if (units.enabled[unit] && units.uses[unit].texture != 0) return true;
  return false;
}

Look lookOf(const Attributes& attributes) {
  const TextureUnits& units = attributes.textures;
  Look look{attributes.surface, {}, units.decided, attributes.name};
  if (!hasTextures(attributes)) return look;
  for (std::size_t unit = kTextureUnits; unit-- > 0;) {
    const TextureUse& use = units.uses[unit];
    const bool taken = std::any_of(look.textures.begin(), look.textures.end(),
                                   [&](const TextureUse& other) { return other.quantity == use.quantity; });
    if (units.enabled[unit] && use.texture != 0 && !taken) look.textures.push_back(use);
  }
  return look;
}

void requireInRange(HLenum quantity, double value) {
  const auto number = numberOf(quantity);
  if (!number) return requireWithin("HL_HEIGHT", value, -kMaxHeight_m, kMaxHeight_m);
  requireWithin(kQuantityNames[*number], value, 0, kQuantityInfo[*number].most);
}

void AttributeStack::push(HLbitfield mask) {
  if (saved_.size() >= kAttribDepth) throw Fault(HL_STACK_OVERFLOW, "the attribute stack is full");
  saved_.push_back({mask, now});
}

void AttributeStack::pop() {
  if (saved_.empty()) throw Fault(HL_STACK_UNDERFLOW, "no attributes have been pushed");
  const Saved saved = saved_.back();
  saved_.pop_back();
  const Attributes& then = saved.attributes;
  if (saved.mask & HL_CURRENT_BIT) {
    now.vertex = then.vertex;
    now.name = then.name;
  }
  if (saved.mask & HL_SURFACE_BIT) now.surface = then.surface;
  if (saved.mask & HL_TRANSFORM_BIT) now.matrix_mode = then.matrix_mode;
  if (saved.mask & HL_TEXTURE_BIT) now.textures = then.textures;
  if (saved.mask & HL_ENABLE_BIT) {
    now.textures.enabled = then.textures.enabled;
    now.textures.decided = then.textures.decided;
  }
}

void AttributeStack::pushName(HLuint name) {
  if (names_.size() >= kNameDepth) throw Fault(HL_STACK_OVERFLOW, "the name stack is full");
  names_.push_back(now.name);
  now.name = name;
}

void AttributeStack::popName() {
  if (names_.empty()) throw Fault(HL_STACK_UNDERFLOW, "no name has been pushed");
  now.name = names_.back();
  names_.pop_back();
}

}  // namespace hl::client
