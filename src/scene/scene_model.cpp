#include "scene/scene_model.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "scene/append_part.h"
#include "scene/iso_shape.h"
#include "scene/split_model.h"
#include "scene/tight_bounds.h"
#include "surfaces/height_field.h"
#include "surfaces/iso_surface.h"
#include "surfaces/point_cloud.h"

namespace hl {

namespace {

Instance instanceOf(Model model, std::uint64_t key, HierarchyKind hierarchy) {
  Instance instance;
  instance.shape = makeShape(std::move(model), hierarchy);
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = key;
  return instance;
}

// Forces stay as they are said, so that a spring of N/m does too; angles are none of lengths.
void scaleJoint(JointSpec& joint, double factor, const Vec3& offset) {
  joint.anchor_W = factor * joint.anchor_W + offset;
  joint.anchor_b_W = factor * joint.anchor_b_W + offset;
  if (joint.kind != JointKind::kSlider && joint.kind != JointKind::kDistance) return;
  for (double* length : {&joint.along.low, &joint.along.high, &joint.along.rest}) *length *= factor;
  for (double& position : joint.along.table.position) position *= factor;
}

void requireDifferent(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto twice = std::adjacent_find(values.begin(), values.end());
  if (twice == values.end()) return;
  std::ostringstream text;
  text << "two of its surfaces would be at iso " << *twice;
  throw Error(text.str());
}

bool isOneModel(const SceneModel& scene) {
  return scene.model.parts.empty() && scene.bodies.empty() && scene.surfaces.empty() && scene.snaps.empty() &&
         scene.fields.empty();
}

Instance instanceOf(SceneSurface surface, std::uint64_t key) {
  Instance instance;
  if (!surface.name.empty() || surface.colour)
    instance.label = std::make_shared<const Label>(Label{std::move(surface.name), surface.colour});
  if (const auto* const iso = dynamic_cast<const IsoSurface*>(surface.source.get()))
    surface.material = materialAt(*iso, surface.material);
  instance.shape = makeShape(std::move(surface.source), surface.material, std::move(surface.textures), surface.repeat,
                             std::move(surface.appearance));
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = key;
  return instance;
}

void setPlaces(Instance& instance, SnapList snaps, FieldList fields) {
  if (!snaps.empty()) instance.snaps = std::make_shared<const SnapList>(std::move(snaps));
  if (!fields.empty()) instance.fields = std::make_shared<const FieldList>(std::move(fields));
}

void moveSnaps(SnapList& snaps, double factor, const Vec3& offset) {
  snaps = placed(snaps, {factor * Mat3::Identity(), offset});
  for (SnapSpec& snap : snaps) snap.capture_m *= factor;
}

// Springs stay as they are said, in newtons for a metre.
void moveFields(FieldList& fields, double factor, const Vec3& offset) {
  fields = placed(fields, {factor * Mat3::Identity(), offset});
  for (FieldSpec& field : fields) field.reach_m *= factor;
}

// Moves all but the model by `factor` and then by `offset`.
void moveRest(SceneModel& scene, double factor, const Vec3& offset) {
  moveSnaps(scene.snaps, factor, offset);
  moveFields(scene.fields, factor, offset);
  for (SceneBody& body : scene.bodies) {
    scaleModel(body.model, factor);
    moveSnaps(body.snaps, factor, Vec3::Zero());
    moveFields(body.fields, factor, Vec3::Zero());
    body.pose.origin = factor * body.pose.origin + offset;
  }
  for (SceneSurface& surface : scene.surfaces)
    surface.source = surface.source->placed(factor * Mat3::Identity(), offset);
  for (JointSpec& joint : scene.mechanics.joints) scaleJoint(joint, factor, offset);
}

std::string warningOf(const PrimitiveSource& source) {
  constexpr double kCoarse = 1.0 / 200;  // of the spacing
  std::ostringstream text;
  if (const auto* const cloud = dynamic_cast<const PointCloud*>(&source);
      cloud != nullptr && cloud->error_m() > kCoarse * cloud->spacing())
    text << "its points are kept within " << cloud->error_m() << " m, and they are " << cloud->spacing()
         << " m apart: points far from the others make this so coarse; remove them";
  if (const auto* const iso = dynamic_cast<const IsoSurface*>(&source)) {
    const ValueRange& range = iso->volume()->pyramid.range();
    if (range.low == range.high)
      text << "all values of the volume are " << range.low << ": it has no surface, and nothing of it can be touched";
  }
  return text.str();
}

SceneSurface withIso(const SceneSurface& surface, double value) {
  const auto& iso = dynamic_cast<const IsoSurface&>(*surface.source);
  SceneSurface other = surface;
  other.source =
      std::make_shared<const IsoSurface>(iso.volume(), iso.frame(), IsoValue{value, iso.iso().solid}, iso.matter());
  requireSurface(dynamic_cast<const IsoSurface&>(*other.source));
  return other;
}

template <typename BoxOfSource>
Box boundsWith(const SceneModel& scene, const BoxOfSource& box_of) {
  Box bounds = scene.model.bounds();
  for (const SceneSurface& surface : scene.surfaces) bounds.extend(box_of(*surface.source));
  for (const SceneBody& body : scene.bodies) {
    const Box box = body.model.bounds();
    if (!box.empty()) bounds.extend(boxAt(box, body.pose));
  }
  return bounds;
}

}  // namespace

Box boundsOf(const SceneModel& scene) {
  return boundsWith(scene, [](const PrimitiveSource& source) { return source.bounds(); });
}

Model asOneModel(const SceneModel& scene) {
  if (!scene.surfaces.empty())
    throw Error("'" + scene.surfaces.front().name + "' is no mesh, and cannot be a part of one");
  Model whole = scene.model;
  whole.parts.clear();
  whole.triangle_materials.resize(whole.triangles.size());
  whole.segment_materials.resize(whole.segments.size());
  whole.point_materials.resize(whole.points.size());
  for (const SceneBody& body : scene.bodies) {
    Model part = body.model;
    placeModel(part, {body.pose.rotation, body.pose.origin});
    Material material = part.materials.front();
    material.textures = {};
    whole.materials.push_back(material);
    appendPart(whole, part, static_cast<std::uint16_t>(whole.materials.size() - 1));
  }
  return whole;
}

std::size_t elementsIn(const SceneModel& scene) {
  std::size_t elements = scene.model.elements();
  for (const SceneSurface& surface : scene.surfaces) elements += surface.source->triangles();
  for (const SceneBody& body : scene.bodies) elements += body.model.elements();
  return elements;
}

std::size_t bytesToMake(const SceneModel& scene) {
  std::size_t bytes = bytesToMake(scene.model);
  std::set<const void*> counted;
  for (const SceneSurface& surface : scene.surfaces) {
    const SharedMemory shared = surface.source->shared();
    bytes += surface.source->bytes() + (counted.insert(shared.of).second ? shared.bytes : 0);
  }
  for (const SceneBody& body : scene.bodies) bytes += bytesToMake(body.model);
  return bytes;
}

void scaleModel(SceneModel& scene, double factor) {
  scaleModel(scene.model, factor);
  moveRest(scene, factor, Vec3::Zero());
}

void scaleHeights(SceneModel& scene, double factor) {
  bool any = false;
  for (SceneSurface& surface : scene.surfaces) {
    if (dynamic_cast<const HeightField*>(surface.source.get()) == nullptr) continue;
    any = true;
    surface.source = surface.source->placed(Vec3(1, factor, 1).asDiagonal(), Vec3::Zero());
  }
  if (!any) throw Error("there is no height field in it, whose heights could be scaled");
}

// Surfaces of one volume follow each other.
void setIsoValues(SceneModel& scene, const std::vector<double>& values) {
  requireDifferent(values);
  std::vector<SceneSurface> surfaces;
  bool any = false;
  for (auto one = scene.surfaces.begin(); one != scene.surfaces.end();) {
    const auto* const iso = dynamic_cast<const IsoSurface*>(one->source.get());
    if (iso == nullptr) {
      surfaces.push_back(std::move(*one++));
      continue;
    }
    any = true;
    const auto end = std::find_if(one, scene.surfaces.end(), [volume = iso->volume()](const SceneSurface& other) {
      const auto* const next = dynamic_cast<const IsoSurface*>(other.source.get());
      return next == nullptr || next->volume() != volume;
    });
    for (std::size_t i = 0; i < values.size(); ++i)
      surfaces.push_back(
          withIso(one[std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(i), end - one - 1)], values[i]));
    one = end;
  }
  if (!any) throw Error("there is no volume in it, whose surface has an iso value");
  scene.surfaces = std::move(surfaces);
}

void setSolidSide(SceneModel& scene, SolidSide solid) {
  bool any = false;
  for (SceneSurface& surface : scene.surfaces) {
    const auto* const iso = dynamic_cast<const IsoSurface*>(surface.source.get());
    if (iso == nullptr) continue;
    any = true;
    surface.source = std::make_shared<const IsoSurface>(iso->volume(), iso->frame(), IsoValue{iso->iso().value, solid},
                                                        iso->matter());
  }
  if (!any) throw Error("there is no volume in it, whose matter could be below its iso value");
}

void setSurfels(SceneModel& scene, double reach) {
  bool any = false;
  for (SceneSurface& surface : scene.surfaces) {
    const auto* const cloud = dynamic_cast<const PointCloud*>(surface.source.get());
    if (cloud == nullptr) continue;
    any = true;
    surface.source =
        std::make_shared<const PointCloud>(cloud->points(), cloud->frame(), CloudLook{CloudForm::kSurfels, reach});
  }
  if (!any) throw Error("there is no cloud of points in it, which could be surfels");
}

std::size_t snapsIn(const SceneModel& scene) {
  std::size_t count = scene.snaps.size();
  for (const SceneBody& body : scene.bodies) count += body.snaps.size();
  return count;
}

std::size_t fieldsIn(const SceneModel& scene) {
  std::size_t count = scene.fields.size();
  for (const SceneBody& body : scene.bodies) count += body.fields.size();
  return count;
}

double fitModel(SceneModel& scene, double side) {
  if (isOneModel(scene)) return fitModel(scene.model, side);
  const Box bounds =
      boundsWith(scene, [](const PrimitiveSource& source) { return tightBounds(source, *source.makeIndex()); });
  const double largest = bounds.empty() ? 0 : bounds.size().maxCoeff();
  if (!(largest > 0)) return 1;
  const double factor = side / largest;
  const Vec3 offset = -factor * bounds.centre();
  placeModel(scene.model, {factor * Mat3::Identity(), offset});
  moveRest(scene, factor, offset);
  return factor;
}

std::shared_ptr<const Snapshot> makeSnapshot(SceneModel scene, HierarchyKind hierarchy) {
  if (isOneModel(scene)) return makeSnapshot(std::move(scene.model), hierarchy);
  const Box room = roomAround(boundsOf(scene));
  std::string name = scene.model.name;
  std::vector<std::string> warnings;
  std::vector<Instance> instances;
  std::uint64_t key = 0;
  const auto add = [&](Model& model, const std::string& part) {
    instances.push_back(instanceOf(std::move(model), ++key, hierarchy));
    for (const std::string& warning : instances.back().shape->warnings)
      warnings.push_back(part.empty() ? warning : part + ": " + warning);
  };
  if (!scene.model.parts.empty()) {
    const std::vector<ModelPart> parts = scene.model.parts;
    std::vector<Model> models = splitModel(std::move(scene.model));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      add(models[i], {});
      instances.back().label = std::make_shared<const Label>(Label{parts[i].name, parts[i].colour});
    }
    setPlaces(instances.front(), std::move(scene.snaps), std::move(scene.fields));
  } else if (scene.model.elements() > 0 || !scene.snaps.empty() || !scene.fields.empty()) {
    add(scene.model, {});
    setPlaces(instances.back(), std::move(scene.snaps), std::move(scene.fields));
  } else {
    warnings = scene.model.warnings;
  }
  for (SceneSurface& surface : scene.surfaces) {
    if (const std::string warning = warningOf(*surface.source); !warning.empty())
      warnings.push_back(surface.name.empty() || surface.name == name ? warning : surface.name + ": " + warning);
    instances.push_back(instanceOf(std::move(surface), ++key));
  }
  const std::uint64_t first_body = key + 1;
  for (SceneBody& body : scene.bodies) {
    add(body.model, body.name);
    Instance& instance = instances.back();
    setPlaces(instance, std::move(body.snaps), std::move(body.fields));
    setBody(instance, makeRigidBody(body.name, body.spec, body.pose, instance.shape->bounds, room));
  }
  auto snapshot = std::make_shared<Snapshot>(*makeSnapshot(std::move(instances), std::move(name)));
  snapshot->mechanics = std::move(scene.mechanics);
  for (JointSpec& joint : snapshot->mechanics.joints) {
    joint.body_a += first_body - 1;
    if (joint.body_b > 0) joint.body_b += first_body - 1;
  }
  snapshot->warnings = std::move(warnings);
  return snapshot;
}

std::shared_ptr<const Snapshot> withOwnBodies(const Snapshot& snapshot) {
  const auto has_body = [](const Instance& instance) { return instance.body && instance.body->poses; };
  if (std::none_of(snapshot.instances.begin(), snapshot.instances.end(), has_body)) return nullptr;
  auto own = std::make_shared<Snapshot>(snapshot);
  for (Instance& instance : own->instances) {
    if (!has_body(instance)) continue;
    const RigidBody& body = *instance.body;
    setBody(instance, makeRigidBody(body.name, body.spec, body.start, instance.shape->bounds, body.poses->room()));
  }
  for (JointSpec& joint : own->mechanics.joints) joint.shown = nullptr;
  return own;
}

}  // namespace hl
