#include "io/load_scene_file.h"

#include <fmt/core.h>
#include <google/protobuf/util/json_util.h>
#include <hl.pb.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>

#include "base/direction.h"
#include "base/error.h"
#include "base/plain_file.h"
#include "builtin.h"
#include "io/decode_scene.h"
#include "io/file_ending.h"
#include "io/json_flags.h"
#include "io/json_lines.h"
#include "io/load_image.h"
#include "io/scene_mechanics.h"
#include "io/scene_notes.h"
#include "io/scene_surfaces.h"
#include "io/vec_messages.h"
#include "scene/append_part.h"
#include "wire/json_words.h"

namespace hl {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{64} << 20;
constexpr std::size_t kMaxFileTexels = std::size_t{8192} * 8192;
constexpr int kMaxObjects = 60'000;  // materials are counted in 16 bits
constexpr const char* kAlone = "names another file, and this one comes alone";

std::string readText(const std::string& path) {
  checkPlainFile(path);
  std::error_code error;
  if (fs::file_size(path, error) > kMaxFileBytes)
    throw Error(path + ": is larger than 64 MB; put meshes in model files");
  return std::string(withoutByteOrderMark(contentOf(path).value_or("")));
}

// The textures that the material uses, by whose numbers it knows them from now on.
std::vector<Texture> ownTextures(Material& material, const Model& whole) {
  std::vector<Texture> textures;
  for (TextureUse& use : material.textures) {
    if (!use.used()) continue;
    textures.push_back(whole.textures[use.texture]);
    use.texture = static_cast<std::uint32_t>(textures.size() - 1);
  }
  return textures;
}

// One scene file on its way to a model. Paths name the JSON values that errors point at.
class SceneFile {
 public:
  SceneFile(const std::string& path, const LoadOptions& options)
      : path_(path),
        place_(options.alone ? "line " : path + ":"),
        folder_(fs::path(path).parent_path()),
        options_(options),
        text_(readText(path)),
        lines_(place_, text_),
        decoder_([this](const std::string& where, const std::string& message) { fail(where, message); }),
        mechanics_(decoder_,
                   [this](const std::string& where, const std::string& message) { notes_.say(where, message); }),
        surfaces_(folder_, options_) {
    parse();
  }

  SceneModel build();

 private:
  // Names from the file may hold anything; the message stays one line.
  std::string lineAt(std::size_t line, std::string message) const {
    std::replace_if(
        message.begin(), message.end(), [](unsigned char c) { return c < ' '; }, '?');
    return place_ + std::to_string(line) + ": " + message;
  }
  [[noreturn]] void fail(const std::string& where, const std::string& message) const {
    throw Error(lineAt(lines_.linesOf({where}).front(), message));
  }
  void parse();
  void checkFinite(const google::protobuf::Message& message, const std::string& where) const;
  void addTexture(Model& model, const proto::TextureImage& in, const std::string& where);
  Material materialOf(const proto::Material& in, const std::string& where) const;
  Material materialOn(const TextureRoom& room, const proto::SceneObject& object, const std::string& where,
                      const Model& whole);
  Model shapeOf(const proto::SceneObject& object, const std::string& where);
  Model fileModel(const proto::SceneObject& object, const std::string& where);
  CadMeshing meshingOf(const proto::SceneObject& object, const std::string& where) const;
  std::optional<Rgb> colourOf(const proto::SceneObject& object, const std::string& where) const;
  Appearance pictureOn(const proto::SceneObject& object, bool has_texcoords, const std::string& where);
  void paint(const proto::SceneObject& object, const std::string& where, Model& part);
  void setMaterial(const proto::SceneObject& object, const std::string& where, const Model& whole,
                   SceneSurface& surface);
  void addSurfaces(const proto::SceneObject& object, const std::string& where, SceneModel& scene);
  Placement placementOf(const proto::Transform& in, const std::string& where) const;
  Pose poseOf(const proto::Transform& in, const std::string& where) const;
  void addAtRest(Model part, const proto::SceneObject& object, const std::string& where, SceneModel& scene);
  SnapList snapsOf(const proto::SceneObject& object, const Placement& placement, const std::string& where) const;
  FieldList fieldsOf(const proto::SceneObject& object, const Placement& placement, const std::string& where) const;
  SceneBody bodyOf(Model part, const proto::SceneObject& object, const std::string& where, const Model& whole);
  void checkPlaces(const SceneModel& scene) const;

  const std::string path_;
  const std::string place_;  // what stands before the line's number in errors
  const fs::path folder_;
  const LoadOptions& options_;
  const std::string text_;
  const JsonLines lines_;
  const SceneDecoder decoder_;
  SceneNotes notes_;
  const SceneMechanics mechanics_;
  proto::Scene scene_;
  std::map<std::string, std::uint32_t> textures_;
  std::size_t texels_ = 0;  // of all textures
  SceneSurfaces surfaces_;
  struct ReadFile {
    std::string name;
    CadMeshing meshing;
    Model model;
  };
  std::vector<ReadFile> files_;                                         // read once, however many objects show them
  std::map<std::string, std::shared_ptr<const std::string>> pictures_;  // the same
};

void SceneFile::parse() {
  if (text_[text_.find_first_not_of(" \t\r\n")] != '{')
    fail("", "a scene file must be one object: {\"objects\": [..]}");
  google::protobuf::util::JsonParseOptions options;
  options.case_insensitive_enum_parsing = true;  // as the words of procedural textures and of options are small
  const auto status = google::protobuf::util::JsonStringToMessage(text_, &scene_, options);
  if (status.ok()) {
    const std::string flag = textForFlag(text_, *proto::Scene::descriptor());
    if (!flag.empty()) fail(flag, flag + ": it must be true or false, without quotation marks");
    return;
  }
  const JsonFault fault = faultOfJson(std::string(status.message()));
  fail(fault.where, fault.line());
}

// JSON may write "NaN" and "Infinity" as strings, and protobuf takes them for numbers.
void SceneFile::checkFinite(const google::protobuf::Message& message, const std::string& where) const {
  const auto* reflection = message.GetReflection();
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  reflection->ListFields(message, &fields);
  for (const auto* field : fields) {
    const std::string at = where.empty() ? field->json_name() : where + "." + field->json_name();
    const int count = field->is_repeated() ? reflection->FieldSize(message, field) : 1;
    for (int i = 0; i < count; ++i) {
      if (field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE) {
        field->is_repeated() ? checkFinite(reflection->GetRepeatedMessage(message, field, i), pathOf(at, i))
                             : checkFinite(reflection->GetMessage(message, field), at);
      } else if (field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE) {
        const double value = field->is_repeated() ? reflection->GetRepeatedDouble(message, field, i)
                                                  : reflection->GetDouble(message, field);
        if (!std::isfinite(value)) fail(at, at + " must be a finite number");
      }
    }
  }
}

void SceneFile::addTexture(Model& model, const proto::TextureImage& in, const std::string& where) {
  if (textures_.contains(in.name())) fail(where, where + ": there are two textures of the name '" + in.name() + "'");
  Texture texture;
  if (in.source_case() == proto::TextureImage::kFile) {
    if (options_.alone) fail(where, where + ".file: " + kAlone);
    try {
      texture = loadImage((folder_ / in.file()).string(), options_.progress);
    } catch (const Error& error) {
      fail(where, error.what());
    }
    decoder_.setReading(in, texture, where);
  } else if (in.source_case() == proto::TextureImage::SOURCE_NOT_SET) {
    fail(where, where + ": a texture needs a file, a procedural or texels");
  } else {
    texture = decoder_.texture(in, std::min(kMaxFileTexels, options_.most_texels - texels_), where);
  }
  texels_ += texture.texels.size();
  if (texels_ > options_.most_texels)
    fail(where, fmt::format("with {} the scene has more than {} texels", where, options_.most_texels));
  textures_[in.name()] = static_cast<std::uint32_t>(model.textures.size());
  model.textures.push_back(std::move(texture));
}

Material SceneFile::materialOf(const proto::Material& in, const std::string& where) const {
  const SurfaceChange surface = decoder_.surface(in, where);
  Material material = surface.material();
  for (int i = 0; i < in.textures_size(); ++i) {
    const auto quantity = static_cast<std::size_t>(quantityOf(in.textures(i).quantity()));
    const NamedTextureUse& use = *surface.textures[quantity];
    const auto found = textures_.find(use.texture);
    const std::string at = pathOf(where + ".textures", i);
    if (found == textures_.end()) fail(at, at + ": there is no texture '" + use.texture + "' in this scene");
    material.textures[quantity] = {found->second, use.low, use.high};
  }
  return material;
}

// Without the textures that nobody could feel on what has this room for them.
Material SceneFile::materialOn(const TextureRoom& room, const proto::SceneObject& object, const std::string& where,
                               const Model& whole) {
  Material material = materialOf(object.material(), where + ".material");
  notes_.leaveIdleOut(material, room, whole.textures, object, where);
  return material;
}

CadMeshing SceneFile::meshingOf(const proto::SceneObject& object, const std::string& where) const {
  CadMeshing meshing = options_.cad;
  if (!object.has_meshing()) return meshing;
  const std::string at = where + ".meshing";
  if (!readsCad(endingOf(object.file()))) fail(at, at + " is of CAD files: step, iges and brep");
  const proto::Meshing& in = object.meshing();
  meshing.asked = meshing.asked || in.deflection_m() != 0;
  if (in.deflection_m() != 0)
    meshing.deflection_m = decoder_.checked(in.deflection_m(), kMinDeflection_m, kMaxDeflection_m, at + ".deflectionM");
  if (in.angle_rad() != 0)
    meshing.angle_rad = decoder_.checked(in.angle_rad(), kMinAngle_rad, kMaxAngle_rad, at + ".angleRad");
  return meshing;
}

Model SceneFile::fileModel(const proto::SceneObject& object, const std::string& where) {
  const std::string& name = object.file();
  const std::string at = where + ".file";
  if (isSceneFile(name)) fail(at, at + ": a scene file cannot hold another");
  if (options_.alone) fail(at, at + ": " + kAlone);
  LoadOptions options = options_;
  options.cad = meshingOf(object, where);
  const auto found = std::find_if(files_.begin(), files_.end(), [&](const ReadFile& file) {
    return file.name == name && file.meshing == options.cad;
  });
  if (found != files_.end()) return found->model;
  try {
    files_.push_back({name, options.cad, loadModel((folder_ / name).string(), options)});
  } catch (const Error& error) {
    fail(at, at + ": " + error.what());
  }
  return files_.back().model;
}

Model SceneFile::shapeOf(const proto::SceneObject& object, const std::string& where) {
  switch (object.shape_case()) {
    case proto::SceneObject::kFile:
      return fileModel(object, where);
    case proto::SceneObject::kBuiltin:
      try {
        return makeBuiltinScene(object.builtin());
      } catch (const Error& error) {
        fail(where + ".builtin", error.what());
      }
    case proto::SceneObject::kPrimitives:
      return decoder_.model(object.primitives(), where + ".primitives");
    case proto::SceneObject::kHeights:
    case proto::SceneObject::kVolume:
    case proto::SceneObject::kCloud:
    case proto::SceneObject::kImplicit:
    case proto::SceneObject::SHAPE_NOT_SET:
      break;
  }
  fail(where,
       where + ": an object needs a file, a builtin, primitives, heights, a volume, a cloud or an implicit surface");
}

std::optional<Rgb> SceneFile::colourOf(const proto::SceneObject& object, const std::string& where) const {
  const std::string at = where + ".colour";
  if (object.colour_size() == 0) return {};
  if (object.colour_size() != 3) fail(at, at + " must hold 3 numbers: red, green and blue");
  return decoder_.colours(object.colour(), at).front();
}

// None: it says of no picture.
Appearance SceneFile::pictureOn(const proto::SceneObject& object, bool has_texcoords, const std::string& where) {
  if (object.picture().empty()) return {};
  const std::string at = where + ".picture";
  if (options_.alone) fail(at, at + ": " + kAlone);
  if (!has_texcoords) fail(at, at + ": it has no texture coordinates, over which a picture could lie");
  Appearance appearance;
  try {
    const auto [picture, fresh] = pictures_.try_emplace(object.picture());
    if (fresh) picture->second = loadPicture((folder_ / object.picture()).string());
    appearance.pictures.push_back({picture->second});
  } catch (const Error& error) {
    fail(at, at + ": " + error.what());
  }
  appearance.paints = {{colourOf(object, where).value_or(kWhite), 0}};
  return appearance;
}

// In the place of what its own file says.
void SceneFile::paint(const proto::SceneObject& object, const std::string& where, Model& part) {
  const std::optional<Rgb> colour = colourOf(object, where);
  Appearance appearance = pictureOn(object, !part.texcoords.empty(), where);
  if (colour && appearance.paints.empty()) appearance.paints = {{*colour, {}}};
  if (appearance.paints.empty()) return;
  appearance.triangle_paints.assign(part.triangles.size(), 0);
  part.appearance = std::move(appearance);
}

void SceneFile::setMaterial(const proto::SceneObject& object, const std::string& where, const Model& whole,
                            SceneSurface& surface) {
  const std::string at = where + ".material";
  if (object.material().textures_size() > 0 && !surface.source->hasTexcoords())
    fail(at + ".textures",
         at + ": volumes, clouds and implicit surfaces have no texture coordinates, and take no textures");
  surface.repeat = repeatOf(object.material());
  surface.material = materialOn({true, true, surface.repeat.cwiseAbs()}, object, where, whole);
  surface.textures = ownTextures(surface.material, whole);
}

// What a reader had to say of the object.
void addWarnings(const std::vector<std::string>& warnings, const proto::SceneObject& object, Model& whole) {
  const std::string name = object.name().empty() ? "" : object.name() + ": ";
  for (const std::string& warning : warnings) whole.warnings.push_back(name + warning);
}

// A surface stays what it is: it is no part of the one model.
void SceneFile::addSurfaces(const proto::SceneObject& object, const std::string& where, SceneModel& scene) {
  const std::string at = where + "." + SceneSurfaces::fieldOf(object);
  if (object.has_body()) fail(where + ".body", where + ".body: only what is made of triangles can be a body");
  if (options_.alone && !SceneSurfaces::fileOf(object).empty()) fail(at + ".file", at + ".file: " + kAlone);
  const Placement placement = placementOf(object.transform(), where + ".transform");
  std::vector<SceneSurface> surfaces;
  try {
    surfaces = surfaces_.read(object);
    addWarnings(surfaces_.takeWarnings(), object, scene.model);
    for (SceneSurface& surface : surfaces) surface.source = surface.source->placed(placement.linear, placement.offset);
  } catch (const Error& error) {
    fail(at, at + ": " + error.what());
  }
  for (SceneSurface& surface : surfaces) {
    const std::string name = object.name().empty() ? where : object.name();
    surface.name = surfaces.size() == 1 ? name : name + " " + surface.name;
    surface.colour = colourOf(object, where);
    surface.appearance = pictureOn(object, surface.source->hasTexcoords(), where);
    if (object.has_material() || !object.has_builtin()) setMaterial(object, where, scene.model, surface);
    scene.surfaces.push_back(std::move(surface));
  }
  for (SnapSpec& snap : snapsOf(object, placement, where)) scene.snaps.push_back(std::move(snap));
  for (FieldSpec& field : fieldsOf(object, placement, where)) scene.fields.push_back(std::move(field));
}

// A factor that is left out reads as 0, and 0 itself means nothing: both are 1.
Placement scaleOf(const proto::Transform& in) {
  const Vec3 scale = vecOf(in.scale());
  return {(scale.array() == 0).select(1.0, scale).matrix().asDiagonal(), Vec3::Zero()};
}

Pose SceneFile::poseOf(const proto::Transform& in, const std::string& where) const {
  Pose pose;
  if (in.degrees() != 0) {
    const std::optional<Vec3> axis = unitOf(vecOf(in.axis()));
    if (!axis) fail(where + ".axis", where + ".axis must not be zero when degrees are given");
    pose.rotation = Eigen::AngleAxisd(in.degrees() * M_PI / 180, *axis).toRotationMatrix();
  }
  pose.origin = decoder_.checked(in.translate(), kFarthest_m, where + ".translate");
  return pose;
}

Placement SceneFile::placementOf(const proto::Transform& in, const std::string& where) const {
  Placement placement = scaleOf(in);
  const Pose pose = poseOf(in, where);
  if (in.degrees() != 0) placement.linear = pose.rotation * placement.linear;
  if (!(std::abs(placement.linear.determinant()) > 0)) fail(where + ".scale", where + ".scale is too small");
  placement.offset = pose.origin;
  return placement;
}

// In a frame in which `placement` puts them.
SnapList SceneFile::snapsOf(const proto::SceneObject& object, const Placement& placement,
                            const std::string& where) const {
  return placed(decoder_.snaps(object.snaps(), where + ".snaps"), placement);
}

FieldList SceneFile::fieldsOf(const proto::SceneObject& object, const Placement& placement,
                              const std::string& where) const {
  return placed(decoder_.fields(object.fields(), where + ".fields"), placement);
}

void SceneFile::addAtRest(Model part, const proto::SceneObject& object, const std::string& where, SceneModel& scene) {
  Model& whole = scene.model;
  const Placement placement = placementOf(object.transform(), where + ".transform");
  placeModel(part, placement);
  whole.materials.push_back(materialOn(roomOn(part), object, where, whole));
  appendPart(whole, part, static_cast<std::uint16_t>(whole.materials.size() - 1));
  addWarnings(part.warnings, object, whole);
  for (SnapSpec& snap : snapsOf(object, placement, where)) scene.snaps.push_back(std::move(snap));
  for (FieldSpec& field : fieldsOf(object, placement, where)) scene.fields.push_back(std::move(field));
}

SceneBody SceneFile::bodyOf(Model part, const proto::SceneObject& object, const std::string& where,
                            const Model& whole) {
  SceneBody body;
  body.name = object.name().empty() ? where : object.name();
  placementOf(object.transform(), where + ".transform");  // refuses what flattens it
  placeModel(part, scaleOf(object.transform()));
  body.pose = poseOf(object.transform(), where + ".transform");
  body.spec = mechanics_.body(object, where);
  body.snaps = snapsOf(object, scaleOf(object.transform()), where);
  body.fields = fieldsOf(object, scaleOf(object.transform()), where);
  body.model = std::move(part);
  body.model.materials.assign(1, materialOn(roomOn(body.model), object, where, whole));
  for (auto* list : {&body.model.triangle_materials, &body.model.segment_materials, &body.model.point_materials})
    list->clear();
  body.model.textures = ownTextures(body.model.materials.front(), whole);
  return body;
}

void SceneFile::checkPlaces(const SceneModel& scene) const {
  const auto check = [&](std::size_t count, std::size_t most, const char* what) {
    if (count > most) fail("objects", fmt::format("there are {} {} in it, and at most {} can be", count, what, most));
  };
  std::size_t snap_points = pointsIn(scene.snaps), field_points = pointsIn(scene.fields);
  for (const SceneBody& body : scene.bodies) {
    snap_points += pointsIn(body.snaps);
    field_points += pointsIn(body.fields);
  }
  check(snapsIn(scene), kMaxSnaps, "snaps");
  check(snap_points, kMaxSnapPoints, "points of snaps");
  check(fieldsIn(scene), kMaxFields, "fields");
  check(field_points, kMaxSnapPoints, "points of fields");
}

SceneModel SceneFile::build() {
  checkFinite(scene_, "");
  const bool absent = scene_.units() == 0 && !lines_.has("units");
  const double units = absent ? 1 : decoder_.checked(scene_.units(), 1e-9, 1e9, "units");
  if (scene_.objects_size() > kMaxObjects) throw Error(path_ + ": there are more than 60000 objects in it");
  SceneModel scene;
  Model& whole = scene.model;
  whole.name = fs::path(path_).filename().string();
  whole.materials.clear();
  for (int i = 0; i < scene_.textures_size(); ++i) addTexture(whole, scene_.textures(i), pathOf("textures", i));
  if (scene_.objects_size() == 0) fail("objects", "there are no objects in it");
  if (scene_.has_gravity_m_s2())
    scene.mechanics.gravity_m_s2 = decoder_.checked(scene_.gravity_m_s2(), body_limits::kMaxGravity_m_s2, "gravityMS2");
  std::size_t primitives = 0;
  for (int i = 0; i < scene_.objects_size(); ++i) {
    const proto::SceneObject& object = scene_.objects(i);
    const std::string where = pathOf("objects", i);
    meshingOf(object, where);  // refuses what is for none
    if (SceneSurfaces::has(object)) {
      addSurfaces(object, where, scene);
      continue;
    }
    Model part = shapeOf(object, where);
    primitives += part.elements();
    if (primitives > options_.most_primitives)
      fail(where, fmt::format("with {} the scene has more than {} primitives", where, options_.most_primitives));
    repeatTexcoords(part, repeatOf(object.material()));
    paint(object, where, part);
    if (object.has_body())
      scene.bodies.push_back(bodyOf(std::move(part), object, where, whole));
    else
      addAtRest(std::move(part), object, where, scene);
  }
  if (whole.materials.empty()) whole.materials.emplace_back();
  checkPlaces(scene);
  mechanics_.addJoints(scene_, scene);
  scaleModel(scene, units);
  mechanics_.check(scene_, scene);
  notes_.forEach(
      lines_, [&](std::size_t line, const std::string& message) { whole.warnings.push_back(lineAt(line, message)); });
  return scene;
}

}  // namespace

bool isSceneFile(const std::string& path) { return path.ends_with(".hl.json"); }

SceneModel loadSceneFile(const std::string& path, const LoadOptions& options) {
  return SceneFile(path, options).build();
}

}  // namespace hl
