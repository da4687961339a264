// Model files through assimp: the scene graph flattened into one model.
#include <assimp/config.h>
#include <assimp/scene.h>
#include <fcntl.h>
#include <fmt/core.h>

#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/plain_file.h"
#include "geometry/polygon.h"
#include "io/bone_pose.h"
#include "io/check_ply.h"
#include "io/clean_obj.h"
#include "io/gltf_haptics.h"
#include "io/load_model.h"
#include "io/mapped_file.h"
#include "io/only_file.h"
#include "io/own_folder.h"
#include "io/plain_gltf.h"
#include "io/plain_off.h"
#include "io/plain_stl.h"
#include "io/read_appearance.h"
#include "io/sandbox.h"
#include "io/text_words.h"
#include "io/x3d_bodies.h"
#include "io/x3d_document.h"
#include "io/x3d_inlines.h"
#include "io/x3d_plain.h"
#include "io/x3d_prototypes.h"

namespace hl {

namespace {

constexpr unsigned kAsWritten = 0;  // for assimp: no steps after reading
constexpr int kDeepestNode = 1000;  // deeper nesting is an attack on the stack, not a model

class Progress final : public Assimp::ProgressHandler {
 public:
  explicit Progress(const std::function<void(double)>& report) : report_(report) {}
  bool Update(float fraction) override {
    if (fraction >= last_ + 0.01f) {
      last_ = fraction;
      report_(fraction);
    }
    return true;
  }

 private:
  const std::function<void(double)>& report_;
  float last_ = 0;
};

Vec3 vecOfAssimp(const aiVector3D& v) { return {v.x, v.y, v.z}; }

void appendPolygon(Model& model, const aiMesh& mesh, const aiFace& face, std::uint32_t base) {
  const std::span<const unsigned> indices(face.mIndices, face.mNumIndices);
  std::vector<Vec3> corners;
  for (const unsigned index : indices) corners.push_back(vecOfAssimp(mesh.mVertices[index]));
  for (const auto& [a, b, c] : trianglesOf(corners))
    model.triangles.push_back({base + indices[a], base + indices[b], base + indices[c]});
}

void appendFaces(Model& model, const aiMesh& mesh, std::uint32_t base, std::uint16_t material) {
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    const auto at = [&](unsigned k) { return base + face.mIndices[k]; };
    if (face.mNumIndices > 3) appendPolygon(model, mesh, face, base);
    if (face.mNumIndices == 3) model.triangles.push_back({at(0), at(1), at(2)});
    if (face.mNumIndices == 2) model.segments.push_back({at(0), at(1)});
    if (face.mNumIndices == 1) model.points.push_back(at(0));
  }
  model.triangle_materials.resize(model.triangles.size(), material);
  model.segment_materials.resize(model.segments.size(), material);
  model.point_materials.resize(model.points.size(), material);
}

void appendTexcoord(Model& model, const aiMesh& mesh, unsigned vertex) {
  const bool has = mesh.HasTextureCoords(0);
  model.texcoords.emplace_back(has ? mesh.mTextureCoords[0][vertex].x : 0, has ? mesh.mTextureCoords[0][vertex].y : 0);
}

// Where a vertex comes to be. Normals turn with the inverse transpose; a mirrored node keeps its winding, which does
// not matter to two-sided touch.
struct VertexPlace {
  explicit VertexPlace(const BentVertex& to_scene)
      : linear(to_scene.leftCols<3>()), offset(to_scene.col(3)), for_normals(linear.inverse().transpose()) {}

  Mat3 linear;
  Vec3 offset;
  Mat3 for_normals;
};

Vec3 turnedNormal(const aiMesh& mesh, unsigned vertex, const Mat3& for_normals) {
  if (!mesh.HasNormals()) return Vec3::Zero();
  const Vec3 normal = (for_normals * vecOfAssimp(mesh.mNormals[vertex])).normalized();
  return normal.allFinite() ? normal : Vec3(Vec3::Zero());
}

// `place_of(i)` is the VertexPlace of the vertex i.
template <typename PlaceOf>
void appendMesh(Model& model, const aiMesh& mesh, std::uint16_t material, const PlaceOf& place_of) {
  const auto base = static_cast<std::uint32_t>(model.positions.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const VertexPlace& place = place_of(i);
    model.positions.push_back(place.linear * vecOfAssimp(mesh.mVertices[i]) + place.offset);
    model.normals.push_back(turnedNormal(mesh, i, place.for_normals));
    appendTexcoord(model, mesh, i);
  }
  appendFaces(model, mesh, base, material);
}

void appendRigid(Model& model, const aiMesh& mesh, std::uint16_t material, const Eigen::Matrix4d& to_world) {
  const VertexPlace place(to_world.topRows<3>());
  appendMesh(model, mesh, material, [&](unsigned) -> const VertexPlace& { return place; });
}

void appendBent(Model& model, const aiMesh& mesh, std::uint16_t material, const std::vector<BentVertex>& bent) {
  appendMesh(model, mesh, material, [&](unsigned vertex) { return VertexPlace(bent[vertex]); });
}

// A file on its way into a model.
struct Import {
  const aiScene& scene;
  const GltfHaptics& haptics;
  Model& model;
  AppearanceReader& appearance;
  const BonePose* bones;  // null: of files whose bones assimp does not place where their nodes are
};

// A node without a material of its own has that of its parent.
void appendNode(Import& import, const aiNode& node, const Eigen::Matrix4d& parent, std::uint16_t material, int depth) {
  if (depth > kDeepestNode) throw Error("its nodes are nested too deep");
  const Eigen::Matrix4d to_world = parent * matrixOfAssimp(node.mTransformation);
  const auto own = import.haptics.material_of_node.find(node.mName.C_Str());
  if (own != import.haptics.material_of_node.end()) material = static_cast<std::uint16_t>(own->second);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *import.scene.mMeshes[node.mMeshes[i]];
    const std::size_t before = import.model.triangles.size();
    if (mesh.HasBones() && import.bones != nullptr)
      appendBent(import.model, mesh, material, import.bones->bend(mesh, to_world));
    else
      appendRigid(import.model, mesh, material, to_world);
    import.appearance.add(mesh, import.model.triangles.size() - before);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    appendNode(import, *node.mChildren[i], to_world, material, depth + 1);
}

bool isGltf(const ModelFile& file) { return file.ending == ".gltf" || file.ending == ".glb"; }

GltfHaptics hapticsOf(const ModelFile& file) {
  if (!isGltf(file)) return {};
  return readGltfHaptics(gltfJson(file.path), file.path, file.alone);
}

// Lists that would say "material 0" for every element are left out.
void addHaptics(Model& model, GltfHaptics&& haptics) {
  model.warnings.insert(model.warnings.end(), haptics.warnings.begin(), haptics.warnings.end());
  if (haptics.materials.size() == 1) {
    model.triangle_materials.clear();
    model.segment_materials.clear();
    model.point_materials.clear();
  }
  model.materials = std::move(haptics.materials);
  model.textures = std::move(haptics.textures);
}

bool anyMesh(const aiScene& scene, bool (*has)(const aiMesh&)) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    if (has(*scene.mMeshes[i])) return true;
  }
  return false;
}

std::string listOf(const std::set<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

// assimp's words about a file that it knows by another name.
std::string saidOf(const ModelFile& file, std::string text) {
  const std::string alias = OnlyFile::nameOf(file.ending);
  const std::string name = file.name.empty() ? "the file" : file.name;
  for (std::size_t at = 0; file.alone && (at = text.find(alias, at)) != std::string::npos; at += name.size())
    text.replace(at, alias.size(), name);
  return text;
}

// What the file's reader is to find in its place; nothing: the file as it is. assimp also refuses an OBJ file of less
// than 16 bytes, which one point is: such a file gets blank lines at its end.
std::optional<std::string> inPlaceOf(const ModelFile& file, std::vector<std::string>& warnings) {
  constexpr std::size_t kMinObj = 16;
  if (file.ending == ".off") return plainOff(MappedFile(file.path).bytes(), warnings);
  if (file.ending == ".stl") return plainStl(MappedFile(file.path).bytes(), warnings);
  if (isGltf(file)) return plainGltf(file, warnings);
  if (file.ending != ".obj" && file.ending != ".x3d") return std::nullopt;
  const std::string text = contentOf(file.path).value_or("");
  if (file.ending == ".x3d" && text.size() > kMaxX3dBytes) return std::nullopt;
  if (file.ending == ".x3d") return withInlines(file, withoutPrototypes(text, warnings), warnings);
  std::optional<std::string> cleaned = cleanedObj(text);
  if ((cleaned ? *cleaned : text).size() >= kMinObj) return cleaned;
  return cleaned.value_or(text) + std::string(kMinObj, '\n');
}

// The file by its descriptor; from then on nothing else can be opened.
const aiScene* readAlone(Assimp::Importer& importer, const ModelFile& file, std::optional<std::string>&& text,
                         Model& model) {
  const int descriptor = open(file.path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw Error("cannot be opened");
  if (!forbidOpening()) throw Error(kNoFilters);
  auto* only = new OnlyFile(descriptor, file.ending);
  if (text) only->replace(std::move(*text));
  importer.SetIOHandler(only);  // owned by the importer
  const aiScene* scene = importer.ReadFile(only->name(), kAsWritten);
  if (only->missing().empty()) return scene;
  const std::string missing = listOf(only->missing());
  if (scene == nullptr)
    throw Error("needs " + missing + ", and a file comes alone: put all into one, a .glb for example");
  model.warnings.push_back("comes alone, without " + missing);
  return scene;
}

// `refused`: of OwnFolder; `read`: the file made sense without it.
void reportRefused(const std::string& refused, bool read, Model& model) {
  if (refused.empty()) return;
  const std::string name = shown(std::filesystem::path(refused).filename().string());
  if (!read) throw Error(fmt::format("names '{}', which is not in its folder: put that file beside it", name));
  model.warnings.push_back(fmt::format("names '{}', which is not in its folder and is left out", name));
}

const aiScene* readScene(Assimp::Importer& importer, OwnFolder& folder, const ModelFile& file,
                         std::optional<std::string>&& text, Model& model) {
  if (file.ending == ".ply") checkPly(file.path);
  if (file.alone) return readAlone(importer, file, std::move(text), model);
  if (text) folder.replace(std::move(*text));
  return importer.ReadFile(file.path, kAsWritten);
}

void addScene(const Assimp::Importer& importer, const ModelFile& file, const aiScene* scene, GltfHaptics&& haptics,
              Model& model) {
  if (scene == nullptr && std::string_view(importer.GetErrorString()) == std::bad_alloc().what())
    throw std::bad_alloc();
  if (scene == nullptr) throw Error("cannot be understood: " + saidOf(file, importer.GetErrorString()));
  AppearanceReader appearance(*scene, file);
  const BonePose bones(*scene);
  const bool placed = file.ending != ".mdl";  // of Half-Life
  Import import{*scene, haptics, model, appearance, placed ? &bones : nullptr};
  if (scene->mRootNode != nullptr) appendNode(import, *scene->mRootNode, Eigen::Matrix4d::Identity(), 0, 0);
  model.appearance = appearance.take(model.warnings);
  addHaptics(model, std::move(haptics));
  if (!anyMesh(*scene, [](const aiMesh& m) { return m.HasNormals(); })) model.normals.clear();
  if (!anyMesh(*scene, [](const aiMesh& m) { return m.HasTextureCoords(0); })) model.texcoords.clear();
}

// An X3D file in parts, each a document of its own.
SceneModel readWithBodies(Assimp::Importer& importer, const ModelFile& file, const std::string& text) {
  if (file.alone && !forbidOpening()) throw Error(kNoFilters);
  return readX3dBodies(text, [&](const std::string& document) {
    Model model;
    const std::string plain = plainX3d(document, model.warnings);
    addScene(importer, file, importer.ReadFileFromMemory(plain.data(), plain.size(), kAsWritten, "x3d"), {}, model);
    return model;
  });
}

}  // namespace

bool assimpReads(const std::string& ending) {
  // Coin reads VRML better; assimp's readers of these are for other things than geometry.
  return !ending.empty() && Assimp::Importer().IsExtensionSupported(ending);
}

SceneModel parseWithAssimp(const ModelFile& file, const std::function<void(double)>& report) {
  std::string refused;
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);  // a skeleton without a mesh is nothing to touch
  importer.SetProgressHandler(new Progress(report));                    // owned by the importer
  auto* folder = new OwnFolder(file.path, refused);
  importer.SetIOHandler(folder);  // too; also for what is read from memory
  Model model;
  std::optional<std::string> in_place = inPlaceOf(file, model.warnings);
  if (file.ending == ".x3d" && in_place && speaksOfBodies(*in_place)) {
    SceneModel scene = readWithBodies(importer, file, *in_place);
    scene.model.warnings.insert(scene.model.warnings.begin(), model.warnings.begin(), model.warnings.end());
    return scene;
  }
  if (file.ending == ".x3d" && in_place) in_place = plainX3d(*in_place, model.warnings);
  GltfHaptics haptics = hapticsOf(file);
  const aiScene* scene = readScene(importer, *folder, file, std::move(in_place), model);
  reportRefused(refused, scene != nullptr, model);
  addScene(importer, file, scene, std::move(haptics), model);
  return model;
}

}  // namespace hl
