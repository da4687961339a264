// Textures: images, units, and what they modulate.
#include <hl/hl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "client/call.h"

using hl::client::call;
using hl::client::callOr;
using hl::client::Fault;
using hl::client::kMaxTextureSide;
using hl::client::kTextureUnits;
using hl::client::requireList;
using hl::client::Texture;
using hl::client::TextureUse;
using hl::client::When;

namespace {

// Room for the rest of a frame in a message with one texture.
constexpr std::uint64_t kFrameReserve = 4096;

TextureUse& activeUse(HLcontext& context) {
  hl::client::TextureUnits& units = context.draw.attributes.now.textures;
  return units.uses[units.active];
}

void requireTarget(HLenum target) {
  if (target != HL_TEXTURE_2D) throw Fault(HL_INVALID_ENUM, "the target must be HL_TEXTURE_2D");
}

Texture& changeBound(HLcontext& context) {
  const HLuint bound = activeUse(context).texture;
  if (!context.textures.contains(bound)) throw Fault(HL_INVALID_OPERATION, "no texture is bound");
  return context.textures.change(bound);
}

void requireImageSize(const HLcontext& context, HLsizei width, HLsizei height) {
  if (width < 1 || height < 1 || width > kMaxTextureSide || height > kMaxTextureSide)
    throw Fault(HL_INVALID_VALUE, "an image has 1 .. " + std::to_string(kMaxTextureSide) + " texels along a side");
  const std::uint64_t bytes = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const std::uint64_t most = context.conversation.view().limits().message_bytes();
  if (most != 0 && bytes + kFrameReserve > most)
    throw Fault(HL_OUT_OF_MEMORY, "the image has " + std::to_string(bytes) +
                                      " texels, more than a message that the server takes (" + std::to_string(most) +
                                      " bytes)");
}

void requireWithin(const Texture& texture, HLint x, HLint y, HLsizei width, HLsizei height) {
  if (x < 0 || y < 0 || width < 0 || height < 0 || width > texture.width - x || height > texture.height - y)
    throw Fault(HL_INVALID_VALUE, "the part must be within the image of " + std::to_string(texture.width) + " x " +
                                      std::to_string(texture.height) + " texels");
}

void setParameter(Texture& texture, HLenum parameter, HLenum value) {
  if (parameter == HL_TEXTURE_WRAP && (value == HL_REPEAT || value == HL_CLAMP)) {
    texture.wrap = value;
  } else if (parameter == HL_TEXTURE_FILTER && (value == HL_LINEAR || value == HL_NEAREST)) {
    texture.filter = value;
  } else {
    throw Fault(HL_INVALID_ENUM, "HL_TEXTURE_WRAP is HL_REPEAT or HL_CLAMP, HL_TEXTURE_FILTER HL_LINEAR or HL_NEAREST");
  }
}

void requireEnvTarget(HLenum target) {
  if (target != HL_TEXTURE_ENV) throw Fault(HL_INVALID_ENUM, "the target must be HL_TEXTURE_ENV");
}

void setEnv(HLcontext& context, HLenum target, HLenum parameter, double value) {
  requireEnvTarget(target);
  if (parameter != HL_TEXTURE_LOW && parameter != HL_TEXTURE_HIGH)
    throw Fault(HL_INVALID_ENUM, "the parameter must be HL_TEXTURE_LOW or HL_TEXTURE_HIGH");
  TextureUse& use = activeUse(context);
  hl::client::requireInRange(use.quantity, value);
  (parameter == HL_TEXTURE_LOW ? use.low : use.high) = value;
}

// The range of the quantity before would mean nothing for the new one.
void setQuantity(HLcontext& context, HLenum target, HLenum quantity) {
  requireEnvTarget(target);
  if ((quantity < HL_STIFFNESS || quantity > HL_VISCOSITY) && quantity != HL_HEIGHT)
    throw Fault(HL_INVALID_ENUM, "the quantity must be HL_STIFFNESS .. HL_VISCOSITY or HL_HEIGHT");
  TextureUse& use = activeUse(context);
  use = {use.texture, quantity, 0, quantity == HL_HEIGHT ? 0.0 : 1.0};
}

}  // namespace

void hlGenTextures(HLsizei n, HLuint* textures) {
  call(__func__, [&](HLcontext& context) {
    requireList(n, textures);
    for (HLsizei i = 0; i < n; ++i) textures[i] = context.textures.generate();
  });
}

void hlDeleteTextures(HLsizei n, const HLuint* textures) {
  call(__func__, When::kNotInDefinition, [&](HLcontext& context) {
    requireList(n, textures);
    for (HLsizei i = 0; i < n; ++i) context.textures.remove(textures[i]);
    context.unbindMissing();
  });
}

HLboolean hlIsTexture(HLuint texture) {
  return callOr<HLboolean>(HL_FALSE, __func__, When::kOutside,
                           [&](HLcontext& context) { return context.textures.contains(texture) ? HL_TRUE : HL_FALSE; });
}

void hlActiveTexture(HLenum unit) {
  call(__func__, [&](HLcontext& context) {
    if (unit < HL_TEXTURE0 || unit - HL_TEXTURE0 >= kTextureUnits)
      throw Fault(HL_INVALID_ENUM, "the unit must be HL_TEXTURE0 + 0 .. " + std::to_string(kTextureUnits - 1));
    context.draw.attributes.now.textures.active = unit - HL_TEXTURE0;
  });
}

void hlBindTexture(HLenum target, HLuint texture) {
  call(__func__, [&](HLcontext& context) {
    requireTarget(target);
    context.textures.bind(texture);
    activeUse(context).texture = texture;
  });
}

void hlTexImage2D(HLenum target, HLint level, HLint internal_format, HLsizei width, HLsizei height, HLint border,
                  HLenum format, HLenum type, const void* texels) {
  call(__func__, [&](HLcontext& context) {
    requireTarget(target);
    if (level != 0 || border != 0) throw Fault(HL_INVALID_VALUE, "level and border must be 0");
    if (internal_format != HL_LUMINANCE) throw Fault(HL_INVALID_VALUE, "the internal format must be HL_LUMINANCE");
    if (format != HL_LUMINANCE) throw Fault(HL_INVALID_ENUM, "the format must be HL_LUMINANCE");
    requireImageSize(context, width, height);
    std::string image = hl::client::readTexels(width, height, type, texels);
    Texture& texture = changeBound(context);
    texture.width = width;
    texture.height = height;
    texture.texels = std::move(image);
  });
}

void hlTexSubImage2D(HLenum target, HLint level, HLint x, HLint y, HLsizei width, HLsizei height, HLenum format,
                     HLenum type, const void* texels) {
  call(__func__, [&](HLcontext& context) {
    requireTarget(target);
    if (level != 0) throw Fault(HL_INVALID_VALUE, "the level must be 0");
    if (format != HL_LUMINANCE) throw Fault(HL_INVALID_ENUM, "the format must be HL_LUMINANCE");
    const HLuint bound = activeUse(context).texture;
    if (!context.textures.hasImage(bound)) throw Fault(HL_INVALID_OPERATION, "no texture with an image is bound");
    requireWithin(context.textures.image(bound), x, y, width, height);
    const std::string part = hl::client::readTexels(width, height, type, texels);
    if (texels == nullptr || part.empty()) return;
    Texture& texture = changeBound(context);
    for (HLsizei row = 0; row < height; ++row)
      std::copy_n(part.begin() + std::ptrdiff_t{row} * width, width,
                  texture.texels.begin() + (std::ptrdiff_t{y} + row) * texture.width + x);
  });
}

void hlTexParameteri(HLenum target, HLenum parameter, HLint value) {
  call(__func__, [&](HLcontext& context) {
    requireTarget(target);
    setParameter(changeBound(context), parameter, static_cast<HLenum>(value));
  });
}

void hlTexEnvi(HLenum target, HLenum parameter, HLint value) {
  call(__func__, [&](HLcontext& context) {
    if (parameter == HL_TEXTURE_QUANTITY) {
      setQuantity(context, target, static_cast<HLenum>(value));
    } else {
      setEnv(context, target, parameter, value);
    }
  });
}

void hlTexEnvf(HLenum target, HLenum parameter, HLfloat value) {
  call(__func__, [&](HLcontext& context) { setEnv(context, target, parameter, double{value}); });
}

void hlTexEnvd(HLenum target, HLenum parameter, HLdouble value) {
  call(__func__, [&](HLcontext& context) { setEnv(context, target, parameter, value); });
}
