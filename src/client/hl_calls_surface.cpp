// What surfaces feel like: materials, shade model, attribute stack.
#include <hl/hl.h>

#include "client/call.h"

using hl::client::call;
using hl::client::callOr;
using hl::client::Fault;
using hl::client::TextureUnits;
using hl::client::When;

namespace {

void material(const char* function, HLenum quantity, double value) {
  call(function, [&](HLcontext& context) {
    const auto number = hl::client::numberOf(quantity);
    if (!number)
      throw Fault(HL_INVALID_ENUM,
                  "the quantity must be HL_STIFFNESS .. HL_PRESLIDING, HL_ADHESION, HL_COMPLIANCE or HL_STRENGTH");
    hl::client::requireInRange(quantity, value);
    context.draw.attributes.now.surface.quantities[*number] = value;
  });
}

void setTexturing(const char* function, HLenum capability, bool enabled) {
  call(function, [&](HLcontext& context) {
    if (capability != HL_TEXTURE_2D) throw Fault(HL_INVALID_ENUM, "the capability must be HL_TEXTURE_2D");
    TextureUnits& units = context.draw.attributes.now.textures;
    units.enabled[units.active] = enabled;
    units.decided = true;
  });
}

}  // namespace

void hlMaterialf(HLenum quantity, HLfloat value) { material(__func__, quantity, value); }
void hlMateriald(HLenum quantity, HLdouble value) { material(__func__, quantity, value); }

void hlShadeModel(HLenum mode) {
  call(__func__, [&](HLcontext& context) {
    if (mode != HL_FLAT && mode != HL_SMOOTH) throw Fault(HL_INVALID_ENUM, "the mode must be HL_FLAT or HL_SMOOTH");
    context.draw.attributes.now.surface.shade = mode;
  });
}

void hlEnable(HLenum capability) { setTexturing(__func__, capability, true); }
void hlDisable(HLenum capability) { setTexturing(__func__, capability, false); }

HLboolean hlIsEnabled(HLenum capability) {
  return callOr<HLboolean>(HL_FALSE, __func__, When::kOutside, [&](HLcontext& context) {
    const TextureUnits& units = context.draw.attributes.now.textures;
    const bool enabled =
        capability == HL_TEXTURE_2D ? units.enabled[units.active] : context.arrays.named(capability).enabled;
    return enabled ? HL_TRUE : HL_FALSE;
  });
}

void hlPushAttrib(HLbitfield mask) {
  call(__func__, [&](HLcontext& context) { context.draw.attributes.push(mask); });
}

void hlPopAttrib(void) {
  call(__func__, [](HLcontext& context) {
    context.draw.attributes.pop();
    context.unbindMissing();
  });
}
