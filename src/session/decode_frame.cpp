#include "session/decode_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "io/decode_scene.h"
#include "scene/append_part.h"
#include "scene/idle_settings.h"
#include "session/decode_joints.h"
#include "session/frame_changes.h"
#include "session/frame_report.h"

namespace hl {

namespace {

[[noreturn]] void refuse(const std::string&, const std::string& message) { throw Error(message); }

constexpr std::size_t kMaxName_bytes = 256;  // of a texture: surfaces are copied, and their names with them
constexpr std::size_t kListed_bytes = 128;   // of a name, number or compliance in the edit's lists

void checkName(const std::string& name, const std::string& where) {
  if (name.size() > kMaxName_bytes)
    throw Error(where + ": the name of a texture has at most " + std::to_string(kMaxName_bytes) + " bytes");
}

std::uint64_t texelsOf(const proto::TextureImage& in) {
  if (in.source_case() == proto::TextureImage::kTexels) return in.texels().values().size();
  const std::uint64_t size = std::max(64U, in.procedural().size());
  return size * size;
}

class FrameDecoder {
 public:
  FrameDecoder(const proto::Frame& frame, Uploads& uploads, const SceneLimits& limits, const MemoryBudget& memory,
               const std::function<void(double)>& progress, const ItemsBefore& before)
      : frame_(frame),
        limits_(limits),
        memory_(memory),
        progress_(progress),
        decoder_(refuse),
        shapes_(uploads, decoder_, limits, memory),
        objects_(result_.edit, before, memory) {
    result_.memory = MemoryShare(memory);
  }

  DecodedFrame run();

 private:
  void addTextures();
  void addObjects();
  void makeBody(const proto::ObjectDefinition& object, SceneItems& items);
  void addPlaces(const proto::ObjectDefinition& object, SceneItems& items) const;
  void warnOfCalls();
  std::shared_ptr<SceneItems> itemsOf(const google::protobuf::RepeatedPtrField<proto::Item>& items,
                                      std::uint32_t object);
  SceneItem itemOf(const proto::Item& in, const Shape* before, const std::string& where);
  static std::shared_ptr<const Placement> placementOf(const proto::Item& in, const std::string& where);
  std::shared_ptr<const SurfaceChange> surfaceOf(const proto::Item& in, const std::string& where) const;
  void warnOfIdle(const SceneItem& item, const std::string& named);
  void countItems();

  const proto::Frame& frame_;
  const SceneLimits& limits_;
  const MemoryBudget& memory_;
  const std::function<void(double)>& progress_;
  const SceneDecoder decoder_;
  DecodedFrame result_;
  FrameReport report_;
  FrameShapes shapes_;
  FrameObjects objects_;
  double items_ = 1, built_ = 0;
};

void FrameDecoder::countItems() {
  items_ = frame_.world().items_size();
  for (const proto::ObjectDefinition& object : frame_.objects()) items_ += object.items_size();
}

void FrameDecoder::addTextures() {
  std::size_t room = limits_.texture_bytes / sizeof(float);  // a few bytes can ask for millions of texels
  for (int i = 0; i < frame_.textures_size(); ++i) {
    const std::string& given = frame_.textures(i).name();
    checkName(given, pathOf("textures", i));
    const std::string where = given.empty() ? pathOf("textures", i) : "texture '" + given + "'";
    MemoryShare memory(memory_);
    memory.take(kObject_bytes + sizeof(float) * std::min<std::uint64_t>(room, texelsOf(frame_.textures(i))));
    auto texture = std::make_shared<const Texture>(decoder_.texture(frame_.textures(i), room, where));
    room -= texture->texels.size();
    const std::string name = texture->name;
    if (!result_.edit.textures.emplace(name, withShare(std::move(texture), std::move(memory))).second)
      throw Error(where + " is there twice");
  }
  result_.edit.deleted_textures.assign(frame_.deleted_textures().begin(), frame_.deleted_textures().end());
}

void FrameDecoder::addObjects() {
  for (int i = 0; i < frame_.objects_size(); ++i) {
    const proto::ObjectDefinition& object = frame_.objects(i);
    if (object.id() == 0) throw Error(pathOf("objects", i) + ".id must not be 0");
    std::shared_ptr<SceneItems> items = itemsOf(object.items(), object.id());
    if (object.has_body()) makeBody(object, *items);
    addPlaces(object, *items);
    objects_.define(object.id(), std::move(items));
  }
  for (const std::uint32_t object : frame_.deleted_objects()) objects_.remove(object);
  if (frame_.has_world()) result_.edit.world = itemsOf(frame_.world().items(), 0);
}

// The frame of a body is that of the call, so that its item's matrix becomes part of its shape.
void FrameDecoder::makeBody(const proto::ObjectDefinition& object, SceneItems& items) {
  const std::string where = "object " + std::to_string(object.id());
  if (items.size() != 1 || !items[0].shape)
    throw Error(where + ".body: a body has one item, with primitives or an upload, and no calls; this one has " +
                std::to_string(items.size()) + (items.size() == 1 ? " item, a call" : " items"));
  SceneItem& item = items[0];
  if (item.shape->source) throw Error(where + ".body: only what is made of triangles can be a body");
  if (item.shape->primitives.empty()) throw Error(where + ".body: a body must have an extent, and this one has none");
  items.body = std::make_shared<const BodySpec>(decoder_.body(object.body(), where + ".body"));
  if (!item.placement) return;
  const std::shared_ptr<const Shape> shape = item.shape;
  item.shape = makeCounted(memory_, bytesToMake(shape->model), [&] {
    Model model = shape->model;
    placeModel(model, *item.placement);
    return makeShape(std::move(model), *shape);
  });
  item.placement = nullptr;
}

// Snaps and fields.
void FrameDecoder::addPlaces(const proto::ObjectDefinition& object, SceneItems& items) const {
  const std::string where = "object " + std::to_string(object.id());
  const auto counted = [&](auto list) {
    MemoryShare memory(memory_);
    memory.take(bytesOf(list));
    return withShare(std::make_shared<const decltype(list)>(std::move(list)), std::move(memory));
  };
  if (object.snaps_size() > 0) items.snaps = counted(decoder_.snaps(object.snaps(), where + ".snaps"));
  if (object.fields_size() > 0) items.fields = counted(decoder_.fields(object.fields(), where + ".fields"));
}

std::shared_ptr<SceneItems> FrameDecoder::itemsOf(const google::protobuf::RepeatedPtrField<proto::Item>& items,
                                                  std::uint32_t object) {
  const std::string where = pathOfItems(object);
  const SceneItems* const before = objects_.before(object);
  const auto count = static_cast<std::size_t>(items.size());
  MemoryShare memory(memory_);
  memory.take(bytesOfItems(count));
  auto result = std::make_shared<SceneItems>();
  result->reserve(count);
  for (int i = 0; i < items.size(); ++i) {
    const bool known = before != nullptr && result->size() < before->size();
    const Shape* const shape = known ? before->at(result->size()).shape.get() : nullptr;
    result->push_back(itemOf(items[i], shape, pathOf(where, i)));
    memory.take(bytesApart(result->back()));
    progress_(++built_ / items_);
  }
  if (object == 0) result->joints = decodeJoints(frame_.world(), decoder_, limits_, memory);
  return withShare(std::move(result), std::move(memory));
}

SceneItem FrameDecoder::itemOf(const proto::Item& in, const Shape* before, const std::string& where) {
  SceneItem item;
  item.placement = placementOf(in, where + ".matrix");
  item.surface = surfaceOf(in, where + ".material");
  if (in.has_name()) item.name = in.name();
  const std::string named = in.name() == 0 ? where : where + ", named " + std::to_string(in.name());
  switch (in.what_case()) {
    case proto::Item::kPrimitives:
      item.shape = report_.noted(shapes_.of(in.primitives(), in, before, where + ".primitives"), named);
      warnOfIdle(item, named);
      return item;
    case proto::Item::kUpload:
      item.shape = report_.noted(shapes_.of(shapes_.upload(in.upload(), where), in, before, where + ".upload"), named);
      warnOfIdle(item, named);
      return item;
    case proto::Item::kCall:
      if (in.call() == 0) throw Error(where + ".call must not be 0");
      item.call = in.call();
      return item;
    case proto::Item::WHAT_NOT_SET:
      break;
  }
  throw Error(where + ": an item needs primitives, an upload or a call");
}

std::shared_ptr<const SurfaceChange> FrameDecoder::surfaceOf(const proto::Item& in, const std::string& where) const {
  if (!in.has_material() && !in.untextured()) return nullptr;
  for (int i = 0; i < in.material().textures_size(); ++i)
    checkName(in.material().textures(i).texture(), pathOf(where + ".textures", i));
  SurfaceChange surface = decoder_.surface(in.material(), where);
  surface.untextured = in.untextured();
  return std::make_shared<const SurfaceChange>(std::move(surface));
}

// Of its own surface; the rest is its callers'. A texture may be left on over lines and points, as in GL.
void FrameDecoder::warnOfIdle(const SceneItem& item, const std::string& named) {
  if (!item.surface) return;
  const SurfaceChange& surface = *item.surface;
  Material material = surface.material();
  bool textured = false;
  for (std::size_t i = 0; i < kQuantities; ++i) {
    if (!surface.textures[i]) continue;
    textured = true;
    material.textures[i] = {0, surface.textures[i]->low, surface.textures[i]->high};
  }
  const TextureRoom room = textured ? roomOn(*item.shape) : TextureRoom{};
  if (!room.triangles) material.textures = {};
  const auto texture_of = [&](Quantity quantity) -> UsedTexture {
    const std::string& name = surface.textures[static_cast<std::size_t>(quantity)]->texture;
    const auto found = result_.edit.textures.find(name);
    return {name, found == result_.edit.textures.end() ? nullptr : found->second.get()};
  };
  for (const IdleSetting& idle : idleSettings(material, room, texture_of)) report_.warn(named, idle.words);
}

std::shared_ptr<const Placement> FrameDecoder::placementOf(const proto::Item& in, const std::string& where) {
  if (in.matrix_size() == 0) return nullptr;
  Placement placement;
  if (in.matrix_size() != 16) throw Error(where + " must hold 16 numbers, column by column");
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(in.matrix(i))) throw Error(where + " must hold finite numbers");
  }
  if (in.matrix(3) != 0 || in.matrix(7) != 0 || in.matrix(11) != 0 || in.matrix(15) != 1)
    throw Error(where + ": its last row must be 0 0 0 1");
  for (int column = 0; column < 3; ++column)
    placement.linear.col(column) = Vec3(in.matrix(4 * column), in.matrix(4 * column + 1), in.matrix(4 * column + 2));
  placement.offset = Vec3(in.matrix(12), in.matrix(13), in.matrix(14));
  return std::make_shared<const Placement>(placement);
}

// Of what is not there yet: it may come with a later frame, or be a mistake.
void FrameDecoder::warnOfCalls() {
  const auto look = [this](std::uint32_t object, const SceneItems& items) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (items[i].shape || objects_.isThere(items[i].call)) continue;
      report_.warn(pathOf(pathOfItems(object), static_cast<int>(i)),
                   "there is no object " + std::to_string(items[i].call) + " to call: nothing can be touched there");
    }
  };
  for (const auto& [object, items] : result_.edit.objects) look(object, *items);
  if (result_.edit.world) look(0, *result_.edit.world);
}

DecodedFrame FrameDecoder::run() {
  countItems();
  const int listed = frame_.deleted_textures_size() + frame_.deleted_objects_size() + frame_.compliances_size();
  result_.memory.take(kListed_bytes * static_cast<std::uint64_t>(listed));
  if (frame_.has_interval_s() && !(frame_.interval_s() >= 0)) throw Error("interval_s must not be below 0");
  if (frame_.has_gravity_m_s2())
    result_.gravity_m_s2 = decoder_.checked(frame_.gravity_m_s2(), body_limits::kMaxGravity_m_s2, "gravity_m_s2");
  addTextures();
  addObjects();
  warnOfCalls();
  FrameChanges(frame_, decoder_, memory_, shapes_, objects_, report_).addTo(result_.edit);
  result_.refits = report_.refits();
  result_.warnings = report_.warnings();
  return std::move(result_);
}

}  // namespace

DecodedFrame decodeFrame(const proto::Frame& frame, Uploads& uploads, const SceneLimits& limits,
                         const MemoryBudget& memory, const std::function<void(double)>& progress,
                         const ItemsBefore& before) {
  return FrameDecoder(frame, uploads, limits, memory, progress, before).run();
}

}  // namespace hl
