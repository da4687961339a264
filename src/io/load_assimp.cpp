// Model files through assimp: the scene graph flattened into one model.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <memory>

#include "base/error.h"
#include "io/load_model.h"

namespace hl {

namespace {

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

Eigen::Matrix4d matrixOf(const aiMatrix4x4& m) {
  Eigen::Matrix4d out;
  out << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return out;
}

Vec3 vecOf(const aiVector3D& v) { return {v.x, v.y, v.z}; }

void appendFaces(Model& model, const aiMesh& mesh, std::uint32_t base) {
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    const auto at = [&](unsigned k) { return base + face.mIndices[k]; };
    if (face.mNumIndices == 3) model.triangles.push_back({at(0), at(1), at(2)});
    if (face.mNumIndices == 2) model.segments.push_back({at(0), at(1)});
    if (face.mNumIndices == 1) model.points.push_back(at(0));
  }
}

// Normals turn with the inverse transpose; a mirrored node keeps its winding, which does not matter to two-sided touch.
void appendMesh(Model& model, const aiMesh& mesh, const Eigen::Matrix4d& to_world) {
  const auto base = static_cast<std::uint32_t>(model.positions.size());
  const Mat3 linear = to_world.topLeftCorner<3, 3>();
  const Mat3 for_normals = linear.inverse().transpose();
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    model.positions.push_back(linear * vecOf(mesh.mVertices[i]) + to_world.topRightCorner<3, 1>());
    const Vec3 normal =
        mesh.HasNormals() ? Vec3(for_normals * vecOf(mesh.mNormals[i])).normalized() : Vec3(Vec3::Zero());
    model.normals.push_back(normal.allFinite() ? normal : Vec3(Vec3::Zero()));
    model.texcoords.emplace_back(mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][i].x : 0,
                                 mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][i].y : 0);
  }
  appendFaces(model, mesh, base);
}

void appendNode(Model& model, const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& parent, int depth) {
  if (depth > kDeepestNode) throw Error("its nodes are nested too deep");
  const Eigen::Matrix4d to_world = parent * matrixOf(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) appendMesh(model, *scene.mMeshes[node.mMeshes[i]], to_world);
  for (unsigned i = 0; i < node.mNumChildren; ++i) appendNode(model, scene, *node.mChildren[i], to_world, depth + 1);
}

bool anyMesh(const aiScene& scene, bool (*has)(const aiMesh&)) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    if (has(*scene.mMeshes[i])) return true;
  }
  return false;
}

}  // namespace

bool assimpReads(const std::string& ending) {
  // Coin reads VRML better; assimp's readers of these are for other things than geometry.
  return !ending.empty() && Assimp::Importer().IsExtensionSupported(ending);
}

Model parseWithAssimp(const std::string& path, const std::function<void(double)>& report) {
  Assimp::Importer importer;
  importer.SetProgressHandler(new Progress(report));  // owned by the importer
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (scene == nullptr) throw Error(std::string("cannot be understood: ") + importer.GetErrorString());
  Model model;
  if (scene->mRootNode != nullptr) appendNode(model, *scene, *scene->mRootNode, Eigen::Matrix4d::Identity(), 0);
  if (!anyMesh(*scene, [](const aiMesh& m) { return m.HasNormals(); })) model.normals.clear();
  if (!anyMesh(*scene, [](const aiMesh& m) { return m.HasTextureCoords(0); })) model.texcoords.clear();
  return model;
}

}  // namespace hl
