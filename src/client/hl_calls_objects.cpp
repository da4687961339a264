// Objects and names.
#include <hl/hl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "client/call.h"

using hl::client::call;
using hl::client::callOr;
using hl::client::Definition;
using hl::client::DrawState;
using hl::client::Fault;
using hl::client::ItemVertices;
using hl::client::Numbers;
using hl::client::requireFinite;
using hl::client::requireList;
using hl::client::requireWithin;
using hl::client::VertexUpdate;
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
  context.objects.define(object, definition.items);
  context.frame.deleted_objects.erase(object);
  context.frame.forgetUpdates(object);
  context.frame.objects.insert_or_assign(object, std::move(definition.items));
  context.leaveDefinition();
}

Numbers copied(const HLdouble* begin, std::size_t count) {
  Numbers numbers;
  numbers.makeRoom(3 * count);
  for (std::size_t i = 0; i < 3 * count; i += 3) {
    const std::array<double, 3> read{begin[i], begin[i + 1], begin[i + 2]};
    requireFinite(read[0], read[1], read[2]);
    numbers.appendInRoom(read);
  }
  return numbers;
}

// One for each item that has some of the vertices [first, first + count).
std::vector<VertexUpdate> updatesOf(const HLcontext& context, HLuint object, std::size_t first, std::size_t count,
                                    const HLdouble* vertices, const HLdouble* normals) {
  std::vector<VertexUpdate> updates;
  std::size_t begin = 0;  // of the item's vertices, among the object's
  for (const ItemVertices& item : context.objects.vertices(object)) {
    const std::size_t from = std::max(first, begin), to = std::min(first + count, begin + item.count);
    if (from < to) {
      if (normals != nullptr && !item.normals)
        throw Fault(HL_INVALID_OPERATION, "the object's vertices were drawn without normals");
      VertexUpdate& update = updates.emplace_back();
      update.object = object;
      update.item = item.item;
      update.first = static_cast<std::uint32_t>(from - begin);
      update.vertices.positions = copied(vertices + 3 * (from - first), to - from);
      if (normals != nullptr) update.vertices.normals = copied(normals + 3 * (from - first), to - from);
    }
    begin += item.count;
  }
  if (first + count > begin)
    throw Fault(HL_INVALID_VALUE, "the object has " + std::to_string(begin) + " vertices, no more");
  return updates;
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

void hlCancelObject(void) {
  call(__func__, [](HLcontext& context) {
    if (!context.definition) throw Fault(HL_INVALID_OPERATION, "only after hlNewObject");
    context.leaveDefinition();
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
      context.frame.forgetUpdates(objects[i]);
      context.frame.forgetCompliance(objects[i]);
      context.frame.deleted_objects.insert(objects[i]);
    }
  });
}

void hlUpdateVertices(HLuint object, HLint first, HLsizei count, const HLdouble* vertices, const HLdouble* normals) {
  call(__func__, When::kNotInDefinition, [&](HLcontext& context) {
    requireList(count, vertices);
    if (first < 0) throw Fault(HL_INVALID_VALUE, "the first vertex must not be negative");
    if (!context.objects.isDefined(object)) throw Fault(HL_INVALID_VALUE, "the object is not defined");
    auto updates =
        updatesOf(context, object, static_cast<std::size_t>(first), static_cast<std::size_t>(count), vertices, normals);
    for (VertexUpdate& update : updates) context.frame.move(std::move(update));
  });
}

void hlVolumeIso(HLuint object, HLint surface, HLdouble iso) {
  call(__func__, When::kNotInDefinition, [&](HLcontext& context) {
    hl::client::requireFinite(iso);
    if (!context.objects.isDefined(object)) throw Fault(HL_INVALID_VALUE, "the object is not defined");
    const std::vector<std::uint32_t>& items = context.objects.volumes(object);
    if (surface < 0 || static_cast<std::size_t>(surface) >= items.size())
      throw Fault(HL_INVALID_VALUE, "the object has " + std::to_string(items.size()) + " surfaces of volumes, no more");
    context.frame.isos[{object, items[static_cast<std::size_t>(surface)]}] = iso;
  });
}

void hlCompliance(HLuint object, HLdouble normal, HLdouble tangential, const HLdouble* force) {
  call(__func__, When::kNotInDefinition, [&](HLcontext& context) {
    hl::client::ObjectCompliance compliance{normal, tangential, context.conversation.contactReports().forceOf(object)};
    if (force != nullptr) std::copy_n(force, 3, compliance.computed_for_N.begin());
    const auto [x, y, z] = compliance.computed_for_N;
    constexpr double kMost = hl::client::kMaxSentCompliance;
    for (const double value : {normal, tangential}) requireWithin("each compliance", value, 0, kMost);
    for (const double value : {x, y, z}) requireWithin("each coordinate of the force", value, -kMost, kMost);
    if (!context.objects.isDefined(object)) throw Fault(HL_INVALID_VALUE, "the object is not defined");
    context.frame.compliances[object] = compliance;
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
