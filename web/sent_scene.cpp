#include "sent_scene.h"

#include <cmath>
#include <limits>
#include <utility>

#include "put.h"
#include "scene/iso_shape.h"
#include "surfaces/point_cloud.h"

namespace hl {

namespace {

double limit(double value) { return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN(); }

void appendPose(std::vector<double>& out, const Pose& pose) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out.push_back(pose.rotation(row, column));
    out.push_back(pose.origin[row]);
  }
}

double pointsOf(const Shape& shape) {
  const auto* const cloud = dynamic_cast<const PointCloud*>(shape.source.get());
  return cloud == nullptr ? 0 : static_cast<double>(cloud->points()->size());
}

template <typename Spec>
HlWebPlace placeOf(const Spec& spec, std::uint32_t object, double kind, double reach, double strength) {
  HlWebPlace place{static_cast<double>(object), static_cast<double>(spec.points.size()), kind, reach, strength, {}, {}};
  if (spec.normal) put(place.normal, *spec.normal);
  return place;
}

}  // namespace

SentScene::SentScene(std::shared_ptr<const Snapshot> snapshot) : snapshot_(std::move(snapshot)) {
  for (const Instance& instance : snapshot_->instances) addObject(instance);
  for (const JointSpec& joint : snapshot_->mechanics.joints) addJoint(joint);
  addPlaces();
  addVolumes();
}

void SentScene::addObject(const Instance& instance) {
  drawn_.push_back({std::shared_ptr<const Model>(instance.shape, &instance.shape->model), {}});
  objects_.emplace_back();
  describe(objects_.size() - 1);
  appendPose(starts_, instance.body ? instance.body->start : instance.shownAt(0));
}

void SentScene::describe(std::size_t object) {
  const Instance& instance = snapshot_->instances[object];
  const Model& model = *drawn_[object].model;
  objects_[object] = {static_cast<double>(model.positions.size()),
                      static_cast<double>(model.normals.size()),
                      static_cast<double>(model.triangles.size()),
                      static_cast<double>(model.segments.size()),
                      instance.body ? (instance.movesAsBody() ? 2.0 : 1.0) : 0.0,
                      drawn_[object].colours.empty() ? 0.0 : 1.0,
                      pointsOf(*instance.shape)};
}

const char* SentScene::name(int object) const {
  const auto& label = snapshot_->instances.at(static_cast<std::size_t>(object)).label;
  return label ? label->name.c_str() : "";
}

void SentScene::draw(int object, std::size_t triangles) {
  const auto number = static_cast<std::size_t>(object);
  const Shape& shape = *snapshot_->instances.at(number).shape;
  if (!shape.source) return;
  DrawnMesh drawn = shape.source->drawn(triangles);
  Model model;
  model.positions = std::move(drawn.positions);
  model.normals = std::move(drawn.normals);
  model.triangles = std::move(drawn.triangles);
  drawn_[number] = {std::make_shared<const Model>(std::move(model)), std::move(drawn.colours)};
  describe(number);
}

void SentScene::replace(std::shared_ptr<const Snapshot> snapshot, std::size_t object) {
  snapshot_ = std::move(snapshot);
  const auto& shape = snapshot_->instances.at(object).shape;
  drawn_[object] = {std::shared_ptr<const Model>(shape, &shape->model), {}};
  describe(object);
  addVolumes();
}

void SentScene::addJoint(const JointSpec& joint) {
  std::uint32_t a = 0, b = 0;
  if (!snapshot_->find(joint.body_a, a) || (joint.body_b != 0 && !snapshot_->find(joint.body_b, b))) return;
  HlWebJoint out{};
  out.kind = static_cast<double>(joint.kind);
  out.object_a = a;
  out.object_b = joint.body_b == 0 ? -1.0 : b;
  put(out.anchor, joint.anchor_W);
  put(out.anchor_b, joint.anchor_b_W);
  put(out.axis, joint.axis_W);
  out.low = limit(joint.along.low);
  out.high = limit(joint.along.high);
  joints_.push_back(out);
}

void SentScene::addPlaces() {
  for (const PlacedSnap& snap : snapshot_->snaps) {
    const SnapSpec& spec = (*snapshot_->instances[snap.instance].snaps)[snap.number];
    places_.push_back(placeOf(spec, snap.instance, -1, spec.capture_m, spec.release_N));
    points_.push_back(&spec.points);
  }
  for (const PlacedField& field : snapshot_->fields) {
    const FieldSpec& spec = (*snapshot_->instances[field.instance].fields)[field.number];
    places_.push_back(placeOf(spec, field.instance, static_cast<double>(spec.kind), spec.reach_m, spec.force_N));
    put(places_.back().direction, spec.direction);
    points_.push_back(&spec.points);
  }
}

void SentScene::addVolumes() {
  volumes_.clear();
  for (std::size_t i = 0; i < snapshot_->instances.size(); ++i) {
    const IsoSurface* const surface = isoSurfaceOf(snapshot_->instances[i]);
    if (surface == nullptr) continue;
    const ValueRange& range = surface->volume()->pyramid.range();
    volumes_.push_back({static_cast<double>(i), surface->iso().value, range.low, range.high,
                        surface->iso().solid == SolidSide::kBelow ? 1.0 : 0.0});
  }
}

const double* SentScene::posesAt(std::int64_t now_ns) {
  poses_.clear();
  for (const Instance& instance : snapshot_->instances) appendPose(poses_, instance.shownAt(now_ns));
  return poses_.data();
}

}  // namespace hl
