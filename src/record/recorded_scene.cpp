#include "record/recorded_scene.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/utf8.h"
#include "io/body_messages.h"
#include "io/snap_messages.h"
#include "io/value_messages.h"

namespace hl {

namespace {

constexpr const char* kBrokenScene = "a scene of the recording makes no sense";

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

struct ComplianceWays {
  ComplianceMotion::Way earlier, last;
};

void checkCompliance(const Compliance& compliance) {
  checkRanges("a compliance", {{"normal_m_N", compliance.normal_m_N, 0, kMaxCompliance_m_N},
                               {"tangential_m_N", compliance.tangential_m_N, 0, kMaxCompliance_m_N}});
  for (int i = 0; i < 3; ++i) {
    checkRanges("a compliance",
                {{"computed_for_N", compliance.computed_for_N[i], -kMaxComputedForce_N, kMaxComputedForce_N}});
  }
}

std::shared_ptr<const ComplianceMotion> complianceOf(const proto::RecordedInstance& in) {
  if (!in.has_compliance()) return nullptr;
  ComplianceWays ways;
  readValues(in.compliance(), "a compliance", ways);
  for (const ComplianceMotion::Way& way : {ways.earlier, ways.last}) {
    checkCompliance(way.from);
    checkCompliance(way.to);
    checkTime(way.begin_ns, "the beginning of a compliance");
    checkTime(way.end_ns, "the end of a compliance");
    if (way.begin_ns > way.end_ns) throw Error("a compliance makes no sense: it ends before it begins");
  }
  return std::make_shared<const ComplianceMotion>(ways.earlier, ways.last);
}

std::shared_ptr<const SnapList> snapsOf(const proto::RecordedInstance& in) {
  if (in.snaps_size() == 0) return nullptr;
  SnapList snaps;
  for (const proto::RecordedSnap& snap : in.snaps()) snaps.push_back(snapOf(snap));
  return std::make_shared<const SnapList>(std::move(snaps));
}

std::shared_ptr<const FieldList> fieldsOf(const proto::RecordedInstance& in) {
  if (in.fields_size() == 0) return nullptr;
  FieldList fields;
  for (const proto::RecordedField& field : in.fields()) fields.push_back(fieldOf(field));
  return std::make_shared<const FieldList>(std::move(fields));
}

Ways waysOf(const proto::Values& in) {
  Ways ways;
  readValues(in, "a motion", ways);
  for (const Way& way : {ways.earlier, ways.last}) {
    checkRecorded(way.from, "a motion");
    checkRecorded(way.to, "a motion");
    checkTime(way.begin_ns, "the beginning of a motion");
    checkTime(way.end_ns, "the end of a motion");
    if (way.begin_ns > way.end_ns) throw Error("a motion makes no sense: it ends before it begins");
  }
  return ways;
}

std::shared_ptr<const Label> labelOf(const proto::RecordedInstance& in) {
  if (in.label().empty() && !in.has_colour()) return nullptr;
  Label label{in.label()};
  if (in.has_colour()) label.colour = unpackRgb(in.colour());
  return std::make_shared<const Label>(std::move(label));
}

void encode(const Surfaces& surfaces, proto::RecordedSurfaces& out) {
  for (const Material& material : surfaces.materials) toProto(material, *out.add_materials());
  for (const auto& texture : surfaces.textures) toProto(*texture, *out.add_textures());
}

void encode(const Instance& instance, proto::RecordedInstance& out) {
  const Ways ways{Way::of(instance.motion.earlier()), Way::of(instance.motion.last())};
  toProto(valuesOf(ways), *out.mutable_motion());
  out.set_key(instance.key);
  out.set_session(instance.session);
  out.set_object(instance.object);
  out.set_name(instance.name);
  out.set_item(instance.item);
  out.set_answers_force(instance.answers_force);
  out.set_replaced_in(instance.replaced_in);
  if (instance.label) out.set_label(instance.label->name);
  if (instance.label && instance.label->colour) out.set_colour(packRgb(*instance.label->colour));
  if (instance.snaps) {
    for (const SnapSpec& snap : *instance.snaps) toProto(snap, *out.add_snaps());
  }
  if (instance.fields) {
    for (const FieldSpec& field : *instance.fields) toProto(field, *out.add_fields());
  }
  if (!instance.compliance) return;
  const ComplianceWays yields{instance.compliance->earlier(), instance.compliance->last()};
  toProto(valuesOf(yields), *out.mutable_compliance());
}

/// Each part of a surface is a block.
class BlockParts final : public SurfaceParts {
 public:
  BlockParts(const SceneWriter::Write& write, const Vec2& repeat) : write_(write), repeat_(repeat) {}
  void take(proto::RecordedHeights& part) override {
    const bool is_first = part.columns() > 0;
    if (is_first) writeRepeat(repeat_, *part.mutable_repeat());
    block_.mutable_heights()->Swap(&part);
    write_(block_);
  }
  void take(proto::RecordedVolume& part) override {
    block_.mutable_volume()->Swap(&part);
    write_(block_);
  }
  void take(proto::RecordedCloud& part) override {
    block_.mutable_cloud()->Swap(&part);
    write_(block_);
  }
  void take(proto::RecordedImplicit& part) override {
    block_.mutable_implicit()->Swap(&part);
    write_(block_);
  }

 private:
  const SceneWriter::Write& write_;
  const Vec2 repeat_;
  proto::RecordingBlock block_;
};

void addPose(std::uint64_t body, std::span<const float> pose, proto::RecordedPoses& out) {
  out.add_bodies(body);
  out.mutable_poses()->Add(pose.begin(), pose.end());
}

}  // namespace

template <typename Part, typename Encode>
std::uint64_t SceneWriter::idOf(std::map<const Part*, Written<Part>>& written, const std::shared_ptr<const Part>& part,
                                const Encode& encode_part) {
  std::erase_if(written, [](const auto& entry) { return entry.second.part.expired(); });
  Written<Part>& entry = written[part.get()];
  if (entry.id == 0) {
    // Known when it is written: where that fails it is not, and is tried again with the next scene.
    encode_part(last_id_ + 1);
    entry = {part, ++last_id_};
  }
  return entry.id;
}

void SceneWriter::know(const std::shared_ptr<const Shape>& shape) {
  idOf(shapes_, shape, [](std::uint64_t) {});
}

void SceneWriter::know(const std::shared_ptr<const Surfaces>& surfaces) {
  idOf(surfaces_, surfaces, [](std::uint64_t) {});
}

std::uint64_t SceneWriter::shapeId(const std::shared_ptr<const Shape>& shape, const Write& write) {
  return idOf(shapes_, shape, [&](std::uint64_t id) {
    if (shape->source) {
      BlockParts blocks(write, shape->repeat);
      return sources_.write(*shape->source, id, blocks);
    }
    writeMesh(shape->model, [&](proto::RecordedShape& mesh) {
      proto::RecordingBlock part;
      part.mutable_shape()->Swap(&mesh);
      part.mutable_shape()->set_id(id);
      part.mutable_shape()->set_hierarchy(static_cast<std::uint32_t>(shape->hierarchy));
      write(part);
    });
  });
}

std::uint64_t SceneWriter::bodyId(const std::shared_ptr<const RigidBody>& body, const Write& write) {
  return idOf(bodies_, body, [&](std::uint64_t id) {
    proto::RecordingBlock part;
    part.mutable_rigid_body()->set_id(id);
    toProto(*body, *part.mutable_rigid_body());
    write(part);
  });
}

void SceneWriter::write(const Snapshot& scene, const Write& write) {
  proto::RecordingBlock block;
  proto::RecordedScene& out = *block.mutable_scene();
  out.set_identity(scene.identity);
  out.set_number(scene.number);
  out.set_blend_ns(scene.blend_ns);
  out.set_name(validUtf8(scene.name));
  const auto is_body = [](const Instance& instance) { return instance.body != nullptr; };
  if (std::any_of(scene.instances.begin(), scene.instances.end(), is_body))
    toProto(scene.mechanics, *out.mutable_mechanics());
  for (const Instance& instance : scene.instances) {
    if (instance.driver && !instance.movesAsBody()) throw Error("an object that is driven cannot be recorded");
    proto::RecordedInstance& placed = *out.add_instances();
    encode(instance, placed);
    placed.set_shape(shapeId(instance.shape, write));
    const auto add_way = [&](const MeshTransition& way) {
      proto::RecordedMeshTransition& recorded = *placed.add_mesh_motion();
      recorded.set_from(shapeId(way.given_from(), write));
      recorded.set_to(shapeId(way.given_to(), write));
      recorded.set_begin_ns(way.begin_ns());
      recorded.set_end_ns(way.end_ns());
    };
    if (instance.mesh_motion && instance.mesh_motion->earlier()) add_way(*instance.mesh_motion->earlier());
    if (instance.mesh_motion) add_way(instance.mesh_motion->last());
    if (instance.body) placed.set_body(bodyId(instance.body, write));
    placed.set_surfaces(idOf(surfaces_, instance.surfaces, [&](std::uint64_t id) {
      proto::RecordingBlock part;
      part.mutable_surfaces()->set_id(id);
      encode(*instance.surfaces, *part.mutable_surfaces());
      write(part);
    }));
  }
  write(block);
}

// What begins to move is written as it was at the look before too: until then it was at rest.
void SceneWriter::writePoses(std::int64_t now_ns, const Write& write) {
  std::map<std::uint64_t, SeenBody> seen;
  proto::RecordingBlock rested, moved;
  for (const auto& [_, written] : bodies_) {
    const auto body = written.part.lock();
    if (!body || !body->poses) continue;
    const Pose pose = body->poses->shown().pose;
    SeenBody now{now_ns, {}};
    std::copy_n(pose.rotation.data(), 9, now.pose.begin());
    std::copy_n(pose.origin.data(), 3, now.pose.begin() + 9);
    const auto before = seen_.find(written.id);
    const bool known = before != seen_.end();
    if (known && before->second.pose == now.pose) {
      seen[written.id] = before->second;
      continue;
    }
    if (known && before->second.time_ns < last_look_ns_)
      addPose(written.id, before->second.pose, *rested.mutable_poses());
    addPose(written.id, now.pose, *moved.mutable_poses());
    seen[written.id] = now;
  }
  if (rested.has_poses()) rested.mutable_poses()->set_time_ns(last_look_ns_);
  if (moved.has_poses()) moved.mutable_poses()->set_time_ns(now_ns);
  for (const auto* block : {&rested, &moved}) {
    if (block->has_poses()) write(*block);
  }
  seen_ = std::move(seen);
  last_look_ns_ = now_ns;
}

void SceneReader::add(const proto::RecordedShape& in) {
  if (in.hierarchy() > static_cast<std::uint32_t>(HierarchyKind::kNone)) throw Error(kBrokenScene);
  if (sources_.begun() || (begun_ && *begun_ != in.id())) throw Error(kBrokenScene);
  begun_ = in.id();
  mesh_.add(in);
  if (in.continues()) return;
  begun_.reset();
  shapes_[in.id()] = makeShape(mesh_.take(), static_cast<HierarchyKind>(in.hierarchy()));
}

void SceneReader::add(const proto::RecordedHeights& in) {
  if (!sources_.begun()) repeat_ = repeatIn(in.repeat());
  add(in.id(), sources_.add(in), repeat_);
}

void SceneReader::add(std::uint64_t id, const SurfaceReader::Source& source, const Vec2& repeat) {
  if (begun_) throw Error(kBrokenScene);
  if (source) shapes_[id] = makeShape(source, {}, {}, repeat);
}

void SceneReader::add(const proto::RecordedSurfaces& in) {
  auto surfaces = std::make_shared<Surfaces>();
  for (const proto::RecordedTexture& texture : in.textures())
    surfaces->textures.push_back(std::make_shared<const Texture>(textureOf(texture)));
  for (const proto::Values& values : in.materials())
    surfaces->materials.push_back(materialOf(values, surfaces->textures.size()));
  surfaces_[in.id()] = std::move(surfaces);
}

void SceneReader::add(const proto::RecordedBody& in) { bodies_[in.id()] = rigidBodyOf(in); }

void SceneReader::setBody(std::uint64_t id, Instance& instance) const {
  if (id == 0) return;
  const auto body = bodies_.find(id);
  if (body == bodies_.end()) throw Error(kBrokenScene);
  instance.body = body->second;
  instance.driver = instance.body->poses;
}

MeshTransition SceneReader::wayOf(const proto::RecordedMeshTransition& in, const Surfaces& surfaces) const {
  const auto from = shapes_.find(in.from()), to = shapes_.find(in.to());
  if (from == shapes_.end() || to == shapes_.end() || !isSameMesh(*from->second, *to->second))
    throw Error(kBrokenScene);
  if (in.end_ns() <= in.begin_ns() || surfaces.materials.size() < to->second->model.materials.size())
    throw Error(kBrokenScene);
  return {from->second, to->second, in.begin_ns(), in.end_ns()};
}

std::shared_ptr<const MeshMotion> SceneReader::meshMotionOf(const proto::RecordedInstance& in,
                                                            const Surfaces& surfaces) const {
  if (in.mesh_motion_size() == 0) return nullptr;
  if (in.mesh_motion_size() == 1) return std::make_shared<MeshMotion>(wayOf(in.mesh_motion(0), surfaces));
  return std::make_shared<MeshMotion>(wayOf(in.mesh_motion(0), surfaces), wayOf(in.mesh_motion(1), surfaces));
}

std::shared_ptr<const Snapshot> SceneReader::scene(const proto::RecordedScene& in) const {
  constexpr double kLongestBlend_ns = 1e12;
  checkRanges("a scene", {{"blend_ns", static_cast<double>(in.blend_ns()), 0, kLongestBlend_ns}});
  std::vector<Instance> instances;
  std::size_t bodies = 0;
  for (const proto::RecordedInstance& placed : in.instances()) {
    const auto shape = shapes_.find(placed.shape());
    const auto surfaces = surfaces_.find(placed.surfaces());
    if (shape == shapes_.end() || surfaces == surfaces_.end()) throw Error(kBrokenScene);
    if (surfaces->second->materials.size() < shape->second->model.materials.size()) throw Error(kBrokenScene);
    const Ways ways = waysOf(placed.motion());
    instances.push_back({shape->second, surfaces->second, Motion(ways.earlier.screw(), ways.last.screw()), placed.key(),
                         placed.session(), placed.object(), placed.name()});
    instances.back().mesh_motion = meshMotionOf(placed, *surfaces->second);
    instances.back().compliance = complianceOf(placed);
    instances.back().item = placed.item();
    instances.back().answers_force = placed.answers_force();
    instances.back().replaced_in = placed.replaced_in();
    instances.back().label = labelOf(placed);
    instances.back().snaps = snapsOf(placed);
    instances.back().fields = fieldsOf(placed);
    setBody(placed.body(), instances.back());
    bodies += instances.back().movesAsBody() ? 1 : 0;
  }
  if (bodies > kMaxBodies) throw Error(kBrokenScene);
  return makeSnapshot(std::move(instances), in.name(), in.number(), in.blend_ns(),
                      in.has_mechanics() ? mechanicsOf(in.mechanics()) : Mechanics{});
}

}  // namespace hl
