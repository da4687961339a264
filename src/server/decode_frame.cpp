#include "server/decode_frame.h"

#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "io/decode_scene.h"
#include "io/scene_builder.h"

namespace hl {

namespace {

[[noreturn]] void refuse(const std::string&, const std::string& message) { throw Error(message); }

class FrameDecoder {
 public:
  FrameDecoder(const proto::Frame& frame, const Uploads& uploads, const SceneLimits& limits,
               const std::function<void(double)>& progress, const ShapeBefore& before)
      : frame_(frame),
        uploads_(uploads),
        limits_(limits),
        progress_(progress),
        before_(before),
        decoder_(refuse),
        size_(limits) {}

  DecodedFrame run();

 private:
  void addTextures();
  void addObjects();
  SceneItems itemsOf(const google::protobuf::RepeatedPtrField<proto::Item>& items, std::uint32_t object,
                     const std::string& where);
  SceneItem itemOf(const proto::Item& in, const Shape* before, const std::string& where);
  Placement placementOf(const proto::Item& in, const std::string& where) const;
  std::shared_ptr<const Shape> shapeOf(const proto::Primitives& in, const proto::Material& material,
                                       const Shape* before, const std::string& where);
  const proto::Primitives& upload(std::uint64_t id, const std::string& where) const;
  void countItems();

  const proto::Frame& frame_;
  const Uploads& uploads_;
  const SceneLimits& limits_;
  const std::function<void(double)>& progress_;
  const ShapeBefore& before_;
  const SceneDecoder decoder_;
  DecodedFrame result_;
  ModelSizes size_;  // each item makes a shape of its own, even if all refer to one upload
  double items_ = 1, built_ = 0;
};

void FrameDecoder::countItems() {
  items_ = frame_.world().items_size();
  for (const proto::ObjectDefinition& object : frame_.objects()) items_ += object.items_size();
}

void FrameDecoder::addTextures() {
  std::size_t room = limits_.texture_bytes / sizeof(float);  // a few bytes can ask for millions of texels
  for (int i = 0; i < frame_.textures_size(); ++i) {
    const std::string where = pathOf("textures", i);
    auto texture = std::make_shared<Texture>(decoder_.texture(frame_.textures(i), room, where));
    room -= texture->texels.size();
    const std::string name = texture->name;
    if (!result_.edit.textures.emplace(name, std::move(texture)).second)
      throw Error(where + ": there are two textures of the name '" + name + "'");
  }
  result_.edit.deleted_textures.assign(frame_.deleted_textures().begin(), frame_.deleted_textures().end());
}

void FrameDecoder::addObjects() {
  for (int i = 0; i < frame_.objects_size(); ++i) {
    const std::string where = pathOf("objects", i);
    const proto::ObjectDefinition& object = frame_.objects(i);
    if (object.id() == 0) throw Error(where + ".id must not be 0");
    if (!result_.edit.objects.emplace(object.id(), itemsOf(object.items(), object.id(), where)).second)
      throw Error(where + ": there are two objects of the id " + std::to_string(object.id()));
  }
  result_.edit.deleted_objects.assign(frame_.deleted_objects().begin(), frame_.deleted_objects().end());
  if (frame_.has_world()) result_.edit.world = itemsOf(frame_.world().items(), 0, "world");
}

SceneItems FrameDecoder::itemsOf(const google::protobuf::RepeatedPtrField<proto::Item>& items, std::uint32_t object,
                                 const std::string& where) {
  SceneItems result;
  result.reserve(static_cast<std::size_t>(items.size()));
  for (int i = 0; i < items.size(); ++i) {
    const auto before = before_ ? before_(object, result.size()) : nullptr;
    result.push_back(itemOf(items[i], before.get(), pathOf(where + ".items", i)));
    progress_(++built_ / items_);
  }
  return result;
}

SceneItem FrameDecoder::itemOf(const proto::Item& in, const Shape* before, const std::string& where) {
  SceneItem item;
  item.placement = placementOf(in, where + ".matrix");
  item.surface = decoder_.surface(in.material(), where + ".material");
  item.surface.untextured = in.untextured();
  if (in.has_name()) item.name = in.name();
  switch (in.what_case()) {
    case proto::Item::kPrimitives:
      item.shape = shapeOf(in.primitives(), in.material(), before, where + ".primitives");
      return item;
    case proto::Item::kUpload:
      item.shape = shapeOf(upload(in.upload(), where), in.material(), before, where + ".upload");
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

const proto::Primitives& FrameDecoder::upload(std::uint64_t id, const std::string& where) const {
  const auto found = uploads_.find(id);
  if (found == uploads_.end()) throw Error(where + ": there is no upload " + std::to_string(id));
  return found->second;
}

Placement FrameDecoder::placementOf(const proto::Item& in, const std::string& where) const {
  Placement placement;
  if (in.matrix_size() == 0) return placement;
  if (in.matrix_size() != 16) throw Error(where + " must hold 16 numbers, column by column");
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(in.matrix(i))) throw Error(where + " must hold finite numbers");
  }
  if (in.matrix(3) != 0 || in.matrix(7) != 0 || in.matrix(11) != 0 || in.matrix(15) != 1)
    throw Error(where + ": its last row must be 0 0 0 1");
  for (int column = 0; column < 3; ++column)
    placement.linear.col(column) = Vec3(in.matrix(4 * column), in.matrix(4 * column + 1), in.matrix(4 * column + 2));
  placement.offset = Vec3(in.matrix(12), in.matrix(13), in.matrix(14));
  return placement;
}

std::shared_ptr<const Shape> FrameDecoder::shapeOf(const proto::Primitives& in, const proto::Material& material,
                                                   const Shape* before, const std::string& where) {
  Model model = decoder_.model(in, where);
  size_.add(model, where + ": ");
  const auto repeat = [](bool has, double value) { return has && std::isfinite(value) ? value : 1; };
  repeatTexcoords(model, repeat(material.has_repeat_u(), material.repeat_u()),
                  repeat(material.has_repeat_v(), material.repeat_v()));
  auto shape = before != nullptr ? makeShape(std::move(model), *before) : makeShape(std::move(model));
  if (shape->before != 0) ++result_.refits;
  for (const std::string& warning : shape->warnings) result_.warnings.push_back(where + ": " + warning);
  return shape;
}

DecodedFrame FrameDecoder::run() {
  countItems();
  addTextures();
  addObjects();
  return std::move(result_);
}

}  // namespace

DecodedFrame decodeFrame(const proto::Frame& frame, const Uploads& uploads, const SceneLimits& limits,
                         const std::function<void(double)>& progress, const ShapeBefore& before) {
  return FrameDecoder(frame, uploads, limits, progress, before).run();
}

}  // namespace hl
