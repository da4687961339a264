// Objects and names.
#include <hl/hl.h>

#include <optional>
#include <utility>

#include "client/call.h"

using hl::client::call;
using hl::client::callOr;
using hl::client::Definition;
using hl::client::DrawState;
using hl::client::Fault;
using hl::client::requireList;
using hl::client::When;

namespace {

void requireCallable(const HLcontext& context, HLuint object) {
  if (context.definition) {
    const HLuint defined = context.definition->object;
    if (object == defined || context.objects.reaches(object, defined))
      throw Fault(HL_INVALID_OPERATION, "an object must not call itself, directly or not");
  }
  if (!context.objects.isDefined(object)) throw Fault(HL_INVALID_VALUE, "the object is not defined");
}

void endDefinition(HLcontext& context) {
  Definition& definition = *context.definition;
  const HLuint object = definition.object;
  context.objects.define(object, definition.items.uses());
  context.frame.deleted_objects.erase(object);
  context.frame.objects.insert_or_assign(object, std::move(definition.items));
  context.draw = std::move(definition.outside);
  context.definition.reset();
}

}  // namespace

void hlGenObjects(HLsizei n, HLuint* objects) {
  call(__func__, [&](HLcontext& context) {
    requireList(n, objects);
    for (HLsizei i = 0; i < n; ++i) objects[i] = context.objects.generate();
  });
}

void hlNewObject(HLuint object) {
  call(__func__, When::kNotInDefinition, [&](HLcontext& context) {
    if (object == 0) throw Fault(HL_INVALID_VALUE, "objects count from 1");
    context.definition.emplace(Definition{object, {}, std::exchange(context.draw, DrawState{})});
  });
}

void hlEndObject(void) {
  call(__func__, [](HLcontext& context) {
    if (!context.definition) throw Fault(HL_INVALID_OPERATION, "only after hlNewObject");
    endDefinition(context);
  });
}

void hlCallObject(HLuint object) {
  call(__func__, [&](HLcontext& context) {
    requireCallable(context, object);
    context.target().call(context.draw.modelview.top(), lookOf(context.draw.attributes.now), object);
  });
}

void hlDeleteObjects(HLsizei n, const HLuint* objects) {
  call(__func__, When::kNotInDefinition, [&](HLcontext& context) {
    requireList(n, objects);
    for (HLsizei i = 0; i < n; ++i) {
      if (!context.objects.remove(objects[i])) continue;
      context.frame.objects.erase(objects[i]);
      context.frame.deleted_objects.insert(objects[i]);
    }
  });
}

HLboolean hlIsObject(HLuint object) {
  return callOr<HLboolean>(HL_FALSE, __func__, When::kOutside,
                           [&](HLcontext& context) { return context.objects.isDefined(object) ? HL_TRUE : HL_FALSE; });
}

void hlLoadName(HLuint name) {
  call(__func__, [&](HLcontext& context) { context.draw.attributes.now.name = name; });
}

void hlPushName(HLuint name) {
  call(__func__, [&](HLcontext& context) { context.draw.attributes.pushName(name); });
}

void hlPopName(void) {
  call(__func__, [](HLcontext& context) { context.draw.attributes.popName(); });
}
