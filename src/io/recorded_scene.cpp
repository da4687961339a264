#include "io/recorded_scene.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/values.h"
#include "io/recorded_servo.h"

namespace hl {

namespace {

constexpr const char* kBroken = "a scene of the recording makes no sense";

template <typename Visit>
void visitFields(Material& material, Visit& visit) {
  visit(material.stiffness);
  visit(material.static_friction);
  visit(material.dynamic_friction);
  visit(material.viscosity_Ns_m);
  visit(material.stribeck_m_s);
  visit(material.presliding_N_m);
  visit(material.smooth);
  for (TextureUse& use : material.textures) {
    visit(use.texture);
    visit(use.low);
    visit(use.high);
  }
}

// What a Screw is made of.
struct Way {
  Pose from, to;
  std::int64_t begin_ns = 0, end_ns = 0;

  static Way of(const Screw& screw) { return {screw.from(), screw.to(), screw.begin_ns(), screw.end_ns()}; }
  Screw screw() const { return {from, to, begin_ns, end_ns}; }
};
struct Ways {
  Way earlier, last;
};

template <typename Visit>
void visitFields(Ways& ways, Visit& visit) {
  for (Way* way : {&ways.earlier, &ways.last}) {
    for (Pose* pose : {&way->from, &way->to}) {
      for (double& number : pose->rotation.reshaped()) visit(number);
      visit(pose->origin);
    }
    visit(way->begin_ns);
    visit(way->end_ns);
  }
}

template <typename T>
T checked(const proto::Values& in) {
  T value;
  const Values values = fromProto(in);
  ValueReader reader(values);
  visitFields(value, reader);
  if (!reader.complete()) throw Error(kBroken);
  return value;
}

// Lists of vectors and of indices lie in memory as they lie in the message.
template <typename Number, typename Item>
void addAll(const std::vector<Item>& items, google::protobuf::RepeatedField<Number>& out) {
  constexpr std::size_t kEach = sizeof(Item) / sizeof(Number);
  out.Reserve(static_cast<int>(items.size() * kEach));
  for (const Item& item : items) {
    const auto* const first = reinterpret_cast<const Number*>(&item);
    out.Add(first, first + kEach);
  }
}
template <typename Item, typename Number>
std::vector<Item> itemsOf(const google::protobuf::RepeatedField<Number>& in) {
  constexpr std::size_t kEach = sizeof(Item) / sizeof(Number);
  const auto count = static_cast<std::size_t>(in.size());
  if (count % kEach != 0) throw Error(kBroken);
  std::vector<Item> items(count / kEach);
  if (count > 0) std::copy_n(in.data(), count, reinterpret_cast<Number*>(items.data()));
  return items;
}

void encode(const Shape& shape, proto::RecordedShape& out) {
  const Model& model = shape.model;
  out.set_name(model.name);
  addAll(model.positions, *out.mutable_positions());
  addAll(model.normals, *out.mutable_normals());
  addAll(model.texcoords, *out.mutable_texcoords());
  addAll(model.triangles, *out.mutable_triangles());
  addAll(model.segments, *out.mutable_segments());
  addAll(model.points, *out.mutable_points());
  out.mutable_triangle_materials()->Add(model.triangle_materials.begin(), model.triangle_materials.end());
  out.mutable_segment_materials()->Add(model.segment_materials.begin(), model.segment_materials.end());
  out.mutable_point_materials()->Add(model.point_materials.begin(), model.point_materials.end());
  out.set_materials(static_cast<std::uint32_t>(model.materials.size()));
  out.set_hierarchy(static_cast<std::uint32_t>(shape.hierarchy));
}

Model modelOf(const proto::RecordedShape& in) {
  Model model;
  model.name = in.name();
  model.positions = itemsOf<Vec3>(in.positions());
  model.normals = itemsOf<Vec3>(in.normals());
  model.texcoords = itemsOf<Vec2>(in.texcoords());
  model.triangles = itemsOf<std::array<std::uint32_t, 3>>(in.triangles());
  model.segments = itemsOf<std::array<std::uint32_t, 2>>(in.segments());
  model.points = {in.points().begin(), in.points().end()};
  model.triangle_materials = {in.triangle_materials().begin(), in.triangle_materials().end()};
  model.segment_materials = {in.segment_materials().begin(), in.segment_materials().end()};
  model.point_materials = {in.point_materials().begin(), in.point_materials().end()};
  model.materials.resize(std::clamp(in.materials(), 1U, 0xffffU));
  return model;
}

void encode(const Surfaces& surfaces, proto::RecordedSurfaces& out) {
  for (const Material& material : surfaces.materials) {
    Values values;
    ValueWriter writer(values);
    Material copy = material;
    visitFields(copy, writer);
    toProto(values, *out.add_materials());
  }
  for (const auto& texture : surfaces.textures) {
    proto::RecordedTexture& image = *out.add_textures();
    image.set_name(texture->name);
    image.set_width(static_cast<std::uint32_t>(texture->width));
    image.set_height(static_cast<std::uint32_t>(texture->height));
    image.mutable_texels()->Add(texture->texels.begin(), texture->texels.end());
    image.set_wrap(static_cast<std::uint32_t>(texture->wrap));
    image.set_filter(static_cast<std::uint32_t>(texture->filter));
  }
}

Texture textureOf(const proto::RecordedTexture& in) {
  Texture texture;
  texture.name = in.name();
  texture.width = in.width();
  texture.height = in.height();
  texture.texels = {in.texels().begin(), in.texels().end()};
  texture.wrap = static_cast<Wrap>(in.wrap() & 1);
  texture.filter = static_cast<Filter>(in.filter() & 1);
  checkTexture(texture);
  return texture;
}

void encode(const Instance& instance, proto::RecordedInstance& out) {
  Ways ways{Way::of(instance.motion.earlier()), Way::of(instance.motion.last())};
  Values values;
  ValueWriter writer(values);
  visitFields(ways, writer);
  toProto(values, *out.mutable_motion());
  out.set_key(instance.key);
  out.set_session(instance.session);
  out.set_object(instance.object);
  out.set_name(instance.name);
}

}  // namespace

template <typename Part, typename Encode>
std::uint64_t SceneWriter::idOf(std::map<const Part*, Written<Part>>& written, const std::shared_ptr<const Part>& part,
                                const Encode& encode_part) {
  std::erase_if(written, [](const auto& entry) { return entry.second.part.expired(); });
  Written<Part>& entry = written[part.get()];
  if (entry.id == 0) {
    entry = {part, ++last_id_};
    encode_part(entry.id);
  }
  return entry.id;
}

void SceneWriter::write(const Snapshot& scene, const Write& write) {
  proto::RecordingBlock block;
  proto::RecordedScene& out = *block.mutable_scene();
  out.set_identity(scene.identity);
  out.set_number(scene.number);
  out.set_blend_ns(scene.blend_ns);
  out.set_name(scene.name);
  for (const Instance& instance : scene.instances) {
    proto::RecordedInstance& placed = *out.add_instances();
    encode(instance, placed);
    const auto shapeId = [&](const std::shared_ptr<const Shape>& shape) {
      return idOf(shapes_, shape, [&](std::uint64_t id) {
        proto::RecordingBlock part;
        part.mutable_shape()->set_id(id);
        encode(*shape, *part.mutable_shape());
        write(part);
      });
    };
    placed.set_shape(shapeId(instance.shape));
    if (instance.before) placed.set_before(shapeId(instance.before));
    placed.set_surfaces(idOf(surfaces_, instance.surfaces, [&](std::uint64_t id) {
      proto::RecordingBlock part;
      part.mutable_surfaces()->set_id(id);
      encode(*instance.surfaces, *part.mutable_surfaces());
      write(part);
    }));
  }
  write(block);
}

void SceneReader::add(const proto::RecordedShape& in) {
  if (in.hierarchy() > static_cast<std::uint32_t>(HierarchyKind::kNone)) throw Error(kBroken);
  shapes_[in.id()] = makeShape(modelOf(in), static_cast<HierarchyKind>(in.hierarchy()));
}

void SceneReader::add(const proto::RecordedSurfaces& in) {
  auto surfaces = std::make_shared<Surfaces>();
  for (const proto::RecordedTexture& texture : in.textures())
    surfaces->textures.push_back(std::make_shared<const Texture>(textureOf(texture)));
  for (const proto::Values& values : in.materials()) {
    surfaces->materials.push_back(checked<Material>(values));
    for (const TextureUse& use : surfaces->materials.back().textures) {
      if (use.used() && use.texture >= surfaces->textures.size()) throw Error(kBroken);
    }
  }
  surfaces_[in.id()] = std::move(surfaces);
}

std::shared_ptr<const Snapshot> SceneReader::scene(const proto::RecordedScene& in) const {
  std::vector<Instance> instances;
  for (const proto::RecordedInstance& placed : in.instances()) {
    const auto shape = shapes_.find(placed.shape());
    const auto surfaces = surfaces_.find(placed.surfaces());
    if (shape == shapes_.end() || surfaces == surfaces_.end()) throw Error(kBroken);
    if (surfaces->second->materials.size() < shape->second->model.materials.size()) throw Error(kBroken);
    const Ways ways = checked<Ways>(placed.motion());
    instances.push_back({shape->second, surfaces->second, Motion(ways.earlier.screw(), ways.last.screw()), placed.key(),
                         placed.session(), placed.object(), placed.name()});
    if (placed.before() == 0) continue;
    const auto before = shapes_.find(placed.before());
    if (before == shapes_.end() || !isSameMesh(*before->second, *shape->second)) throw Error(kBroken);
    instances.back().before = before->second;
  }
  return makeSnapshot(std::move(instances), in.name(), in.number(), in.blend_ns());
}

}  // namespace hl
