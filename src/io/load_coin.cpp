// VRML 1.0, VRML 97 and Inventor files through Coin, which turns every shape into triangles, lines and points.
#include <Inventor/SbLinear.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLCoordinate.h>
#include <Inventor/VRMLnodes/SoVRMLIndexedShape.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/elements/SoCoordinateElement.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/nodes/SoIndexedShape.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShape.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

#include "base/error.h"
#include "io/load_model.h"
#include "io/sandbox.h"

namespace hl {

namespace {

struct Collector {
  Model model;
  SbMatrix to_world;
  SbMatrix normal_to_world;
  int left_out = 0;  // shapes whose indices are beyond their points
};

std::string first_read_error;

void keepFirstError(const SoError* error, void*) {
  if (first_read_error.empty()) first_read_error = error->getDebugString().getString();
}

// Coin would read what lies behind the points.
bool hasItsPoints(SoCallbackAction& action, const SoNode& node) {
  const SoMFInt32* indices = nullptr;
  int points = 0;
  if (node.isOfType(SoVRMLIndexedShape::getClassTypeId())) {
    const auto& shape = static_cast<const SoVRMLIndexedShape&>(node);
    const SoNode* const coordinate = shape.coord.getValue();
    indices = &shape.coordIndex;
    if (coordinate != nullptr && coordinate->isOfType(SoVRMLCoordinate::getClassTypeId()))
      points = static_cast<const SoVRMLCoordinate*>(coordinate)->point.getNum();
  } else if (node.isOfType(SoIndexedShape::getClassTypeId())) {
    indices = &static_cast<const SoIndexedShape&>(node).coordIndex;
    points = SoCoordinateElement::getInstance(action.getState())->getNum();
  }
  if (indices == nullptr) return true;
  const std::int32_t* const begin = indices->getValues(0);
  return std::all_of(begin, begin + indices->getNum(), [&](std::int32_t i) { return i >= -1 && i < points; });
}

SoCallbackAction::Response beforeShape(void* data, SoCallbackAction* action, const SoNode* node) {
  auto& collector = *static_cast<Collector*>(data);
  if (!hasItsPoints(*action, *node)) {
    ++collector.left_out;
    return SoCallbackAction::PRUNE;
  }
  collector.to_world = action->getModelMatrix();
  collector.normal_to_world = collector.to_world.inverse().transpose();
  return SoCallbackAction::CONTINUE;
}

// Of the material there; textures are left out.
Rgb colourOf(SoCallbackAction& action, const SoPrimitiveVertex& vertex) {
  SbColor ambient, diffuse, specular, emission;
  float shininess = 0, transparency = 0;
  action.getMaterial(ambient, diffuse, specular, emission, shininess, transparency, vertex.getMaterialIndex());
  return {colourByte(diffuse[0]), colourByte(diffuse[1]), colourByte(diffuse[2])};
}

std::uint32_t addVertex(Collector& collector, SoCallbackAction& action, const SoPrimitiveVertex* vertex) {
  SbVec3f position;
  SbVec3f normal;
  collector.to_world.multVecMatrix(vertex->getPoint(), position);
  collector.normal_to_world.multDirMatrix(vertex->getNormal(), normal);
  Model& model = collector.model;
  model.positions.emplace_back(position[0], position[1], position[2]);
  const Vec3 n = Vec3(normal[0], normal[1], normal[2]).normalized();
  model.normals.push_back(n.allFinite() ? n : Vec3(Vec3::Zero()));
  model.texcoords.emplace_back(vertex->getTextureCoords()[0], vertex->getTextureCoords()[1]);
  model.appearance.vertex_colours.push_back(colourOf(action, *vertex));
  return static_cast<std::uint32_t>(model.positions.size() - 1);
}

void addTriangle(void* data, SoCallbackAction* action, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b,
                 const SoPrimitiveVertex* c) {
  auto& collector = *static_cast<Collector*>(data);
  const std::uint32_t first = addVertex(collector, *action, a);
  addVertex(collector, *action, b);
  addVertex(collector, *action, c);
  collector.model.triangles.push_back({first, first + 1, first + 2});
}

void addSegment(void* data, SoCallbackAction* action, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b) {
  auto& collector = *static_cast<Collector*>(data);
  const std::uint32_t first = addVertex(collector, *action, a);
  addVertex(collector, *action, b);
  collector.model.segments.push_back({first, first + 1});
}

void addPoint(void* data, SoCallbackAction* action, const SoPrimitiveVertex* a) {
  auto& collector = *static_cast<Collector*>(data);
  collector.model.points.push_back(addVertex(collector, *action, a));
}

}  // namespace

Model parseWithCoin(const ModelFile& file, const std::function<void(double)>& report) {
  SoDB::init();
  SoReadError::setHandlerCallback(keepFirstError, nullptr);
  SoInput input;
  if (!input.openFile(file.path.c_str(), true)) throw Error("cannot be opened");
  if (file.alone && !forbidOpening()) throw Error(kNoFilters);
  SoSeparator* root = SoDB::readAll(&input);
  if (root == nullptr)
    throw Error("cannot be understood: " + (first_read_error.empty() ? "no VRML" : first_read_error));
  report(0.5);
  root->ref();
  Collector collector;
  SoCallbackAction action;
  action.addPreCallback(SoShape::getClassTypeId(), beforeShape, &collector);
  action.addTriangleCallback(SoShape::getClassTypeId(), addTriangle, &collector);
  action.addLineSegmentCallback(SoShape::getClassTypeId(), addSegment, &collector);
  action.addPointCallback(SoShape::getClassTypeId(), addPoint, &collector);
  action.apply(root);
  if (collector.left_out > 0)
    collector.model.warnings.push_back(
        fmt::format("skipped {} shapes with indices of points that do not exist", collector.left_out));
  if (!first_read_error.empty()) collector.model.warnings.push_back("parts were not understood: " + first_read_error);
  return std::move(collector.model);
}

}  // namespace hl
