#include "session/decode_frame.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "base/error.h"
#include "io/decode_clouds.h"
#include "io/decode_heights.h"
#include "io/decode_implicit.h"
#include "io/decode_scene.h"
#include "io/decode_volumes.h"
#include "scene/append_part.h"
#include "session/decode_joints.h"
#include "session/frame_volumes.h"
#include "session/upload_parts.h"

namespace hl {

namespace {

[[noreturn]] void refuse(const std::string&, const std::string& message) { throw Error(message); }

constexpr std::size_t kMaxName_bytes = 256;  // of a texture: surfaces are copied, and their names with them
constexpr std::size_t kMaxWarnings = 20;     // a frame may skip something in each of a million items
constexpr std::size_t kListed_bytes = 128;   // of a name, number or compliance in the edit's lists
constexpr std::size_t kMoved_bytes = 512;    // of one item whose vertices move

void checkName(const std::string& name, const std::string& where) {
  if (name.size() > kMaxName_bytes)
    throw Error(where + ": the name of a texture has at most " + std::to_string(kMaxName_bytes) + " bytes");
}

// Messages name things as the client does: by the numbers of its objects and the names of its textures.
std::string pathOfItems(std::uint32_t object) {
  return object == 0 ? "world.items" : "object " + std::to_string(object) + ", items";
}

// What decoding it and building its shape takes.
std::uint64_t bytesToBuild(const proto::Primitives& in) {
  if (in.has_heights()) return bytesToMakeHeights(in.heights());
  if (in.has_volume()) return bytesToMakeVolume(in.volume());
  if (in.has_cloud()) return bytesToMakeCloud(in.cloud());
  if (in.has_implicit()) return bytesToMakeImplicit(in.implicit());
  return bytesToMake(countsOf(in));
}

std::uint64_t texelsOf(const proto::TextureImage& in) {
  if (in.source_case() == proto::TextureImage::kTexels) return in.texels().values().size();
  const std::uint64_t size = std::max(64U, in.procedural().size());
  return size * size;
}

void requireAlone(const proto::Primitives& in, const std::string& where) {
  if (in.vertices_size() + in.triangles_size() + in.polygons_size() + in.segments_size() + in.points_size() +
          in.patches_size() >
      0)
    throw Error(where + ": heights, volumes, clouds and implicit surfaces come without vertices and elements");
  if (in.has_heights() + in.has_volume() + in.has_cloud() + in.has_implicit() > 1)
    throw Error(where + ": it has heights, a volume, a cloud or an implicit surface, not several of them");
}

class FrameDecoder {
 public:
  FrameDecoder(const proto::Frame& frame, Uploads& uploads, const SceneLimits& limits, const MemoryBudget& memory,
               const std::function<void(double)>& progress, const ItemsBefore& before)
      : frame_(frame),
        uploads_(uploads),
        limits_(limits),
        memory_(memory),
        joined_(memory),
        progress_(progress),
        before_(before),
        decoder_(refuse),
        size_(limits),
        volumes_(memory, size_) {
    result_.memory = MemoryShare(memory);
  }

  DecodedFrame run();

 private:
  void addTextures();
  void addObjects();
  void makeBody(const proto::ObjectDefinition& object, SceneItems& items);
  void addPlaces(const proto::ObjectDefinition& object, SceneItems& items) const;
  const SceneItems* itemsBefore(std::uint32_t object) const { return before_ ? before_(object) : nullptr; }
  bool isThere(std::uint32_t object) const;
  void warn(const std::string& where, const std::string& what);
  void warnOfCalls();
  void addMoved();
  void addIsos();
  void addCompliances();
  SceneItems& itemsToChange(std::uint32_t object, const std::string& where);
  SceneItem& itemToMove(const proto::VertexUpdate& in, const std::string& where);
  void move(const proto::VertexUpdate& in, Model& model, const std::string& where);
  std::shared_ptr<const Shape> noted(std::shared_ptr<const Shape> shape, const std::string& where);
  std::shared_ptr<SceneItems> itemsOf(const google::protobuf::RepeatedPtrField<proto::Item>& items,
                                      std::uint32_t object);
  SceneItem itemOf(const proto::Item& in, const Shape* before, const std::string& where);
  static std::shared_ptr<const Placement> placementOf(const proto::Item& in, const std::string& where);
  std::shared_ptr<const SurfaceChange> surfaceOf(const proto::Item& in, const std::string& where) const;
  std::shared_ptr<const Shape> shapeOf(const proto::Primitives& in, const proto::Item& item, const Shape* before,
                                       const std::string& where);
  std::shared_ptr<const Shape> heightsOf(const proto::Primitives& in, const proto::Item& item, const Shape* before,
                                         const std::string& where);
  std::shared_ptr<const Shape> cloudOf(const proto::Primitives& in, const std::string& where);
  std::shared_ptr<const Shape> implicitSurfaceOf(const proto::Primitives& in, const std::string& where);
  template <typename Decode>
  std::shared_ptr<const Shape> ownSurface(std::uint64_t bytes, const std::string& where, const Decode& decode,
                                          const Vec2& repeat = Vec2::Ones());
  const proto::Primitives& upload(std::uint64_t id, const std::string& where);
  void countItems();

  const proto::Frame& frame_;
  Uploads& uploads_;
  const SceneLimits& limits_;
  const MemoryBudget& memory_;
  MemoryShare joined_;  // of uploads that came in parts
  const std::function<void(double)>& progress_;
  const ItemsBefore& before_;
  const SceneDecoder decoder_;
  DecodedFrame result_;
  ModelSizes size_;  // each item makes a shape of its own, even if all refer to one upload
  FrameVolumes volumes_;
  std::set<std::uint32_t> deleted_;  // numbers of objects
  std::size_t more_warnings_ = 0;
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
    if (!result_.edit.objects.emplace(object.id(), std::move(items)).second)
      throw Error("object " + std::to_string(object.id()) + " is there twice");
  }
  result_.edit.deleted_objects.assign(frame_.deleted_objects().begin(), frame_.deleted_objects().end());
  deleted_.insert(frame_.deleted_objects().begin(), frame_.deleted_objects().end());
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
  const SceneItems* const before = itemsBefore(object);
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
      item.shape = noted(shapeOf(in.primitives(), in, before, where + ".primitives"), named);
      return item;
    case proto::Item::kUpload:
      item.shape = noted(shapeOf(upload(in.upload(), where), in, before, where + ".upload"), named);
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

const proto::Primitives& FrameDecoder::upload(std::uint64_t id, const std::string& where) {
  const auto found = uploads_.find(id);
  if (found == uploads_.end()) throw Error(where + ": there is no upload " + std::to_string(id));
  joinParts(found->second, joined_);
  return found->second.front();
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

std::shared_ptr<const Shape> FrameDecoder::shapeOf(const proto::Primitives& in, const proto::Item& item,
                                                   const Shape* before, const std::string& where) {
  if (in.has_heights() || in.has_volume() || in.has_cloud() || in.has_implicit()) requireAlone(in, where);
  if (in.has_volume()) return volumes_.surface(in.volume(), item, where + ".volume");
  if (item.has_iso() || item.has_below()) throw Error(where + ": iso and below are of volumes, and this is none");
  if (in.has_heights()) return heightsOf(in, item, before, where);
  if (in.has_cloud()) return cloudOf(in, where);
  if (in.has_implicit()) return implicitSurfaceOf(in, where);
  return makeCounted(memory_, bytesToBuild(in), [&] {
    Model model = decoder_.model(in, where);
    size_.add(model, where + ": ");
    repeatTexcoords(model, repeatOf(item.material()));
    return before != nullptr ? makeShape(std::move(model), *before) : makeShape(std::move(model));
  });
}

// Counted by its samples or points, as a mesh is by its elements. `bytes`: to make it.
template <typename Decode>
std::shared_ptr<const Shape> FrameDecoder::ownSurface(std::uint64_t bytes, const std::string& where,
                                                      const Decode& decode, const Vec2& repeat) {
  size_.add(bytes, where + ": ");
  MemoryShare memory(memory_);
  memory.take(bytes);
  try {
    auto shape = makeShape(decode(), {}, {}, repeat);
    memory.set(shape->bytes() + shape->shared().bytes);
    return withShare(std::move(shape), std::move(memory));
  } catch (const Error& error) {
    throw Error(where + ": " + error.what());
  }
}

std::shared_ptr<const Shape> FrameDecoder::heightsOf(const proto::Primitives& in, const proto::Item& item,
                                                     const Shape* before, const std::string& where) {
  const auto decode = [&] { return decodeHeights(in.heights(), before != nullptr ? before->source.get() : nullptr); };
  return ownSurface(bytesToMakeHeights(in.heights()), where + ".heights", decode, repeatOf(item.material()));
}

std::shared_ptr<const Shape> FrameDecoder::cloudOf(const proto::Primitives& in, const std::string& where) {
  return ownSurface(bytesToMakeCloud(in.cloud()), where + ".cloud", [&] { return decodeCloud(in.cloud()); });
}

std::shared_ptr<const Shape> FrameDecoder::implicitSurfaceOf(const proto::Primitives& in, const std::string& where) {
  return ownSurface(bytesToMakeImplicit(in.implicit()), where + ".implicit",
                    [&] { return decodeImplicit(in.implicit()); });
}

std::shared_ptr<const Shape> FrameDecoder::noted(std::shared_ptr<const Shape> shape, const std::string& where) {
  if (shape->before != 0) ++result_.refits;
  for (const std::string& warning : shape->warnings) warn(where, warning);
  return shape;
}

void FrameDecoder::warn(const std::string& where, const std::string& what) {
  const bool room = result_.warnings.size() < kMaxWarnings;
  room ? result_.warnings.push_back(where + ": " + what) : void(++more_warnings_);
}

// When the frame is shown.
bool FrameDecoder::isThere(std::uint32_t object) const {
  return result_.edit.objects.contains(object) || (!deleted_.contains(object) && itemsBefore(object) != nullptr);
}

// Of what is not there yet: it may come with a later frame, or be a mistake.
void FrameDecoder::warnOfCalls() {
  const auto look = [this](std::uint32_t object, const SceneItems& items) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (items[i].shape || isThere(items[i].call)) continue;
      warn(pathOf(pathOfItems(object), static_cast<int>(i)),
           "there is no object " + std::to_string(items[i].call) + " to call: nothing can be touched there");
    }
  };
  for (const auto& [object, items] : result_.edit.objects) look(object, *items);
  if (result_.edit.world) look(0, *result_.edit.world);
}

// In the edit; what is not changed of an object stays as it was.
SceneItems& FrameDecoder::itemsToChange(std::uint32_t object, const std::string& where) {
  if (object == 0 || !isThere(object)) throw Error(where + ": there is no object " + std::to_string(object));
  auto found = result_.edit.objects.find(object);
  if (found == result_.edit.objects.end())
    found = result_.edit.objects.emplace(object, copyOf(*itemsBefore(object), memory_)).first;
  return *found->second;
}

SceneItem& FrameDecoder::itemToMove(const proto::VertexUpdate& in, const std::string& where) {
  SceneItems& items = itemsToChange(in.object(), where);
  if (in.item() >= items.size() || !items[in.item()].shape || items[in.item()].shape->source)
    throw Error(where + ": item " + std::to_string(in.item()) + " of object " + std::to_string(in.object()) +
                " has no vertices");
  if (items.body && !items.body->fixed)
    throw Error(where + ": object " + std::to_string(in.object()) + " is a rigid body: define it anew, or as fixed");
  return items[in.item()];
}

void FrameDecoder::move(const proto::VertexUpdate& in, Model& model, const std::string& where) {
  if (in.what_case() == proto::VertexUpdate::WHAT_NOT_SET) throw Error(where + " needs primitives or an upload");
  const proto::Primitives& primitives = in.has_upload() ? upload(in.upload(), where) : in.primitives();
  MemoryShare memory(memory_);
  memory.take(bytesToBuild(primitives));
  const Model part = decoder_.model(primitives, where);
  const auto finite = [](const Vec3& v) { return v.allFinite(); };
  if (part.elements() != 0 || !part.texcoords.empty() || !part.appearance.empty())
    throw Error(where + " must hold vertices and normals alone");
  if (!std::all_of(part.positions.begin(), part.positions.end(), finite) ||
      !std::all_of(part.normals.begin(), part.normals.end(), finite))
    throw Error(where + " must hold finite numbers");
  const std::size_t count = model.positions.size();
  if (in.first() > count || part.positions.size() > count - in.first())
    throw Error(where + ": the item has " + std::to_string(count) + " vertices, no more");
  if (!part.normals.empty() && model.normals.empty()) throw Error(where + ": the item's vertices have no normals");
  std::copy(part.positions.begin(), part.positions.end(), model.positions.begin() + in.first());
  if (!part.normals.empty()) std::copy(part.normals.begin(), part.normals.end(), model.normals.begin() + in.first());
}

// However many updates an item has, its shape is made once.
void FrameDecoder::addMoved() {
  struct Moved {
    SceneItem* item;
    Model model;
    MemoryShare memory;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Moved> all;
  for (int i = 0; i < frame_.moved_size(); ++i) {
    const proto::VertexUpdate& in = frame_.moved(i);
    const std::string where = pathOf("moved", i);
    auto place = all.find({in.object(), in.item()});
    if (place == all.end()) {
      SceneItem& item = itemToMove(in, where);
      MemoryShare memory(memory_);
      memory.take(kMoved_bytes + bytesToMake(item.shape->model));
      Moved moved{&item, item.shape->model, std::move(memory)};
      place = all.emplace(std::pair(in.object(), in.item()), std::move(moved)).first;
    }
    move(in, place->second.model, where);
  }
  for (auto& [key, moved] : all) {
    const auto before = moved.item->shape;
    const auto shape = makeShape(std::move(moved.model), *before);
    moved.memory.set(shape->bytes());
    const std::string where = pathOf(pathOfItems(key.first), static_cast<int>(key.second));
    moved.item->shape = noted(withShare(shape, std::move(moved.memory)), where);
  }
}

void FrameDecoder::addIsos() {
  for (int i = 0; i < frame_.isos_size(); ++i) {
    const proto::IsoUpdate& in = frame_.isos(i);
    const std::string where = pathOf("isos", i);
    SceneItems& items = itemsToChange(in.object(), where);
    const bool there = in.item() < items.size();
    const Shape* const before = there ? items[in.item()].shape.get() : nullptr;
    auto shape = volumes_.surfaceAt(before, in, where);
    items[in.item()].shape = std::move(shape);
  }
}

// Of objects that are there when the frame is shown.
void FrameDecoder::addCompliances() {
  for (int i = 0; i < frame_.compliances_size(); ++i) {
    const proto::Compliance& in = frame_.compliances(i);
    const std::string where = pathOf("compliances", i);
    if (in.object() == 0 || !isThere(in.object()))
      throw Error(where + ": there is no object " + std::to_string(in.object()));
    const auto force = [&](double value, const char* axis) {
      return decoder_.checked(value, -kMaxComputedForce_N, kMaxComputedForce_N, where + ".computedForN." + axis);
    };
    const double normal_m_N = decoder_.checked(in.normal_m_n(), 0, kMaxCompliance_m_N, where + ".normalMN");
    const double tangential_m_N =
        in.has_tangential_m_n() ? decoder_.checked(in.tangential_m_n(), 0, kMaxCompliance_m_N, where + ".tangentialMN")
                                : normal_m_N;
    const proto::Vec3& f = in.computed_for_n();
    const Compliance compliance{normal_m_N, tangential_m_N, {force(f.x(), "x"), force(f.y(), "y"), force(f.z(), "z")}};
    if (!result_.edit.compliances.emplace(in.object(), compliance).second)
      throw Error(where + ": object " + std::to_string(in.object()) + " is there twice");
  }
}

DecodedFrame FrameDecoder::run() {
  countItems();
  const int listed = frame_.deleted_textures_size() + frame_.deleted_objects_size() + frame_.compliances_size();
  result_.memory.take(kListed_bytes * static_cast<std::uint64_t>(listed));
  if (frame_.has_interval_s() && !(frame_.interval_s() >= 0)) throw Error("interval_s must not be below 0");
  constexpr double kMaxGravity_m_s2 = 1000;
  if (frame_.has_gravity_m_s2())
    result_.gravity_m_s2 = decoder_.checked(frame_.gravity_m_s2(), kMaxGravity_m_s2, "gravity_m_s2");
  addTextures();
  addObjects();
  warnOfCalls();
  addMoved();
  addIsos();
  addCompliances();
  if (more_warnings_ > 0)
    result_.warnings.push_back("and " + std::to_string(more_warnings_) + " more lines about what was skipped");
  return std::move(result_);
}

}  // namespace

DecodedFrame decodeFrame(const proto::Frame& frame, Uploads& uploads, const SceneLimits& limits,
                         const MemoryBudget& memory, const std::function<void(double)>& progress,
                         const ItemsBefore& before) {
  return FrameDecoder(frame, uploads, limits, memory, progress, before).run();
}

}  // namespace hl
