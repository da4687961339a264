#include "io/x3d_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.h"
#include "bodies/mesh_body.h"
#include "io/x3d_document.h"
#include "io/x3d_joints.h"
#include "scene/append_part.h"

namespace hl {

namespace {

bool isCollidable(const X3dNode& node) { return isX3d(node, {"CollidableShape", "CollidableOffset"}); }

/// A shape in the frame of what it is a piece of.
struct ShapePiece {
  const X3dNode* shape = nullptr;
  Pose pose;
};

Pose after(const Pose& outer, const Pose& inner) {
  return {outer.rotation * inner.rotation, outer.toWorld(inner.origin)};
}

class BodiesOfX3d {
 public:
  using Read = std::function<Model(const std::string&)>;
  BodiesOfX3d(const std::string& text, const Read& read) : document_(text), read_(read) {}

  SceneModel build();

 private:
  X3dFields fieldsOf(const X3dNode& node) { return {node, warnings_}; }
  void warn(const X3dNode& node, const std::string& what) { fieldsOf(node).warn(what); }

  void addSurface(const X3dNode& collection);
  void addSurfaceTo(const X3dTree& parent, const BodySurface& surface);
  BodySurface surfaceOf(const X3dTree& collidables) const;

  Pose placeOf(const X3dNode& node, const char* origin, const char* rotation);
  Placement placementOfTransform(const X3dNode& node);
  void addPieces(const X3dNode& collidable, const Pose& outer, std::vector<ShapePiece>& pieces, int depth = 0);
  std::vector<ShapePiece> piecesIn(const X3dNode& body);
  BodyShape kindOf(const X3dNode& shape);
  Model geometryOf(const std::vector<ShapePiece>& pieces);

  void addCollection(const X3dNode& collection);
  void addBody(const X3dNode& node, bool enabled);
  BodySpec specOf(const X3dNode& node, bool enabled);
  void setShape(const X3dNode& node, std::vector<ShapePiece>& pieces, SceneBody& body);
  void setParts(const X3dNode& node, std::size_t shapes, SceneBody& body);
  void checkBody(const X3dNode& node, SceneBody& body);
  void warnOfWhatIsLeftOut(const X3dNode& node);

  void addStanding(const X3dTree& parent, bool in_collections);
  void addStandingOne(const X3dNode& collidable);
  bool hasOtherShapes(const X3dTree& parent) const;
  void takeWhatFollows(const X3dNode& route);

  const X3dDocument document_;
  const Read& read_;
  SceneModel scene_;
  std::vector<std::string> warnings_;
  std::map<const X3dNode*, BodySurface> surfaces_;  // of collidables in a collection
  X3dBodyNumbers body_number_;
  X3dNodes taken_;                          // what is no longer a part of the rest
  std::vector<const X3dNode*> transforms_;  // above what is looked at, from outside
  std::size_t visited_ = 0, too_many_ = 0;
  std::size_t moving_parts_ = 0;  // of the bodies that move
  bool has_gravity_ = false;
};

// The friction of a collection that gives none is HL's, not X3D's, which is 0.
void BodiesOfX3d::addSurface(const X3dNode& collection) {
  const X3dFields fields = fieldsOf(collection);
  BodySurface surface;
  surface.restitution = fields.number("bounce", 0, 0, 1);
  const Vec2 friction =
      fields.pair("frictionCoefficients", Vec2::Constant(surface.dynamic_friction), 0, body_limits::kMaxFriction);
  surface.static_friction = surface.dynamic_friction = friction.x();
  if (friction.x() != friction.y()) fields.warn("the first of its frictionCoefficients holds in all directions");
  for (const char* other : {"slipFactors", "surfaceSpeed"}) {
    if (fields.pair(other, Vec2::Zero(), -1e6, 1e6) != Vec2::Zero()) fields.warn(std::string(other) + " is left out");
  }
  addSurfaceTo(collection.second, surface);
}

void BodiesOfX3d::addSurfaceTo(const X3dTree& parent, const BodySurface& surface) {
  for (const X3dNode& child : parent) {
    if (isCollidable(child)) {
      if (const X3dNode* collidable = document_.definitionOf(child)) surfaces_.emplace(collidable, surface);
    }
    addSurfaceTo(child.second, surface);  // a CollisionSpace, or what an offset moves
  }
}

BodySurface BodiesOfX3d::surfaceOf(const X3dTree& collidables) const {
  for (const X3dNode& child : collidables) {
    if (!isCollidable(child)) continue;
    const X3dNode* collidable = document_.definitionOf(child);
    if (collidable == nullptr) continue;
    if (const auto found = surfaces_.find(collidable); found != surfaces_.end()) return found->second;
    for (const X3dNode& inner : collidable->second) {
      const auto found = surfaces_.find(document_.definitionOf(inner));
      if (found != surfaces_.end()) return found->second;
    }
  }
  return {};
}

Pose BodiesOfX3d::placeOf(const X3dNode& node, const char* origin, const char* rotation) {
  const X3dFields fields = fieldsOf(node);
  return {fields.rotation(rotation), fields.vec(origin, Vec3::Zero(), kFarthestX3d_m)};
}

// P' = T C R SR S -SR -C P (ISO/IEC 19775-1, 10.4.4).
Placement BodiesOfX3d::placementOfTransform(const X3dNode& node) {
  const X3dFields fields = fieldsOf(node);
  const Pose place = placeOf(node, "translation", "rotation");
  const Vec3 centre = fields.vec("center", Vec3::Zero(), kFarthestX3d_m);
  const Vec3 scale = fields.vec("scale", Vec3::Ones(), kFarthestX3d_m);
  const Mat3 along = fields.rotation("scaleOrientation");
  const Mat3 linear = place.rotation * along * scale.asDiagonal() * along.transpose();
  return {linear, place.origin + centre - linear * centre};
}

// Down to the shapes. An offset may name what has it inside: then it ends by its depth.
void BodiesOfX3d::addPieces(const X3dNode& collidable, const Pose& outer, std::vector<ShapePiece>& pieces, int depth) {
  constexpr std::size_t kMaxVisits = 100'000;
  constexpr int kDeepestOffset = 30;
  if (++visited_ > kMaxVisits) throw Error("its bodies have too many shapes");
  const X3dNode* definition = document_.definitionOf(collidable);
  if (definition == nullptr || depth > kDeepestOffset) return warn(collidable, "is left out: there is none");
  taken_.insert(definition);
  if (!fieldsOf(*definition).flag("enabled", true)) warn(*definition, "collides, though it is not enabled");
  const Pose pose = after(outer, placeOf(*definition, "translation", "rotation"));
  for (const X3dNode& child : definition->second) {
    if (isCollidable(child)) addPieces(child, pose, pieces, depth + 1);
    if (child.first != "Shape") continue;
    const X3dNode* shape = document_.definitionOf(child);
    if (shape == nullptr) {
      warn(child, "is left out: there is none");
      continue;
    }
    taken_.insert(shape);
    pieces.push_back({shape, pose});
  }
}

std::vector<ShapePiece> BodiesOfX3d::piecesIn(const X3dNode& body) {
  std::vector<ShapePiece> pieces;
  for (const X3dNode& child : body.second) {
    if (isCollidable(child)) addPieces(child, {}, pieces);
    if (x3dField(child, "containerField") == "massDensityModel") warn(body, "massDensityModel is left out");
  }
  return pieces;
}

// By which it meets others. A cylinder of HL lies along its longest side, so a disc is the hull of its mesh.
BodyShape BodiesOfX3d::kindOf(const X3dNode& shape) {
  for (const X3dNode& child : shape.second) {
    const X3dNode* geometry = document_.definitionOf(child);
    if (geometry == nullptr) continue;
    if (geometry->first == "Box") return BodyShape::kBox;
    if (geometry->first == "Sphere") return BodyShape::kBall;
    if (geometry->first != "Cylinder") continue;
    const X3dFields fields = fieldsOf(*geometry);
    const double radius = fields.number("radius", 1, 0, kFarthestX3d_m);
    if (fields.number("height", 2, 0, kFarthestX3d_m) > 2 * radius) return BodyShape::kCylinder;
  }
  return BodyShape::kHull;
}

Model BodiesOfX3d::geometryOf(const std::vector<ShapePiece>& pieces) {
  Model whole;
  for (const ShapePiece& piece : pieces) {
    Model part = read_(document_.textOf(*piece.shape));
    placeModel(part, {piece.pose.rotation, piece.pose.origin});
    whole.warnings.insert(whole.warnings.end(), part.warnings.begin(), part.warnings.end());
    appendPart(whole, part, 0);
  }
  if (whole.elements() == 0) throw Error("there is no geometry in it");
  return whole;
}

void BodiesOfX3d::warnOfWhatIsLeftOut(const X3dNode& node) {
  const X3dFields fields = fieldsOf(node);
  if (fields.has("inertia")) fields.warn("inertia is left out: it is that of its shape and mass");
  for (const char* other : {"forces", "torques"}) {
    if (fields.has(other)) fields.warn(std::string(other) + " is left out");
  }
  if (!fields.flag("useGlobalGravity", true)) fields.warn("useGlobalGravity is left out: gravity is one for all");
  if (fields.flag("autoDamp", false)) fields.warn("autoDamp is left out");
}

BodySpec BodiesOfX3d::specOf(const X3dNode& node, bool enabled) {
  const X3dFields fields = fieldsOf(node);
  BodySpec spec;
  spec.mass_kg = std::max(body_limits::kMinMass_kg, fields.number("mass", 1, 0, body_limits::kMaxMass_kg));
  spec.velocity_m_s = fields.vec("linearVelocity", Vec3::Zero(), body_limits::kMaxSpeed_m_s);
  spec.spin_rad_s = fields.vec("angularVelocity", Vec3::Zero(), body_limits::kMaxSpin_rad_s);
  spec.surface = surfaceOf(node.second);
  spec.fixed = fields.flag("fixed", false);
  if (spec.fixed) return spec;
  const bool weightless = *spec.mass_kg <= body_limits::kMinMass_kg;
  spec.fixed = weightless || !(enabled && fields.flag("enabled", true));
  if (spec.fixed) fields.warn(std::string("stays where it is: it ") + (weightless ? "has no mass" : "is not enabled"));
  return spec;
}

// One shape is the frame of its body: a box that is turned in it is a box still.
void BodiesOfX3d::setShape(const X3dNode& node, std::vector<ShapePiece>& pieces, SceneBody& body) {
  constexpr double kOff = 1e-3;  // of its size: where it matters how it moves
  const Pose centre_of_body = body.pose;
  if (pieces.size() == 1) {
    body.spec.shape = kindOf(*pieces.front().shape);
    body.pose = after(body.pose, std::exchange(pieces.front().pose, {}));
  }
  body.model = geometryOf(pieces);
  if (pieces.size() > 1) setParts(node, pieces.size(), body);
  const Box bounds = body.model.bounds();
  const Vec3 said = centre_of_body.toWorld(fieldsOf(node).vec("centerOfMass", Vec3::Zero(), kFarthestX3d_m));
  if ((body.pose.toWorld(bounds.centre()) - said).norm() > kOff * bounds.size().norm())
    warn(node, "its centre of mass is that of its shape");
}

// Several shapes are a body of parts, or its hull.
void BodiesOfX3d::setParts(const X3dNode& node, std::size_t shapes, SceneBody& body) {
  body.spec.shape = BodyShape::kParts;
  if (body.spec.fixed) return;
  try {
    const std::size_t parts = partsIn(body.model, body.spec);
    if (moving_parts_ + parts > kMaxBodies) throw Error("all bodies have too many parts");
    moving_parts_ += parts - 1;
  } catch (const Error& error) {
    body.spec.shape = BodyShape::kHull;
    warn(node, "meets other bodies as one hull of its " + std::to_string(shapes) + " shapes: " + error.what());
  }
}

// What cannot move stays, so that it can be touched.
void BodiesOfX3d::checkBody(const X3dNode& node, SceneBody& body) {
  if (body.spec.fixed) return;
  try {
    bodyOf(body.model, body.spec);
  } catch (const Error& error) {
    warn(node, std::string("stays where it is: ") + error.what());
    body.spec.fixed = true;
  }
}

void BodiesOfX3d::addBody(const X3dNode& node, bool enabled) {
  if (body_number_.contains(&node)) return warn(node, "is in the scene already");
  std::vector<ShapePiece> pieces = piecesIn(node);
  if (pieces.empty()) return warn(node, "is left out: it has no shape");
  SceneBody body;
  body.name = labelOfX3d(node);
  body.pose = placeOf(node, "position", "orientation");
  body.spec = specOf(node, enabled);
  if (!body.spec.fixed && moving_parts_ >= kMaxBodies) {
    ++too_many_;
    return;
  }
  warnOfWhatIsLeftOut(node);
  try {
    setShape(node, pieces, body);
  } catch (const Error& error) {
    return warn(node, std::string("is left out: ") + error.what());
  }
  checkBody(node, body);
  moving_parts_ += body.spec.fixed ? 0 : 1;
  scene_.bodies.push_back(std::move(body));
  body_number_[&node] = scene_.bodies.size();
}

void BodiesOfX3d::addCollection(const X3dNode& collection) {
  const Vec3 kDefault(0, -9.8, 0);  // X3D's
  const Vec3 gravity = fieldsOf(collection).vec("gravity", kDefault, body_limits::kMaxGravity_m_s2);
  if (!has_gravity_) scene_.mechanics.gravity_m_s2 = gravity;
  if (has_gravity_ && gravity != scene_.mechanics.gravity_m_s2)
    warn(collection, "its gravity is left out: there is one for all");
  has_gravity_ = true;
  const bool enabled = fieldsOf(collection).flag("enabled", true);
  for (const X3dNode& child : collection.second) {
    if (child.first != "RigidBody") continue;
    if (const X3dNode* body = document_.definitionOf(child))
      addBody(*body, enabled);
    else
      warn(child, "is left out: there is none");
  }
}

// Collidables that no body has: first those that stand in the scene, then those that a collection alone has.
void BodiesOfX3d::addStanding(const X3dTree& parent, bool in_collections) {
  for (const X3dNode& child : parent) {
    const bool collection =
        isX3d(child, {"RigidBodyCollection", "CollisionCollection", "CollisionSensor", "CollisionSpace"});
    if (child.first == "ProtoDeclare" || (collection && !in_collections)) continue;
    if (isCollidable(child)) {
      addStandingOne(child);
      continue;
    }
    if (child.first == "Transform") transforms_.push_back(&child);
    addStanding(child.second, in_collections);
    if (child.first == "Transform") transforms_.pop_back();
  }
}

void BodiesOfX3d::addStandingOne(const X3dNode& collidable) {
  const X3dNode* definition = document_.definitionOf(collidable);
  if (definition != nullptr && taken_.contains(definition)) return;
  std::vector<ShapePiece> pieces;
  addPieces(collidable, {}, pieces);
  if (pieces.empty()) return;
  SceneBody body;
  body.name = labelOfX3d(*definition);
  body.spec.fixed = true;
  if (const auto found = surfaces_.find(definition); found != surfaces_.end()) body.spec.surface = found->second;
  Placement to_world;
  for (const X3dNode* transform : transforms_) to_world = to_world * placementOfTransform(*transform);
  try {
    if (!(std::abs(to_world.linear.determinant()) > 0)) throw Error("a scale makes it flat");
    body.model = geometryOf(pieces);
    placeModel(body.model, to_world);
    scene_.bodies.push_back(std::move(body));
  } catch (const Error& error) {
    warn(*definition, std::string("is left out: ") + error.what());
  }
}

bool BodiesOfX3d::hasOtherShapes(const X3dTree& parent) const {
  return std::any_of(parent.begin(), parent.end(), [this](const X3dNode& child) {
    return child.first == "Shape" ? !taken_.contains(document_.definitionOf(child))
                                  : !isCollidable(child) && hasOtherShapes(child.second);
  });
}

// What is drawn in the place of a body would stay behind where the body started.
void BodiesOfX3d::takeWhatFollows(const X3dNode& route) {
  const X3dNode* from = document_.named(x3dField(route, "fromNode").value_or(""));
  const X3dNode* to = document_.named(x3dField(route, "toNode").value_or(""));
  if (from == nullptr || to == nullptr || to->first != "Transform") return;
  if (!body_number_.contains(from) && !(isCollidable(*from) && taken_.contains(from))) return;
  if (taken_.insert(to).second && hasOtherShapes(to->second))
    warn(*to, "is left out: it shows " + nameOfX3d(*from) + ", which is felt by the shapes of its collidables");
}

SceneModel BodiesOfX3d::build() {
  for (const X3dNode* collection : document_.all("CollisionCollection")) addSurface(*collection);
  for (const X3dNode* collection : document_.all("RigidBodyCollection")) addCollection(*collection);
  readX3dJoints(document_, body_number_, scene_, warnings_);
  addStanding(document_.tree(), false);
  addStanding(document_.tree(), true);
  for (const X3dNode* route : document_.all("ROUTE")) takeWhatFollows(*route);
  if (too_many_ > 0)
    warnings_.push_back(std::to_string(too_many_) + " bodies are left out: at most " + std::to_string(kMaxBodies) +
                        " can move");
  scene_.model = read_(document_.textWithout(taken_));
  warnings_.insert(warnings_.end(), scene_.model.warnings.begin(), scene_.model.warnings.end());
  scene_.model.warnings = std::move(warnings_);
  return std::move(scene_);
}

}  // namespace

bool speaksOfBodies(const std::string& text) {
  constexpr std::array<std::string_view, 3> kWords{"<RigidBodyCollection", "<Collidable", "<CollisionCollection"};
  return std::any_of(kWords.begin(), kWords.end(),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

SceneModel readX3dBodies(const std::string& text, const std::function<Model(const std::string& document)>& read) {
  return BodiesOfX3d(text, read).build();
}

}  // namespace hl
