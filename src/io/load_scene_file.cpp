#include "io/load_scene_file.h"

#include <fmt/core.h>
#include <google/protobuf/util/json_util.h>
#include <hl.pb.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "base/error.h"
#include "builtin.h"
#include "io/json_lines.h"
#include "io/load_image.h"
#include "io/scene_builder.h"

namespace hl {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 20;
constexpr double kAny = std::numeric_limits<double>::max();
constexpr int kMostObjects = 60'000;  // materials are counted in 16 bits

std::string readText(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) throw Error(path + ": there is no such file");
  if (fs::file_size(path, error) > kMostBytes) throw Error(path + ": is larger than 64 MB; put meshes in model files");
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

Vec3 vecOf(const proto::Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::string item(const std::string& list, int index) { return list + "[" + std::to_string(index) + "]"; }

Texture textureOf(const proto::Texels& in) {
  if (in.width() == 0 || in.height() == 0 || std::uint64_t{in.width()} * in.height() != in.values().size())
    throw Error("texels must hold width x height bytes, at least one");
  Texture texture;
  texture.width = in.width();
  texture.height = in.height();
  texture.texels.reserve(in.values().size());
  for (const char byte : in.values())
    texture.texels.push_back(static_cast<float>(static_cast<unsigned char>(byte)) / 255.0f);
  return texture;
}

// One scene file on its way to a model. Paths name the JSON values that errors point at.
class SceneFile {
 public:
  SceneFile(const std::string& path, const LoadOptions& options)
      : path_(path),
        folder_(fs::path(path).parent_path()),
        options_(options),
        text_(readText(path)),
        lines_(path, text_) {
    parse();
  }

  Model build();

 private:
  // Names from the file may hold anything; the message stays one line.
  [[noreturn]] void fail(const std::string& where, std::string message) const {
    std::replace_if(
        message.begin(), message.end(), [](unsigned char c) { return c < ' '; }, '?');
    throw Error(path_ + ":" + std::to_string(lines_.lineOf(where)) + ": " + message);
  }
  void parse();
  void checkFinite(const google::protobuf::Message& message, const std::string& where) const;
  double checked(double value, double least, double most, const std::string& where) const;
  void addTexture(Model& model, const proto::TextureImage& in, const std::string& where);
  Material materialOf(const proto::Material& in, const std::string& where) const;
  TextureUse textureUseOf(const proto::MaterialTexture& in, const std::string& where) const;
  Model shapeOf(const proto::SceneObject& object, const std::string& where);
  Model fileModel(const std::string& name, const std::string& where);
  Model primitivesOf(const proto::Primitives& in, const std::string& where) const;
  void addPolygons(Model& model, const proto::Primitives& in, const std::string& where) const;
  Placement placementOf(const proto::Transform& in, const std::string& where) const;
  std::uint32_t indexOf(const Model& model, std::uint32_t index, const std::string& where) const;

  const std::string path_;
  const fs::path folder_;
  const LoadOptions& options_;
  const std::string text_;
  const JsonLines lines_;
  proto::Scene scene_;
  std::map<std::string, std::uint32_t> textures_;
  std::map<std::string, Model> files_;  // read once, however many objects show them
};

// Protobuf's errors read "(objects[0].material) stifness: Cannot find field." or "(objects[0].file): invalid value 3".
void SceneFile::parse() {
  const auto status = google::protobuf::util::JsonStringToMessage(text_, &scene_);
  if (status.ok()) return;
  std::string message(status.message());
  message = message.substr(0, message.find('\n'));
  const std::size_t open = message.find('('), close = message.find(')');
  if (open != 0 || close == std::string::npos) {
    const std::size_t colon = message.find(": Cannot find field");
    fail(colon == std::string::npos ? "" : message.substr(0, colon), message);
  }
  std::string where = message.substr(1, close - 1);
  std::string rest = message.substr(close + 1);
  const std::size_t colon = rest.find(':');
  if (rest.starts_with(' ') && colon != std::string::npos) where += "." + rest.substr(1, colon - 1);
  fail(where, where + rest.substr(colon == std::string::npos ? 0 : colon));
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
        field->is_repeated() ? checkFinite(reflection->GetRepeatedMessage(message, field, i), item(at, i))
                             : checkFinite(reflection->GetMessage(message, field), at);
      } else if (field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE) {
        const double value = field->is_repeated() ? reflection->GetRepeatedDouble(message, field, i)
                                                  : reflection->GetDouble(message, field);
        if (!std::isfinite(value)) fail(at, at + " must be a finite number");
      }
    }
  }
}

double SceneFile::checked(double value, double least, double most, const std::string& where) const {
  if (value >= least && value <= most) return value;
  if (most == kAny) fail(where, fmt::format("{} must be at least {}", where, least));
  fail(where, fmt::format("{} must be between {} and {}", where, least, most));
}

void SceneFile::addTexture(Model& model, const proto::TextureImage& in, const std::string& where) {
  if (in.name().empty()) fail(where, where + ": a texture needs a name");
  if (textures_.contains(in.name())) fail(where, where + ": there are two textures of the name '" + in.name() + "'");
  Texture texture;
  try {
    if (in.source_case() == proto::TextureImage::kFile) {
      texture = loadImage((folder_ / in.file()).string());
    } else if (in.source_case() == proto::TextureImage::kProcedural) {
      const proto::ProceduralTexture& p = in.procedural();
      const std::size_t size = p.size() == 0 ? 64 : p.size();
      if (size > 8192) fail(where, where + ".procedural.size must be at most 8192");
      const double duty = checked(p.has_duty() ? p.duty() : 0.5, 0, 1, where + ".procedural.duty");
      texture = makeTexture(p.kind(), size, duty);
    } else if (in.source_case() == proto::TextureImage::kTexels) {
      texture = textureOf(in.texels());
    } else {
      fail(where, where + ": a texture needs a file, a procedural or texels");
    }
  } catch (const Error& error) {
    if (std::string(error.what()).starts_with(path_)) throw;
    fail(where, error.what());
  }
  if (!proto::Wrap_IsValid(in.wrap())) fail(where + ".wrap", where + ".wrap must be REPEAT or CLAMP");
  if (!proto::Filter_IsValid(in.filter())) fail(where + ".filter", where + ".filter must be BILINEAR or NEAREST");
  texture.name = in.name();
  texture.wrap = in.wrap() == proto::CLAMP ? Wrap::kClamp : Wrap::kRepeat;
  if (in.has_filter()) texture.filter = in.filter() == proto::NEAREST ? Filter::kNearest : Filter::kBilinear;
  textures_[in.name()] = static_cast<std::uint32_t>(model.textures.size());
  model.textures.push_back(std::move(texture));
}

TextureUse SceneFile::textureUseOf(const proto::MaterialTexture& in, const std::string& where) const {
  const auto found = textures_.find(in.texture());
  if (found == textures_.end()) fail(where, where + ": there is no texture '" + in.texture() + "' in this scene");
  if (!proto::Quantity_IsValid(in.quantity())) fail(where + ".quantity", where + ".quantity is none that HL knows");
  const bool height = in.quantity() == proto::HEIGHT;
  if (height && !in.has_high()) fail(where, where + ": a bump map needs high, its amplitude in metres");
  const double most = in.quantity() == proto::STIFFNESS ? 1 : kAny;
  const double least = height ? -kAny : 0;
  return {found->second, checked(in.low(), least, most, where + ".low"),
          checked(in.has_high() ? in.high() : 1, least, most, where + ".high")};
}

Material SceneFile::materialOf(const proto::Material& in, const std::string& where) const {
  Material material;
  if (!proto::Shade_IsValid(in.shade())) fail(where + ".shade", where + ".shade must be SMOOTH or FLAT");
  material.stiffness = checked(in.has_stiffness() ? in.stiffness() : 1, 0, 1, where + ".stiffness");
  material.static_friction = checked(in.static_friction(), 0, kAny, where + ".staticFriction");
  material.dynamic_friction = checked(in.dynamic_friction(), 0, kAny, where + ".dynamicFriction");
  material.viscosity_Ns_m = checked(in.viscosity_ns_m(), 0, kAny, where + ".viscosityNsM");
  material.stribeck_m_s = checked(in.stribeck_m_s(), 0, kAny, where + ".stribeckMS");
  material.presliding_N_m = checked(in.presliding_n_m(), 0, kAny, where + ".preslidingNM");
  material.smooth = in.shade() == proto::SMOOTH;
  for (int i = 0; i < in.textures_size(); ++i) {
    const std::string at = item(where + ".textures", i);
    const TextureUse use = textureUseOf(in.textures(i), at);
    TextureUse& slot = material.textureOf(static_cast<Quantity>(in.textures(i).quantity()));
    if (slot.used()) fail(at, at + ": there are two textures of one quantity");
    slot = use;
  }
  return material;
}

Model SceneFile::fileModel(const std::string& name, const std::string& where) {
  if (isSceneFile(name)) fail(where, where + ": a scene file cannot hold another");
  const auto found = files_.find(name);
  if (found != files_.end()) return found->second;
  try {
    return files_[name] = loadModel((folder_ / name).string(), options_);
  } catch (const Error& error) {
    fail(where, error.what());
  }
}

std::uint32_t SceneFile::indexOf(const Model& model, std::uint32_t index, const std::string& where) const {
  if (index < model.positions.size()) return index;
  fail(where, where + ": there is no vertex " + std::to_string(index) + "; the last is " +
                  std::to_string(model.positions.size()) + " - 1");
}

// A fan from the first vertex; the vertices keep their normals.
void SceneFile::addPolygons(Model& model, const proto::Primitives& in, const std::string& where) const {
  for (int p = 0; p < in.polygons_size(); ++p) {
    const auto& v = in.polygons(p).vertices();
    const std::string at = item(where + ".polygons", p);
    if (v.size() < 3) fail(at, at + ": a polygon needs three vertices or more");
    for (int i = 2; i < v.size(); ++i)
      model.triangles.push_back({indexOf(model, v[0], at), indexOf(model, v[i - 1], at), indexOf(model, v[i], at)});
  }
}

Model SceneFile::primitivesOf(const proto::Primitives& in, const std::string& where) const {
  const auto multiple = [&](int size, int of, const char* list) {
    const std::string at = where + "." + list;
    if (size % of != 0) fail(at, at + " must hold " + std::to_string(of) + " numbers each");
  };
  multiple(in.vertices_size(), 3, "vertices");
  multiple(in.triangles_size(), 3, "triangles");
  multiple(in.segments_size(), 2, "segments");
  Model model;
  for (int i = 0; i + 2 < in.vertices_size(); i += 3)
    model.positions.emplace_back(in.vertices(i), in.vertices(i + 1), in.vertices(i + 2));
  const int count = in.vertices_size() / 3;
  if (in.normals_size() != 0 && in.normals_size() != 3 * count)
    fail(where + ".normals", where + ".normals must hold 3 numbers for each vertex");
  if (in.texcoords_size() != 0 && in.texcoords_size() != 2 * count)
    fail(where + ".texcoords", where + ".texcoords must hold 2 numbers for each vertex");
  for (int i = 0; i < in.normals_size(); i += 3)
    model.normals.push_back(Vec3(in.normals(i), in.normals(i + 1), in.normals(i + 2)).stableNormalized());
  for (int i = 0; i < in.texcoords_size(); i += 2) model.texcoords.emplace_back(in.texcoords(i), in.texcoords(i + 1));
  const auto at = [&](std::uint32_t index, const char* list) { return indexOf(model, index, where + "." + list); };
  for (int i = 0; i < in.triangles_size(); i += 3)
    model.triangles.push_back(
        {at(in.triangles(i), "triangles"), at(in.triangles(i + 1), "triangles"), at(in.triangles(i + 2), "triangles")});
  for (int i = 0; i < in.segments_size(); i += 2)
    model.segments.push_back({at(in.segments(i), "segments"), at(in.segments(i + 1), "segments")});
  for (const std::uint32_t point : in.points()) model.points.push_back(at(point, "points"));
  addPolygons(model, in, where);
  return model;
}

Model SceneFile::shapeOf(const proto::SceneObject& object, const std::string& where) {
  switch (object.shape_case()) {
    case proto::SceneObject::kFile:
      return fileModel(object.file(), where + ".file");
    case proto::SceneObject::kBuiltin:
      try {
        return makeBuiltinScene(object.builtin());
      } catch (const Error& error) {
        fail(where + ".builtin", error.what());
      }
    case proto::SceneObject::kPrimitives:
      return primitivesOf(object.primitives(), where + ".primitives");
    case proto::SceneObject::SHAPE_NOT_SET:
      break;
  }
  fail(where, where + ": an object needs a file, a builtin or primitives");
}

Placement SceneFile::placementOf(const proto::Transform& in, const std::string& where) const {
  Placement placement;
  // A factor that is left out reads as 0, and 0 itself means nothing: both are 1.
  const Vec3 scale = vecOf(in.scale());
  placement.linear = Vec3((scale.array() == 0).select(1.0, scale)).asDiagonal();
  if (in.degrees() != 0) {
    const Vec3 axis = vecOf(in.axis());
    if (!(axis.norm() > 0)) fail(where + ".axis", where + ".axis must not be zero when degrees are given");
    placement.linear = Eigen::AngleAxisd(in.degrees() * M_PI / 180, axis.normalized()) * placement.linear;
  }
  if (!(std::abs(placement.linear.determinant()) > 0)) fail(where + ".scale", where + ".scale is too small");
  placement.offset = vecOf(in.translate());
  return placement;
}

Model SceneFile::build() {
  checkFinite(scene_, "");
  const double units = scene_.units() == 0 ? 1 : checked(scene_.units(), 1e-9, 1e9, "units");
  if (scene_.objects_size() > kMostObjects) throw Error(path_ + ": there are more than 60000 objects in it");
  Model whole;
  whole.name = fs::path(path_).filename().string();
  whole.materials.clear();
  for (int i = 0; i < scene_.textures_size(); ++i) addTexture(whole, scene_.textures(i), item("textures", i));
  if (scene_.objects_size() == 0) fail("objects", "there are no objects in it");
  for (int i = 0; i < scene_.objects_size(); ++i) {
    const proto::SceneObject& object = scene_.objects(i);
    const std::string where = item("objects", i);
    const proto::Material& material = object.material();
    Model part = shapeOf(object, where);
    if (whole.elements() + part.elements() > options_.most_primitives)
      fail(where, fmt::format("with {} the scene has more than {} primitives", where, options_.most_primitives));
    placeModel(part, placementOf(object.transform(), where + ".transform"));
    repeatTexcoords(part, material.has_repeat_u() ? material.repeat_u() : 1,
                    material.has_repeat_v() ? material.repeat_v() : 1);
    whole.materials.push_back(materialOf(material, where + ".material"));
    appendPart(whole, part, static_cast<std::uint16_t>(whole.materials.size() - 1));
    for (const std::string& warning : part.warnings) whole.warnings.push_back(object.name() + ": " + warning);
  }
  scaleModel(whole, units);
  return whole;
}

}  // namespace

bool isSceneFile(const std::string& path) { return path.ends_with(".hl.json"); }

Model loadSceneFile(const std::string& path, const LoadOptions& options) { return SceneFile(path, options).build(); }

}  // namespace hl
