// Inline nodes of X3D: the scene of another file is there, with names of its own; nothing but files beside it or
// beneath is read.
#include "io/x3d_inlines.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/load_model.h"
#include "load_refusal.h"
#include "scene/scene_model.h"
#include "temp_folder.h"

namespace hl::test_x3d_inlines {
namespace {

using test::fileWith;
using test::loadRefusal;

std::string document(const std::string& nodes) {
  return "<X3D profile='Full' version='3.3'><Scene>" + nodes + "</Scene></X3D>";
}

std::string inlineOf(const std::string& name) { return "<Inline url='\"" + name + "\"'/>"; }

Model load(const std::string& nodes) { return loadModel(fileWith("outer.x3d", document(nodes))); }

const std::string kBox = "<Shape DEF='part'><Box size='2 4 6'/></Shape>";

TEST(X3dInlines, TheSceneOfAnotherFileIsThere) {
  fileWith("inner.x3d", document(kBox + "<Transform translation='0 10 0'><Shape USE='part'/></Transform>"));
  const Model model = load("<Transform translation='100 0 0'>" + inlineOf("inner.x3d") +
                           "</Transform><Shape DEF='part'><Box size='1 1 1'/></Shape>"
                           "<Inline DEF='again' url='inner.x3d'/>"
                           "<Transform translation='0 0 50'><Inline USE='again'/><Shape USE='part'/></Transform>");
  EXPECT_TRUE(model.warnings.empty());
  EXPECT_EQ(model.triangles.size(), 12u * (2 + 1 + 2 + 2 + 1));
  EXPECT_TRUE(boundsOf(SceneModel(model)).size().isApprox(Vec3(102, 14, 56)));
}

TEST(X3dInlines, PrototypesAndFilesOfAnInlinedFileAreItsOwn) {
  std::filesystem::create_directories(test::tempFolder() / "parts");
  fileWith("parts/bolt.x3d", document("<Shape><Box size='1 1 1'/></Shape>"));
  fileWith("parts/plate.x3d", document("<ProtoDeclare name='Bolt'><ProtoBody>" + inlineOf("bolt.x3d") +
                                       "</ProtoBody></ProtoDeclare><ProtoInstance name='Bolt'/>"
                                       "<Transform translation='10 0 0'><ProtoInstance name='Bolt'/></Transform>"));
  const Model model = load(inlineOf("parts/plate.x3d"));
  EXPECT_EQ(model.triangles.size(), 24u);
  EXPECT_TRUE(boundsOf(SceneModel(model)).size().isApprox(Vec3(11, 1, 1)));
}

TEST(X3dInlines, OfAListTheFirstThatIsHereCounts) {
  fileWith("here.x3d", document(kBox));
  const Model model = load("<Inline url='\"https://example.org/a.x3d\" \"here.x3d\"'/>");
  EXPECT_EQ(model.triangles.size(), 12u);
  EXPECT_TRUE(model.warnings.empty());
}

TEST(X3dInlines, WhatCannotBeReadIsLeftOutWithAWarning) {
  fileWith("shape.wrl", "#VRML V2.0 utf8\nShape { geometry Box {} }\n");
  for (const char* name : {"missing.x3d", "/etc/passwd", "../up.x3d", "shape.wrl", "https://example.org/a.x3d", ""}) {
    const Model model = load(kBox + inlineOf(name) + inlineOf(name));
    EXPECT_EQ(model.triangles.size(), 12u) << name;
    ASSERT_EQ(model.warnings.size(), 1u) << name;
    EXPECT_EQ(model.warnings[0].rfind("Inline '", 0), 0u) << model.warnings[0];
  }
  fileWith("off.x3d", document(kBox));
  EXPECT_EQ(load(kBox + "<Inline load='false' url='off.x3d'/>").triangles.size(), 12u);
}

TEST(X3dInlines, AFileThatContainsItselfIsRefused) {
  const std::string nodes = kBox + inlineOf("outer.x3d") + inlineOf("outer.x3d");
  EXPECT_NE(loadRefusal(fileWith("outer.x3d", document(nodes))).find("contains itself"), std::string::npos);
  fileWith("broken.x3d", "<X3D><Scene>");
  EXPECT_NE(loadRefusal(fileWith("outer.x3d", document(kBox + inlineOf("broken.x3d")))), "");
}

}  // namespace
}  // namespace hl::test_x3d_inlines
