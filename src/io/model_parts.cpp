#include "io/model_parts.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/descriptor_bytes.h"
#include "base/error.h"
#include "base/utf8.h"
#include "bodies/mesh_body.h"
#include "io/body_messages.h"
#include "io/snap_messages.h"
#include "io/value_messages.h"
#include "scene/split_model.h"
#include "surfaces/iso_surface.h"
#include "surfaces/threshold.h"

namespace hl {

namespace {

constexpr std::size_t kMaxTextures = 10'000, kMaxMaterials = 0xffff, kMaxWarnings = 1000, kLongestLine = 1000;
constexpr std::size_t kMaxSceneObjects = 60'000;  // as of a scene file

// As errors and warnings are: one line, of a length to be read.
std::string firstLine(const std::string& text) {
  return validUtf8(text.substr(0, std::min(kLongestLine, text.find_first_of("\r\n"))));
}

void toProto(const CadReading& reading, proto::CadReading& out) {
  out.set_deflection_m(reading.deflection_m);
  out.set_angle_rad(reading.angle_rad);
  out.set_error_m(reading.error_m);
  out.set_tolerance_m(reading.tolerance_m);
  out.set_solids(reading.solids);
  out.set_faces(reading.faces);
}

CadReading readingOf(const proto::CadReading& in) {
  for (const double length : {in.deflection_m(), in.angle_rad(), in.error_m(), in.tolerance_m()}) {
    if (!(length >= 0) || !std::isfinite(length)) throw Error("its reader gave lengths that make no sense");
  }
  return {in.deflection_m(), in.angle_rad(), in.error_m(), in.tolerance_m(), in.solids(), in.faces()};
}

}  // namespace

void PartSender::send(const proto::ReadingPart& part) {
  const std::size_t size = part.ByteSizeLong();
  if (size > kMaxPartBytes) throw Error("a part of it is too large");
  const auto length = static_cast<std::uint32_t>(size);
  bytes_.resize(sizeof length + size);
  std::memcpy(bytes_.data(), &length, sizeof length);
  part.SerializeToArray(bytes_.data() + sizeof length, static_cast<int>(size));
  if (!writeWhole(descriptor_, bytes_.data(), bytes_.size())) throw Error("nobody reads what is read");
}

void PartSender::progress(double fraction) {
  proto::ReadingPart part;
  part.set_progress(fraction);
  send(part);
}

void PartSender::failure(const std::string& why) {
  proto::ReadingPart part;
  part.set_failure(firstLine(why));
  send(part);
}

void PartSender::header(const HeightHeader& header) { toProto(header, *samples_.mutable_heights()); }

void PartSender::header(const VolumeHeader& header) { toProto(header, *samples_.mutable_volume()); }

void PartSender::header(const CloudHeader& header) {
  proto::ReadingPart part;
  toProto(header, *part.mutable_cloud());
  send(part);
}

void PartSender::points(const CloudPiece& piece) {
  proto::ReadingPart part;
  toProto(piece, *part.mutable_cloud());
  send(part);
}

std::string& PartSender::waiting() {
  return samples_.has_volume() ? *samples_.mutable_volume()->mutable_samples()
                               : *samples_.mutable_heights()->mutable_samples();
}

void PartSender::samples(const void* samples, std::size_t bytes) {
  constexpr std::size_t kEnough = 1 << 20;
  waiting().append(static_cast<const char*>(samples), bytes);
  if (waiting().size() >= kEnough) sendSamples();
}

void PartSender::sendSamples() {
  send(samples_);
  std::string kept = std::move(waiting());  // its memory is used again
  kept.clear();
  samples_.has_volume() ? samples_.mutable_volume()->Clear() : samples_.mutable_heights()->Clear();
  waiting() = std::move(kept);
}

void PartSender::warn(const std::string& line) {
  proto::ReadingPart part;
  part.set_warning(firstLine(line));
  send(part);
}

void PartSender::scene(const SceneModel& scene) {
  if (samples_.has_heights() || samples_.has_volume()) sendSamples();
  const Model& rest = scene.model;
  proto::ReadingPart part;
  toProto(scene.mechanics, *part.mutable_mechanics());
  send(part);
  for (const SceneBody& body : scene.bodies) {
    part.Clear();
    toProto(body, *part.mutable_rigid_body());
    send(part);
    places(body.snaps, body.fields);
    model(body.model);
  }
  surfaces(scene.surfaces);
  places(scene.snaps, scene.fields);
  part.set_joined_vertices(rest.reading.joined_vertices);
  send(part);
  part.set_single_precision(rest.reading.single_precision);
  send(part);
  if (rest.reading.cad) {
    toProto(*rest.reading.cad, *part.mutable_cad());
    send(part);
  }
  parts(rest.parts);
  model(rest);
}

void PartSender::parts(const std::vector<ModelPart>& parts) {
  constexpr std::size_t kPartsInMessage = 1000;
  for (std::size_t first = 0; first < parts.size(); first += kPartsInMessage) {
    proto::ReadingPart message;
    for (std::size_t i = first; i < std::min(first + kPartsInMessage, parts.size()); ++i) {
      proto::ModelParts::Part& out = *message.mutable_parts()->add_parts();
      out.set_name(firstLine(parts[i].name));
      if (parts[i].colour) out.set_colour(packRgb(*parts[i].colour));
      out.set_vertices(parts[i].vertices);
      out.set_triangles(parts[i].triangles);
      out.set_segments(parts[i].segments);
    }
    send(message);
  }
}

void PartSender::places(const SnapList& snaps, const FieldList& fields) {
  proto::ReadingPart part;
  for (const SnapSpec& snap : snaps) {
    part.Clear();
    toProto(snap, *part.mutable_snap());
    send(part);
  }
  for (const FieldSpec& field : fields) {
    part.Clear();
    toProto(field, *part.mutable_field());
    send(part);
  }
}

void PartSender::model(const Model& model) {
  proto::ReadingPart part;
  for (std::size_t i = 0; i < std::min(model.warnings.size(), kMaxWarnings); ++i) {
    part.set_warning(firstLine(model.warnings[i]));
    send(part);
  }
  look(model.textures, model.materials);
  writeMesh(model, [&](proto::RecordedShape& mesh) {
    part.mutable_mesh()->Swap(&mesh);
    send(part);
    part.mutable_mesh()->Swap(&mesh);  // its lists are filled again
  });
}

void PartSender::look(const std::vector<Texture>& textures, const std::vector<Material>& materials) {
  proto::ReadingPart part;
  for (const Texture& texture : textures) {
    toProto(texture, *part.mutable_texture());
    send(part);
    part.Clear();
  }
  for (const Material& material : materials) {
    toProto(material, *part.mutable_material());
    send(part);
    part.Clear();
  }
}

void PartSender::surfaces(const std::vector<SceneSurface>& surfaces) {
  SurfaceWriter sources;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    proto::ReadingPart part;
    part.mutable_surface()->set_name(firstLine(surfaces[i].name));
    writeRepeat(surfaces[i].repeat, *part.mutable_surface()->mutable_repeat());
    if (surfaces[i].colour) part.mutable_surface()->set_colour(packRgb(*surfaces[i].colour));
    send(part);
    look(surfaces[i].textures, {surfaces[i].material});
    sources.write(*surfaces[i].source, i + 1, *this);
  }
}

void PartSender::take(proto::RecordedHeights& part) {
  proto::ReadingPart out;
  out.mutable_heights()->Swap(&part);
  send(out);
}

void PartSender::take(proto::RecordedVolume& part) {
  proto::ReadingPart out;
  out.mutable_volume()->Swap(&part);
  send(out);
}

void PartSender::take(proto::RecordedCloud& part) {
  proto::ReadingPart out;
  out.mutable_cloud()->Swap(&part);
  send(out);
}

void PartSender::take(proto::RecordedImplicit& part) {
  proto::ReadingPart out;
  out.mutable_implicit()->Swap(&part);
  send(out);
}

void PartCollector::addTexture(const proto::RecordedTexture& texture) {
  if (rest_.textures.size() >= kMaxTextures) throw Error("it has too many textures");
  rest_.textures.push_back(textureOf(texture));
}

void PartCollector::addMaterial(const proto::Values& material) {
  if (rest_.materials.size() >= kMaxMaterials) throw Error("it has too many materials");
  rest_.materials.push_back(materialOf(material, rest_.textures.size()));
}

void PartCollector::addWarning(const std::string& warning) {
  if (rest_.warnings.size() >= kMaxWarnings) throw Error("it has too many warnings");
  rest_.warnings.push_back(firstLine(warning));
}

void PartCollector::addSurface(const proto::ReadSurface& surface) {
  if (in_body_ || in_surface_) throw Error("it has a surface within another thing");
  if (scene_.surfaces.size() >= kMaxSceneObjects) throw Error("it has too many surfaces");
  scene_.surfaces.push_back({firstLine(surface.name()), nullptr});
  scene_.surfaces.back().repeat = repeatIn(surface.repeat());
  if (surface.has_colour()) scene_.surfaces.back().colour = unpackRgb(surface.colour());
  in_surface_ = true;
}

void PartCollector::addSource(const std::shared_ptr<const PrimitiveSource>& source) {
  if (!in_surface_) throw Error("it has the form of a surface and no surface");
  if (!source) return;  // more of it follows
  if (rest_.materials.size() != 1) throw Error("it has a surface that is not of one material");
  SceneSurface& surface = scene_.surfaces.back();
  surface.source = source;
  surface.material = rest_.materials.front();
  surface.textures = std::exchange(rest_.textures, {});
  rest_.materials.clear();
  in_surface_ = false;
}

// Samples and points, which are counted apart: of the file itself, or of one of a scene's surfaces.
bool PartCollector::addSamples(const proto::ReadingPart& part) {
  if (part.has_heights()) {
    part.heights().id() == 0 ? addHeights(part.heights()) : addSource(sources_.add(part.heights()));
  } else if (part.has_volume()) {
    part.volume().id() == 0 ? addVolume(part.volume()) : addSource(sources_.add(part.volume()));
  } else if (part.has_cloud()) {
    part.cloud().id() == 0 ? addCloud(part.cloud()) : addSource(sources_.add(part.cloud()));
  } else {
    return false;
  }
  return true;
}

// The first part has the header; samples count apart, as they are kept where they come to lie.
void PartCollector::addHeights(const proto::RecordedHeights& part) {
  if (!heights_) heights_.emplace(headerOf(part), samples_bytes_);
  heights_->add(part.samples().data(), part.samples().size());
}

void PartCollector::addVolume(const proto::RecordedVolume& part) {
  if (!volume_) volume_.emplace(headerOf(part), samples_bytes_);
  volume_->add(part.samples().data(), part.samples().size());
}

void PartCollector::addCloud(const proto::RecordedCloud& part) {
  if (!cloud_) {
    cloud_.emplace(part, samples_bytes_, false);
    cloud_turn_ = turnOf(part);
  }
  cloud_->add(part);
}

void PartCollector::takeCloud() {
  std::string note;
  scene_.surfaces.push_back({"", cloudOfFile(cloud_->take(), cloud_turn_, note)});
  if (!note.empty()) scene_.model.warnings.push_back(note);
}

// Where a file says nothing of a surface, the threshold between what is empty and what is not is a first one.
void PartCollector::takeVolume() {
  const VolumeHeader header = volume_->header();
  const std::shared_ptr<const Volume> volume = volume_->take();
  requireValues(*volume);
  const IsoValue iso = header.iso ? *header.iso : IsoValue{thresholdOf(*volume), SolidSide::kAbove};
  scene_.surfaces.push_back({"", std::make_shared<const IsoSurface>(volume, header.frame, iso)});
}

PartCollector::State PartCollector::addMesh(const proto::RecordedShape& part) {
  mesh_.add(part);
  if (part.continues()) return State::kMore;
  (in_body_ ? scene_.bodies.back().model : scene_.model) = takeModel();
  return std::exchange(in_body_, false) ? State::kMore : State::kWhole;
}

void PartCollector::addBody(const proto::RecordedBody& body) {
  if (in_body_) throw Error("it has a body without a mesh");
  scene_.bodies.push_back(sceneBodyOf(body));
  moving_bodies_ += scene_.bodies.back().spec.fixed ? 0 : 1;
  if (moving_bodies_ > kMaxBodies || scene_.bodies.size() > kMaxSceneObjects) throw Error("it has too many bodies");
  in_body_ = true;
}

void PartCollector::addSnap(const proto::RecordedSnap& snap) {
  if (snapsIn(scene_) >= kMaxSnaps) throw Error("it has too many snaps");
  (in_body_ ? scene_.bodies.back().snaps : scene_.snaps).push_back(snapOf(snap));
}

void PartCollector::addField(const proto::RecordedField& field) {
  if (fieldsIn(scene_) >= kMaxFields) throw Error("it has too many fields");
  (in_body_ ? scene_.bodies.back().fields : scene_.fields).push_back(fieldOf(field));
}

void PartCollector::addParts(const proto::ModelParts& parts) {
  for (const proto::ModelParts::Part& in : parts.parts()) {
    if (rest_.parts.size() >= kMaxModelParts) throw Error("it has too many objects");
    ModelPart part{firstLine(in.name()), {}, in.vertices(), in.triangles(), in.segments()};
    if (in.has_colour()) part.colour = unpackRgb(in.colour());
    rest_.parts.push_back(std::move(part));
  }
}

void PartCollector::addToScene(const proto::ReadingPart& part) {
  switch (part.body_case()) {
    case proto::ReadingPart::kRigidBody:
      return addBody(part.rigid_body());
    case proto::ReadingPart::kSurface:
      return addSurface(part.surface());
    case proto::ReadingPart::kImplicit:
      return addSource(sources_.add(part.implicit()));
    case proto::ReadingPart::kSnap:
      return addSnap(part.snap());
    case proto::ReadingPart::kField:
      return addField(part.field());
    case proto::ReadingPart::kMechanics:
      scene_.mechanics = mechanicsOf(part.mechanics());
      return;
    case proto::ReadingPart::kCad:
      rest_.reading.cad = readingOf(part.cad());
      return;
    case proto::ReadingPart::kParts:
      return addParts(part.parts());
    default:
      throw Error("it says nothing");
  }
}

PartCollector::State PartCollector::add(const proto::ReadingPart& part, std::size_t bytes,
                                        const std::function<void(double)>& progress) {
  if (addSamples(part)) return State::kMore;
  if (bytes > left_) throw Error("it is too large");
  left_ -= bytes;
  switch (part.body_case()) {
    case proto::ReadingPart::kProgress:
      if (progress && std::isfinite(part.progress())) progress(std::clamp(part.progress(), 0.0, 1.0));
      return State::kMore;
    case proto::ReadingPart::kFailure:
      failure_ = firstLine(part.failure());
      return State::kFailed;
    case proto::ReadingPart::kWarning:
      addWarning(part.warning());
      return State::kMore;
    case proto::ReadingPart::kTexture:
      addTexture(part.texture());
      return State::kMore;
    case proto::ReadingPart::kMaterial:
      addMaterial(part.material());
      return State::kMore;
    case proto::ReadingPart::kJoinedVertices:
      rest_.reading.joined_vertices = part.joined_vertices();
      return State::kMore;
    case proto::ReadingPart::kSinglePrecision:
      rest_.reading.single_precision = part.single_precision();
      return State::kMore;
    case proto::ReadingPart::kMesh:
      return addMesh(part.mesh());
    default:
      addToScene(part);
      return State::kMore;
  }
}

Model PartCollector::takeModel() {
  Model model = mesh_.take();
  const std::size_t materials = model.materials.size();
  model.materials = std::exchange(rest_.materials, {});
  if (model.materials.size() != materials) throw Error("its materials do not agree");
  model.textures = std::exchange(rest_.textures, {});
  model.warnings = std::exchange(rest_.warnings, {});
  return model;
}

SceneModel PartCollector::take() {
  if (in_surface_) throw Error("it has a surface without a form");
  scene_.model.reading = rest_.reading;
  scene_.model.parts = std::move(rest_.parts);
  checkParts(scene_.model);
  if (heights_) scene_.surfaces.push_back({"", heights_->take()});
  if (volume_) takeVolume();
  if (cloud_) takeCloud();
  for (const SceneBody& body : scene_.bodies) {
    if (!body.spec.fixed) bodyOf(body.model, body.spec);
  }
  return std::move(scene_);
}

}  // namespace hl
