// What makes no sense in the bodies and joints of a scene file: an error, or a warning where it is harmless.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "io/load_scene_file.h"
#include "temp_folder.h"

namespace hl::test_scene_mechanics {
namespace {

using test::fileWith;
using test::tempFile;

const std::string kTetrahedron =
    R"("primitives": {"vertices": [-1,-1,-1, 1,-1,-1, 1,1,-1, 0,0,1], "triangles": [0,2,1, 0,1,3, 1,2,3, 2,0,3]}, )";

// "wall" stays where it is and "lid" moves. Bodies and joints begin on lines 2 to 4.
std::string sceneWith(const std::string& wall, const std::string& lid, const std::string& joints) {
  return "{\"units\": 0.01, \"objects\": [\n{\"name\": \"wall\", " + kTetrahedron + "\"body\": {\"fixed\": true" +
         wall + "}},\n{\"name\": \"lid\", " + kTetrahedron + "\"body\": {" + lid + "}}],\n\"joints\": [" + joints +
         "]}";
}

// Without the path in front, ":LINE: ...": the warnings, or the one line of an error.
std::vector<std::string> saidOf(const std::string& json) {
  const std::string path = fileWith("said.hl.json", json);
  std::vector<std::string> said;
  try {
    said = loadSceneFile(path).model.warnings;
  } catch (const Error& error) {
    said = {"error", error.what()};
  }
  for (std::string& line : said) {
    if (line.starts_with(path)) line.erase(0, path.size());
  }
  return said;
}

using Lines = std::vector<std::string>;

Lines ofWall(const std::string& body) { return saidOf(sceneWith(body, "", "")); }
Lines ofLid(const std::string& body) { return saidOf(sceneWith("", body, "")); }
Lines ofJoints(const std::string& joints) { return saidOf(sceneWith("", "", joints)); }
Lines error(const std::string& line) { return {"error", line}; }

TEST(SceneMechanics, WhatIsSoundIsNotReported) {
  EXPECT_EQ(ofLid(R"("massKg": 1)"), Lines());
  EXPECT_EQ(ofLid(R"("densityKgM3": 500)"), Lines());
  EXPECT_EQ(ofJoints(R"({"name": "hinge", "kind": "HINGE", "bodyA": "lid", "bodyB": "wall", "axis": {"y": 1},
                         "low": 0, "high": 1.6, "rest": 1, "spring": 2}, {"bodyA": "wall", "bodyB": "lid"})"),
            Lines());
}

TEST(SceneMechanics, AMassWithoutEffectIsAWarning) {
  const Lines fixed{":2: objects[0].body: a fixed body does not move, and its massKg and densityKgM3 have no effect"};
  EXPECT_EQ(ofWall(R"(, "massKg": 1)"), fixed);
  EXPECT_EQ(ofWall(R"(, "densityKgM3": 500)"), fixed);
  EXPECT_EQ(ofWall(R"(, "massKg": 1, "densityKgM3": 500)"), fixed);
  EXPECT_EQ(ofLid(R"("massKg": 1, "densityKgM3": 500)"),
            Lines{":3: objects[1].body.densityKgM3 has no effect beside massKg"});
  EXPECT_EQ(ofWall(R"(, "densityKgM3": 1000)"), Lines()) << "as pages have saved it";
  EXPECT_EQ(ofLid(R"("massKg": 1, "densityKgM3": 1000)"), Lines());
}

TEST(SceneMechanics, ABuiltinWithBodiesIsNone) {
  for (const std::string name : {"snaps", "workshop"}) {
    EXPECT_EQ(saidOf("{\"objects\": [{\"builtin\": \"" + name + "\",\n\"body\": {}}]}"),
              error(":2: objects[0].body: '" + name + "' has bodies of its own, and stays where it is as one object"));
    EXPECT_EQ(saidOf("{\"objects\": [{\"builtin\": \"" + name + "\"}]}"), Lines());
  }
}

TEST(SceneMechanics, WhatAStepWouldRefuseIsAnErrorWithItsLine) {
  const std::string fault = "its distance can only be 0: place its two anchors apart, or give it a limit high > 0";
  EXPECT_EQ(ofJoints("\n{\"name\": \"rope\", \"kind\": \"DISTANCE\", \"bodyA\": \"lid\"}"),
            error(":5: joints[0] ('rope'): " + fault));
  EXPECT_EQ(ofJoints(R"({"kind": "DISTANCE", "bodyA": "lid", "bodyB": "wall"})"), error(":4: joints[0]: " + fault));
  EXPECT_EQ(ofJoints(R"({"kind": "DISTANCE", "bodyA": "lid", "high": 1})"), Lines());
  EXPECT_EQ(ofJoints(R"({"kind": "DISTANCE", "bodyA": "lid", "anchorB": {"y": 1}})"), Lines());
}

TEST(SceneMechanics, AnEmptyTableIsAnError) {
  EXPECT_EQ(ofJoints(R"({"kind": "HINGE", "bodyA": "lid", "axis": {"y": 1}, "table": {}})"),
            error(":4: joints[0].table must have a row or more: leave it out for none"));
  EXPECT_EQ(ofJoints(R"({"bodyA": "lid", "table": {"position": []}})"),
            error(":4: joints[0].table must have a row or more: leave it out for none"));
}

TEST(SceneMechanics, JointsWithoutEffectAreWarnings) {
  EXPECT_EQ(ofJoints(R"({"kind": "HINGE", "bodyA": "lid", "axis": {"y": 1}, "rest": 1})"),
            Lines{":4: joints[0].rest has no effect without a spring"});
  EXPECT_EQ(ofJoints("{\"bodyA\": \"lid\"},\n{\"name\": \"nail\", \"bodyA\": \"wall\"}"),
            Lines{":5: joints[1] ('nail') joins nothing that moves, and has no effect"});
  EXPECT_EQ(ofJoints(R"({"name": "j", "bodyA": "lid"}, {"name": "j", "bodyA": "lid", "bodyB": "wall"},
                        {"name": "j", "bodyA": "lid", "bodyB": "wall"})"),
            Lines{":4: joints[1].name: there are several joints 'j'"});
}

TEST(SceneMechanics, AJointThatStartsOutsideItsLimitsIsAWarning) {
  const std::string stays = ", and stays there until something moves it";
  EXPECT_EQ(ofJoints("\n{\"name\": \"hinge\", \"kind\": \"HINGE\",\n\"bodyA\": \"lid\", \"axis\": {\"y\": 1},\n"
                     "\"low\": 0.5, \"high\": 1.6}"),
            Lines{":5: joints[0] ('hinge') starts at 0 rad, outside its limits of 0.5 .. 1.6 rad" + stays});
  EXPECT_EQ(ofJoints(R"({"kind": "SLIDER", "bodyA": "wall", "bodyB": "lid", "axis": {"y": 1}, "high": -2})"),
            Lines{":4: joints[0] starts at 0 m, outside its limits of -inf .. -0.02 m" + stays})
      << "metres, not units";
}

TEST(SceneMechanics, AWarningIsOneLine) {
  EXPECT_EQ(ofJoints(R"({"name": "a\nb", "bodyA": "wall"})"),
            Lines{":4: joints[0] ('a?b') joins nothing that moves, and has no effect"});
}

TEST(SceneMechanics, AFileThatComesAloneIsNotNamed) {
  LoadOptions options;
  options.alone = true;
  const std::string path = fileWith("alone.hl.json", sceneWith("", "", R"({"bodyA": "wall"})"));
  EXPECT_EQ(loadSceneFile(path, options).model.warnings,
            Lines{"line 4: joints[0] joins nothing that moves, and has no effect"});
}

}  // namespace
}  // namespace hl::test_scene_mechanics
