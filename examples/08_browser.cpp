// A browser for touch: sends a model file to the server. VRML through Coin, X3D, OBJ, glTF and others through assimp;
// shapes get the names 1, 2, .. in their order.
//
//   08_browser FILE [URL [SECONDS]]
#include <Inventor/SbBox.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShape.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <hl/hl.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

// ---- Coin: calls back for each triangle of each shape -------------------------------------------------------------

SoCallbackAction::Response beginShape(void* names, SoCallbackAction* action, const SoNode*) {
  hlLoadName(++*static_cast<HLuint*>(names));
  hlPushMatrix();
  hlMultMatrixf(action->getModelMatrix()[0]);
  hlBegin(HL_TRIANGLES);
  return SoCallbackAction::CONTINUE;
}

void sendTriangle(void*, SoCallbackAction*, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b,
                  const SoPrimitiveVertex* c) {
  for (const SoPrimitiveVertex* vertex : {a, b, c}) {
    hlNormal3fv(vertex->getNormal().getValue());
    hlVertex3fv(vertex->getPoint().getValue());
  }
}

SoCallbackAction::Response endShape(void*, SoCallbackAction*, const SoNode*) {
  hlEnd();
  hlPopMatrix();
  return SoCallbackAction::CONTINUE;
}

SbBox3f sendWithCoin(const std::string& file) {
  SoDB::init();
  SoInput input;
  SoSeparator* root = input.openFile(file.c_str(), true) ? SoDB::readAll(&input) : nullptr;
  if (root == nullptr) throw std::runtime_error(file + " cannot be read");
  root->ref();
  SoCallbackAction action;
  HLuint names = 0;
  action.addPreCallback(SoShape::getClassTypeId(), beginShape, &names);
  action.addTriangleCallback(SoShape::getClassTypeId(), sendTriangle, nullptr);
  action.addPostCallback(SoShape::getClassTypeId(), endShape, nullptr);
  action.apply(root);
  SoGetBoundingBoxAction bounds{SbViewportRegion()};
  bounds.apply(root);
  root->unref();
  return bounds.getBoundingBox();
}

// ---- assimp: gives whole meshes, which are drawn as arrays ----------------------------------------------------------

void sendMesh(const aiMesh& mesh) {
  std::vector<HLuint> indices;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i)
    indices.insert(indices.end(), mesh.mFaces[i].mIndices, mesh.mFaces[i].mIndices + mesh.mFaces[i].mNumIndices);
  const std::size_t numbers = 3UL * mesh.mNumVertices;
  constexpr HLenum kModes[] = {HL_POINTS, HL_LINES, HL_TRIANGLES};
  const HLenum mode = kModes[mesh.mFaces[0].mNumIndices - 1];
  hl::VertexArrays<HLfloat> arrays{{&mesh.mVertices[0].x, numbers}};
  if (mesh.HasNormals()) arrays.normals = {&mesh.mNormals[0].x, numbers};
  hl::drawElements(mode, arrays, indices);
}

SbBox3f sendWithAssimp(const std::string& file) {
  Assimp::Importer importer;
  // One kind of primitives in each mesh, and all of them in the frame of the world.
  const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                                     aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());
  SbBox3f box;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& mesh = *scene->mMeshes[i];
    hlLoadName(i + 1);
    sendMesh(mesh);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) box.extendBy(SbVec3f(&mesh.mVertices[v].x));
  }
  return box;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) throw std::runtime_error("which file? 08_browser FILE [URL [SECONDS]]");
  const std::string file = argv[1], ending = std::filesystem::path(file).extension();
  const std::string url = argc > 2 ? argv[2] : "inproc:";
  const double seconds = argc > 3 ? std::atof(argv[3]) : 10;
  hl::Context context(url);
  context.onEvent(HL_EVENT_TOUCH, [](const HLevent& event) { std::printf("touching: shape %u\n", event.name); });
  const bool vrml = ending == ".wrl" || ending == ".WRL" || ending == ".iv";
  const SbBox3f box = vrml ? sendWithCoin(file) : sendWithAssimp(file);
  const SbVec3f size = box.getMax() - box.getMin(), middle = box.getCenter();
  const double side = std::max({size[0], size[1], size[2]});
  if (box.isEmpty() || !(side > 0)) throw std::runtime_error("there is nothing to touch in " + file);
  // The largest side is 120 mm of the hand, which begins above the model.
  const double scale = side / 0.12;
  hlWorkspaced(middle[0], box.getMax()[1] + 0.02 * scale, middle[2], scale);
  hlProxyd(HL_PROXY_RADIUS, 0.002 * scale);
  hlFinish();
  std::printf("%.0f primitives\n%s\n", hl::get(HL_FRAME_PRIMITIVES), hlGetString(HL_FRAME_WARNINGS));

  for (int i = 0; i < 60 * seconds; ++i) {
    // Nobody holds the simulated device of inproc:, so the program moves its hand over the model, pressing downward.
    const double t = i / 60.0;
    if (url.starts_with("inproc:"))
      hlHandGoal3d(middle[0] + 0.25 * side * std::sin(t), middle[1] - 0.05 * side,
                   middle[2] + 0.25 * side * std::sin(0.7 * t));
    context.poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  hl::check();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "08_browser: %s\n", error.what());
  return 2;
}
