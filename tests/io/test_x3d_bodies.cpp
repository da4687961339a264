// Bodies and joints of X3D files: what the nodes of RigidBodyPhysics say reaches the scene, each shape is there once,
// and what is strange becomes a warning or one line.
#include "io/x3d_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <string>

#include "base/error.h"
#include "bodies/mesh_body.h"
#include "bodies/scene_world.h"
#include "io/load_model.h"
#include "io/x3d_document.h"
#include "solids.h"
#include "temp_folder.h"

namespace hl::test_x3d_bodies {
namespace {

using test::fileWith;

std::string sceneOf(const std::string& nodes) {
  return "<?xml version='1.0'?><!DOCTYPE X3D PUBLIC 'ISO//Web3D//DTD X3D 3.3//EN' 'x3d-3.3.dtd'>\n"
         "<X3D profile='Full' version='3.3'><head><component name='RigidBodyPhysics' level='2'/></head><Scene>" +
         nodes + "</Scene></X3D>";
}

std::string collection(const std::string& nodes) {
  return sceneOf("<RigidBodyCollection>" + nodes + "</RigidBodyCollection>");
}

std::string body(const std::string& fields, const std::string& geometry = "<Box size='1 1 1'/>") {
  return "<RigidBody " + fields + "><CollidableShape><Shape>" + geometry + "</Shape></CollidableShape></RigidBody>";
}

SceneModel load(const std::string& text) { return loadModelScene(fileWith("a.x3d", text)); }

// Any geometry is a cube of 1 m.
SceneModel withCubes(const std::string& text) {
  return readX3dBodies(text, [](const std::string&) { return boxSolid(Vec3::Constant(0.5)); });
}

std::string errorOf(const std::string& text) {
  try {
    load(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool warns(const SceneModel& scene, const std::string& words) {
  const auto& lines = scene.model.warnings;
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(words) != line.npos; });
}

Box boxOf(const SceneBody& one) {
  Model model = one.model;
  placeModel(model, {one.pose.rotation, one.pose.origin});
  return model.bounds();
}

const char kBlock[] = R"(
  <Transform translation="0 -0.05 0"><Shape><Box size="1 0.1 1"/></Shape></Transform>
  <Transform DEF="Seen" translation="0 0.02 0">
    <Shape DEF="BlockShape"><Box DEF="Cube" size="0.04 0.04 0.04"/></Shape>
  </Transform>
  <Transform translation="0.3 0.02 0"><Shape><Box USE="Cube"/></Shape></Transform>
  <CollisionCollection bounce="0.25" frictionCoefficients="0.4, 0.4">
    <CollidableShape DEF="BlockHit"><Shape USE="BlockShape" containerField="shape"/></CollidableShape>
  </CollisionCollection>
  <RigidBodyCollection gravity="0 -9 0">
    <RigidBody DEF="block" mass="0.1" position="0 0.02 0" orientation="0 2 0 0.5" linearVelocity="0.1 0 0"
        angularVelocity="0 3 0">
      <CollidableShape USE="BlockHit" containerField="geometry"/>
    </RigidBody>
  </RigidBodyCollection>
  <ROUTE fromNode="block" fromField="position_changed" toNode="Seen" toField="set_translation"/>)";

TEST(X3dBodies, ABlockOnAFloor) {
  const SceneModel scene = load(sceneOf(kBlock));
  ASSERT_EQ(scene.bodies.size(), 1u);
  const SceneBody& block = scene.bodies[0];
  EXPECT_EQ(block.name, "block");
  EXPECT_EQ(block.spec.mass_kg, 0.1);
  EXPECT_EQ(block.spec.shape, BodyShape::kBox);
  EXPECT_EQ(block.spec.surface, (BodySurface{0.4, 0.4, 0.25}));
  EXPECT_EQ(block.spec.velocity_m_s, Vec3(0.1, 0, 0));
  EXPECT_EQ(block.spec.spin_rad_s, Vec3(0, 3, 0));
  EXPECT_EQ(block.pose.origin, Vec3(0, 0.02, 0));
  EXPECT_LT((block.pose.rotation * Vec3::UnitZ() - Vec3(std::sin(0.5), 0, std::cos(0.5))).norm(), 1e-15);
  EXPECT_LT((block.model.bounds().size() - Vec3::Constant(0.04)).norm(), 1e-7);
  EXPECT_EQ(scene.mechanics.gravity_m_s2, Vec3(0, -9, 0));
  EXPECT_TRUE(scene.model.warnings.empty()) << scene.model.warnings[0];
}

TEST(X3dBodies, WhatABodyTookIsNoPartOfTheRest) {
  const SceneModel scene = load(sceneOf(kBlock));
  EXPECT_EQ(scene.model.triangles.size(), 24u) << "the floor, and the cube of the same geometry that no body has";
  EXPECT_NEAR(scene.model.bounds().max.y(), 0.04, 1e-7);
  EXPECT_NEAR(scene.model.bounds().min.y(), -0.1, 1e-7);
  const auto world = worldOf(*makeSnapshot(scene));
  ASSERT_NE(world, nullptr);
  EXPECT_EQ(world->bodies.size(), 1u);
}

TEST(X3dBodies, AHingedDoorTurnsAsX3dSays) {
  const SceneModel scene = load(
      collection(body("DEF='frame' fixed='true' position='-0.02 0 0'", "<Box size='0.02 0.2 0.02'/>") +
                 body("DEF='door' position='0.05 0 0'", "<Box size='0.1 0.2 0.01'/>") +
                 "<SingleAxisHingeJoint DEF='hinge' anchorPoint='0 0.1 0' axis='0 1 0' minAngle='-0.5' maxAngle='1.5'>"
                 "<RigidBody USE='frame' containerField='body1'/><RigidBody USE='door' containerField='body2'/>"
                 "</SingleAxisHingeJoint>"));
  ASSERT_EQ(scene.mechanics.joints.size(), 1u);
  const JointSpec& hinge = scene.mechanics.joints[0];
  EXPECT_EQ(hinge.name, "hinge");
  EXPECT_EQ(hinge.kind, JointKind::kHinge);
  // The angle of the frame about +y against the door is that of the door about -y against the frame.
  EXPECT_EQ(hinge.body_a, 2u);
  EXPECT_EQ(hinge.body_b, 1u);
  EXPECT_EQ(hinge.axis_W, Vec3(0, -1, 0));
  EXPECT_EQ(hinge.anchor_W, Vec3(0, 0.1, 0));
  EXPECT_EQ(hinge.along.low, -0.5);
  EXPECT_EQ(hinge.along.high, 1.5);
  EXPECT_EQ(scene.mechanics.gravity_m_s2, Vec3(0, -9.8, 0)) << "X3D's default";
  const auto world = worldOf(*makeSnapshot(scene));
  ASSERT_NE(world, nullptr);
  EXPECT_EQ(world->joints.size(), 1u);
}

TEST(X3dBodies, ASliderGoesFromWhereItStarts) {
  const SceneModel scene = load(collection(body("DEF='knob' position='1 2 3'") +
                                           "<SliderJoint axis='1 0 0' maxSeparation='0.02'><RigidBody USE='knob' "
                                           "containerField='body1'/></SliderJoint>"));
  ASSERT_EQ(scene.mechanics.joints.size(), 1u);
  const JointSpec& slider = scene.mechanics.joints[0];
  EXPECT_EQ(slider.kind, JointKind::kSlider);
  EXPECT_EQ(slider.body_a, 1u);
  EXPECT_EQ(slider.body_b, 0u) << "the world";
  EXPECT_EQ(slider.axis_W, Vec3(1, 0, 0));
  EXPECT_EQ(slider.anchor_W, Vec3(1, 2, 3));
  EXPECT_EQ(slider.along.low, 0);
  EXPECT_EQ(slider.along.high, 0.02);
}

TEST(X3dBodies, AHingeOfHalfATurnAndMoreHasNoLimits) {
  const SceneModel scene = withCubes(
      collection(body("DEF='a'") + "<SingleAxisHingeJoint axis='0 0 1' minAngle='-3.1416' maxAngle='3.1415927'>"
                                   "<RigidBody USE='a' containerField='body1'/></SingleAxisHingeJoint>"));
  ASSERT_EQ(scene.mechanics.joints.size(), 1u);
  EXPECT_EQ(scene.mechanics.joints[0].along, JointForces{});
}

// Offsets and the shape's own place follow one another, and the body's is outside of all.
TEST(X3dBodies, OffsetsPlaceAShapeInItsBody) {
  const SceneModel scene = load(collection(
      "<RigidBody position='0 8 0' orientation='0 0 1 1.5707963267948966'><CollidableOffset translation='0.5 0 0' "
      "rotation='0 0 1 1.5707963267948966'><CollidableShape translation='0 0.25 0'><Shape><Cylinder radius='0.1' "
      "height='2'/></Shape></CollidableShape></CollidableOffset></RigidBody>"));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].spec.shape, BodyShape::kCylinder);
  // (0, 0.25) -> (0.5 - 0.25, 0) -> (0, 8.25); turned by half a turn in all, so it stands upright.
  const Box box = boxOf(scene.bodies[0]);
  EXPECT_LT((box.centre() - Vec3(0, 8.25, 0)).norm(), 1e-3);
  EXPECT_NEAR(box.size().y(), 2, 1e-6);
  EXPECT_TRUE(warns(scene, "its centre of mass is that of its shape"));
}

TEST(X3dBodies, SeveralShapesAreOneBody) {
  const std::string ball =
      "<CollidableShape><Shape><Sphere radius='0.1'/></Shape></CollidableShape></CollidableOffset>";
  const SceneModel scene = load(collection("<RigidBody><CollidableOffset translation='0.5 0 0'>" + ball +
                                           "<CollidableOffset translation='-0.5 0 0'>" + ball + "</RigidBody>"));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].spec.shape, BodyShape::kParts);
  EXPECT_NEAR(scene.bodies[0].model.bounds().size().x(), 1.2, 1e-3);
  EXPECT_FALSE(warns(scene, "hull"));
  EXPECT_FALSE(warns(scene, "centre of mass")) << "it is where X3D has it";
}

TEST(X3dBodies, ShapesWithoutAThicknessArePlates) {
  const SceneModel scene = load(collection(
      "<RigidBody><CollidableShape><Shape><Box/></Shape></CollidableShape><CollidableOffset translation='0 3 0'>"
      "<CollidableShape><Shape><IndexedFaceSet coordIndex='0 1 2 -1'><Coordinate point='0 0 0 1 0 0 0 1 0'/>"
      "</IndexedFaceSet></Shape></CollidableShape></CollidableOffset></RigidBody>"));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].spec.shape, BodyShape::kParts);
  EXPECT_EQ(partsIn(scene.bodies[0].model, scene.bodies[0].spec), 2u);
}

TEST(X3dBodies, ACylinderLiesAlongItsLongestSide) {
  const SceneModel scene = withCubes(collection(body("", "<Cylinder height='3'/>") + body("", "<Cylinder/>") +
                                                body("", "<Sphere/>") + body("", "<Cone/>")));
  ASSERT_EQ(scene.bodies.size(), 4u);
  EXPECT_EQ(scene.bodies[0].spec.shape, BodyShape::kCylinder);
  EXPECT_EQ(scene.bodies[1].spec.shape, BodyShape::kHull);
  EXPECT_EQ(scene.bodies[2].spec.shape, BodyShape::kBall);
  EXPECT_EQ(scene.bodies[3].spec.shape, BodyShape::kHull);
}

// The scene's Transforms hold for a collidable that no body has.
TEST(X3dBodies, CollidablesWithoutABodyStay) {
  const SceneModel scene = load(
      sceneOf("<Transform translation='1 0 0' scale='2 2 2'><CollidableShape DEF='wall' translation='0 1 0'><Shape>"
              "<Box size='1 1 1'/></Shape></CollidableShape></Transform><CollisionSensor><CollisionCollection "
              "bounce='0.5'><CollidableShape USE='wall'/><CollidableShape translation='-3 0 0'><Shape><Box "
              "size='1 1 1'/></Shape></CollidableShape></CollisionCollection></CollisionSensor>"));
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.model.elements(), 0u);
  for (const SceneBody& one : scene.bodies) {
    EXPECT_TRUE(one.spec.fixed);
    EXPECT_EQ(one.spec.surface.restitution, 0.5);
    EXPECT_EQ(one.spec.surface.dynamic_friction, BodySurface{}.dynamic_friction) << "HL's own";
  }
  EXPECT_LT((boxOf(scene.bodies[0]).min - Vec3(0, 1, -1)).norm(), 1e-6);
  EXPECT_LT((boxOf(scene.bodies[0]).max - Vec3(2, 3, 1)).norm(), 1e-6);
  EXPECT_LT((boxOf(scene.bodies[1]).centre() - Vec3(-3, 0, 0)).norm(), 1e-6);
}

TEST(X3dBodies, WhatIsDrawnForABodyDoesNotStayBehind) {
  const SceneModel scene =
      load(sceneOf("<Transform DEF='Car'><Shape><Sphere/></Shape></Transform><RigidBodyCollection>" + body("DEF='b'") +
                   "</RigidBodyCollection><ROUTE fromNode='b' "
                   "fromField='position' toNode='Car' toField='translation'/>"));
  EXPECT_EQ(scene.model.elements(), 0u);
  EXPECT_TRUE(warns(scene, "Transform 'Car'"));
}

TEST(X3dBodies, AsOneModelNothingIsLost) {
  const Model model = loadModel(fileWith("one.x3d", sceneOf(kBlock)));
  EXPECT_EQ(model.triangles.size(), 36u);
  EXPECT_NE(model.warnings.back().find("stay where they are"), std::string::npos);
}

TEST(X3dBodies, AFileThatComesAloneHasItsBodies) {
  const std::string path = fileWith("sent.x3d", sceneOf(kBlock));
  const SceneModel scene = runIsolated(path, {},
                                       [&](const auto& report) {
                                         return parseModel({path, ".x3d", true}, report);
                                       },
                                       {});
  EXPECT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.model.triangles.size(), 24u);
}

struct Strange {
  const char* fields;
  const char* warning;
  bool moves;
};

TEST(X3dBodies, StrangeFieldsAreWarnings) {
  for (const Strange& strange : {Strange{"mass='0'", "it has no mass", false},
                                 {"mass='-1'", "mass is left out", true},
                                 {"mass='nan'", "mass is left out", true},
                                 {"mass='1 2'", "mass is left out", true},
                                 {"position='1 2'", "position is left out", true},
                                 {"position='1e300 0 0'", "position is left out", true},
                                 {"orientation='x'", "orientation is left out", true},
                                 {"linearVelocity='1e5 0 0'", "linearVelocity is left out", true},
                                 {"fixed='maybe'", "must be true or false", true},
                                 {"enabled='false'", "it is not enabled", false},
                                 {"centerOfMass='1 0 0'", "centre of mass", true},
                                 {"inertia='2 0 0 0 2 0 0 0 2'", "inertia is left out", true},
                                 {"forces='0 1 0'", "forces is left out", true},
                                 {"useGlobalGravity='false'", "useGlobalGravity", true},
                                 {"autoDamp='true'", "autoDamp", true}}) {
    const SceneModel scene = withCubes(collection(body(strange.fields)));
    ASSERT_EQ(scene.bodies.size(), 1u) << strange.fields;
    EXPECT_TRUE(warns(scene, strange.warning)) << strange.fields;
    EXPECT_EQ(scene.model.warnings.size(), 1u) << strange.fields;
    EXPECT_EQ(!scene.bodies[0].spec.fixed, strange.moves) << strange.fields;
  }
}

TEST(X3dBodies, WhatIsLeftOutIsReported) {
  const std::string joint = "<BallJoint><RigidBody USE='a' containerField='body1'/>";
  for (const auto& [nodes, warning] : std::vector<std::pair<std::string, std::string>>{
           {"<RigidBody/>", "it has no shape"},
           {"<RigidBody USE='b'/>", "there is none"},
           {"<RigidBody><CollidableShape USE='a'/></RigidBody>", "there is none"},
           {"<RigidBody><CollidableShape><Shape USE='a'/></CollidableShape></RigidBody>", "there is none"},
           {"<UniversalJoint/>", "not supported"},
           {"<DoubleAxisHingeJoint/>", "not supported"},
           {"<MotorJoint DEF='m'/>", "MotorJoint 'm': is not supported"},
           {"<BallJoint/>", "joins nothing that moves"},
           {joint + "<RigidBody USE='a' containerField='body2'/></BallJoint>", "joins nothing that moves"},
           {joint + "<RigidBody USE='b' containerField='body2'/></BallJoint>", "RigidBody 'b' is no body here"},
           {"<SingleAxisHingeJoint><RigidBody USE='a'/></SingleAxisHingeJoint>", "needs an axis"},
           {"<SingleAxisHingeJoint DEF='h' axis='0 1 0' minAngle='0.5' maxAngle='1'><RigidBody USE='a'/>"
            "</SingleAxisHingeJoint>",
            "SingleAxisHingeJoint 'h': starts at 0 rad, outside its limits of 0.5 .. 1 rad, and stays there until "
            "something moves it"},
           {"<SliderJoint minSeparation='2'><RigidBody USE='a'/></SliderJoint>", "has no limits"}}) {
    const SceneModel scene = withCubes(collection(body("DEF='a'") + nodes));
    EXPECT_EQ(scene.bodies.size(), 1u) << nodes;
    EXPECT_TRUE(warns(scene, warning)) << nodes;
  }
}

TEST(X3dBodies, AShapeThatCannotBeReadLeavesItsBodyOut) {
  const SceneModel scene = load(collection(body("DEF='a'", "<Box size='x'/>") + body("DEF='b'")));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].name, "b");
  EXPECT_TRUE(warns(scene, "RigidBody 'a': is left out: cannot be understood"));
}

TEST(X3dBodies, AFlatShapeStaysWhereItIs) {
  const SceneModel scene = load(collection(body(
      "DEF='a'", "<IndexedFaceSet coordIndex='0 1 2 -1'><Coordinate point='0 0 0, 1 0 0, 0 1 0'/></IndexedFaceSet>")));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_TRUE(scene.bodies[0].spec.fixed);
  EXPECT_TRUE(warns(scene, "thickness"));
}

TEST(X3dBodies, NoMoreBodiesThanCanMove) {
  std::string many;
  for (std::size_t i = 0; i < kMaxBodies + 2; ++i) many += body("");
  const SceneModel scene = withCubes(collection(many));
  EXPECT_EQ(scene.bodies.size(), kMaxBodies);
  EXPECT_TRUE(warns(scene, "2 bodies are left out"));
}

TEST(X3dBodies, BodiesThatStayTakeNoRoomOfThoseThatMove) {
  std::string many = body("");
  for (std::size_t i = 0; i < kMaxBodies + 2; ++i) many += body("fixed='true'");
  const SceneModel scene = withCubes(collection(many + body("")));
  EXPECT_EQ(scene.bodies.size(), kMaxBodies + 4);
  EXPECT_FALSE(warns(scene, "left out"));
}

TEST(X3dBodies, HostileFilesAreOneLine) {
  std::string deep, shut;
  for (int i = 0; i < 100'000; ++i) {
    deep += "<Group>";
    shut += "</Group>";
  }
  EXPECT_NE(errorOf(collection(deep + shut)).find("nested too deep"), std::string::npos);
  EXPECT_NE(errorOf("<X3D><RigidBodyCollection>").find("is no XML"), std::string::npos);
  EXPECT_THROW(withCubes(std::string(kMaxX3dBytes + 1, ' ')), Error);
  const std::string twice = "<CollidableOffset USE='o'/>";
  const std::string within =
      "<RigidBody><CollidableOffset DEF='o'>" + twice + twice + "</CollidableOffset></RigidBody>";
  EXPECT_NE(errorOf(collection(within)).find("too many shapes"), std::string::npos);
  std::string chain;
  for (int i = 0; i < 5000; ++i)
    chain += "<Group DEF='g" + std::to_string(i) + "'><Group USE='g" + std::to_string(i + 1) + "'/></Group>";
  EXPECT_NE(
      errorOf(sceneOf("<RigidBodyCollection>" + chain + "</RigidBodyCollection><Group USE='g0'/>")).find("too deep"),
      std::string::npos);
}

TEST(X3dBodies, AFileHasNoEntitiesOfItsOwn) {
  const SceneModel scene = withCubes("<!DOCTYPE X3D [<!ENTITY a '5'>]><X3D><Scene><RigidBodyCollection>" +
                                     body("mass='&a;'") + "</RigidBodyCollection></Scene></X3D>");
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_TRUE(warns(scene, "mass is left out"));
}

// Whatever the bytes are: a scene, or one line.
TEST(X3dBodies, DamagedFilesNeverHarm) {
  std::mt19937 random(1);
  const std::string whole = sceneOf(kBlock);
  std::size_t taken = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = whole;
    for (int k = 0; k < 1 + i % 5; ++k) {
      const std::size_t at = random() % text.size(), from = random() % text.size();
      if (random() % 2 == 0) text[at] = static_cast<char>(random());
      if (random() % 4 == 0) text.erase(at, random() % 40);
      if (random() % 4 == 0) text.insert(at % (text.size() + 1), whole.substr(from % whole.size(), random() % 200));
    }
    try {
      const SceneModel scene = withCubes(text);
      makeSnapshot(scene);
      ++taken;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      ++refused;
    }
  }
  EXPECT_GT(taken, 300u);
  EXPECT_GT(refused, 300u);
}

}  // namespace
}  // namespace hl::test_x3d_bodies
