// X3D in other words: what assimp does not read is the same shape in nodes that it does. Places and areas by hand.
#include "io/x3d_plain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "base/error.h"
#include "io/load_model.h"
#include "io/x3d_prototypes.h"
#include "scene/scene_model.h"
#include "temp_folder.h"

namespace hl::test_x3d_plain {
namespace {

using test::fileWith;

std::string document(const std::string& nodes) {
  return "<X3D profile='Full' version='3.3'><Scene>" + nodes + "</Scene></X3D>";
}

Model load(const std::string& nodes) { return loadModel(fileWith("a.x3d", document(nodes))); }

// A square of 1 m for each, from here on along x: quads, strips and faces in all their forms.
const std::string kSquare = "<Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0'/>";
const std::string kBox = "<Shape><Box size='2 4 6'/></Shape>";

double areaOf(const Model& model) {
  double sum = 0;
  for (const auto& [a, b, c] : model.triangles)
    sum += (model.positions[b] - model.positions[a]).cross(model.positions[c] - model.positions[a]).norm() / 2;
  return sum;
}

// z component of twice the sum of the triangles' areas: which way they turn.
double turnOf(const Model& model) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [a, b, c] : model.triangles)
    sum += (model.positions[b] - model.positions[a]).cross(model.positions[c] - model.positions[a]);
  return sum.z();
}

Vec3 sizeOf(const Model& model) { return boundsOf(SceneModel(model)).size(); }

bool warns(const Model& model, const std::string& words) {
  return std::any_of(model.warnings.begin(), model.warnings.end(),
                     [&](const std::string& line) { return line.find(words) != line.npos; });
}

TEST(X3dPlain, QuadsAndStripsAreFaces) {
  for (const std::string& set :
       {"<IndexedQuadSet index='0 1 2 3'>" + kSquare + "</IndexedQuadSet>", "<QuadSet>" + kSquare + "</QuadSet>",
        std::string(
            "<TriangleStripSet stripCount='4'><Coordinate point='0 0 0 1 0 0 0 1 0 1 1 0'/></TriangleStripSet>"),
        "<IndexedTriangleStripSet index='0 1 3 2 -1'>" + kSquare + "</IndexedTriangleStripSet>",
        "<IndexedFaceSet coordIndex='0,1,2,3,-1'>" + kSquare + "</IndexedFaceSet>"}) {
    const Model model = load("<Shape>" + set + "</Shape>");
    EXPECT_EQ(model.triangles.size(), 2u) << set;
    EXPECT_DOUBLE_EQ(areaOf(model), 1) << set;
    EXPECT_DOUBLE_EQ(turnOf(model), 2) << set;
  }
}

TEST(X3dPlain, LinesStayLines) {
  const std::string points = "<Coordinate point='0 0 0, 1 0 0, 1 1 0, 0 1 0, 2 0 0, 2 1 0'/>";
  EXPECT_EQ(load("<Shape><IndexedLineSet coordIndex='0 1 2 3 -1 4 5'>" + points + "</IndexedLineSet></Shape>")
                .segments.size(),
            4u);
  const Model counted = load("<Shape><LineSet vertexCount='4 2'>" + points + "</LineSet></Shape>");
  EXPECT_EQ(counted.segments.size(), 4u);
  EXPECT_TRUE(counted.triangles.empty());
}

TEST(X3dPlain, ColoursAreKeptWhereTheyHaveAPlace) {
  const std::string points = "<Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0'/>", two = "<Color color='1 0 0 0 1 0'/>";
  const auto load_set = [&](const std::string& type, const std::string& fields) {
    return load("<Shape><" + type + ' ' + fields + '>' + points + two + "</" + type + "></Shape>");
  };
  EXPECT_FALSE(load_set("IndexedLineSet", "coordIndex='0 1 2 -1 3 0' colorIndex='0 1 0 -1 1 0'")
                   .appearance.vertex_colours.empty());
  const Model whole = load_set("IndexedLineSet", "coordIndex='0 1 2 -1 3 0' colorPerVertex='false'");
  EXPECT_EQ(whole.segments.size(), 3u);
  EXPECT_TRUE(whole.appearance.vertex_colours.empty());
}

TEST(X3dPlain, AnAppearanceMayHaveAnything) {
  const Model model = load(
      "<Shape><Appearance><PhysicalMaterial baseColor='0 0 1'/><PointProperties/><FillProperties/></Appearance>"
      "<Box size='2 4 6'/></Shape>");
  EXPECT_EQ(model.triangles.size(), 12u);
}

TEST(X3dPlain, WhatOnlyGroupsIsAGroup) {
  for (const std::string& nodes :
       {"<Anchor url='\"a.html\"'>" + kBox + "</Anchor>", "<Billboard>" + kBox + "</Billboard>",
        "<Collision>" + kBox + "<Shape containerField='proxy'><Box size='9 9 9'/></Shape></Collision>",
        "<LOD range='5'>" + kBox + "<Shape><Box size='9 9 9'/></Shape></LOD>",
        std::string("<CADLayer><CADAssembly><CADPart translation='1 2 3'><CADFace><Shape containerField='shape'>"
                    "<Box size='2 4 6'/></Shape></CADFace></CADPart></CADAssembly></CADLayer>"),
        "<HAnimHumanoid><HAnimJoint DEF='j' containerField='skeleton'><HAnimSegment>" + kBox +
            "</HAnimSegment></HAnimJoint><HAnimJoint USE='j' containerField='joints'/></HAnimHumanoid>"}) {
    const Model model = load(nodes);
    EXPECT_EQ(model.triangles.size(), 12u) << nodes;
    EXPECT_TRUE(sizeOf(model).isApprox(Vec3(2, 4, 6))) << nodes;
  }
}

TEST(X3dPlain, AnAxisMayHaveAnyLength) {
  const Model turned = load("<Transform rotation='0 0 5 1.5707963267948966'>" + kBox + "</Transform>");
  EXPECT_TRUE(sizeOf(turned).isApprox(Vec3(4, 2, 6), 1e-6));
}

const std::string kCrate =
    "<ProtoDeclare name='Crate'><ProtoInterface>"
    "<field name='size' type='SFVec3f' accessType='initializeOnly' value='1 1 1'/>"
    "<field name='lid' type='MFNode' accessType='initializeOnly'/></ProtoInterface>"
    "<ProtoBody><Group DEF='root'><IS><connect nodeField='children' protoField='lid'/></IS><Shape DEF='side'><Box>"
    "<IS><connect nodeField='size' protoField='size'/></IS></Box></Shape>"
    "<Transform translation='10 0 0'><Shape USE='side'/></Transform></Group><Script/></ProtoBody></ProtoDeclare>";

TEST(X3dPlain, PrototypesAreExpanded) {
  const Model plain = load(kCrate + "<ProtoInstance name='Crate'/>");
  EXPECT_EQ(plain.triangles.size(), 24u);
  EXPECT_TRUE(sizeOf(plain).isApprox(Vec3(11, 1, 1)));
  const Model two = load(kCrate +
                         "<ProtoInstance name='Crate' DEF='big'><fieldValue name='size' value='2 4 6'/><fieldValue "
                         "name='lid'><Shape><Box size='1 20 1'/></Shape></fieldValue></ProtoInstance>"
                         "<Transform translation='100 0 0'><ProtoInstance name='Crate'/></Transform>"
                         "<Transform translation='200 0 0'><ProtoInstance USE='big'/></Transform>");
  EXPECT_EQ(two.triangles.size(), 12u * (3 + 2 + 3));
  EXPECT_TRUE(sizeOf(two).isApprox(Vec3(212, 20, 6)));
}

TEST(X3dPlain, APrototypeMayUseAnother) {
  const std::string pair =
      "<ProtoDeclare name='Pair'><ProtoInterface><field name='s' type='SFVec3f' accessType='inputOutput' value='1 1 "
      "1'/>"
      "</ProtoInterface><ProtoBody><Group><ProtoInstance name='Crate'><fieldValue name='size' value='3 3 3'/>"
      "</ProtoInstance></Group></ProtoBody></ProtoDeclare>";
  EXPECT_TRUE(sizeOf(load(kCrate + pair + "<ProtoInstance name='Pair'/>")).isApprox(Vec3(13, 3, 3)));
}

TEST(X3dPlain, AGroupOfNothingEndsNothing) {
  for (const char* type : {"Group", "Transform", "StaticGroup", "Anchor", "Switch", "LOD", "Collision"}) {
    const std::string empty = "<" + std::string(type) + "/>";
    EXPECT_EQ(load(empty + kBox + "<Transform>" + empty + "</Transform>" + empty + kBox).triangles.size(), 24u) << type;
  }
}

TEST(X3dPlain, AGroupIsThereAgainWhereItIsUsed) {
  const Model model = load("<Group DEF='g'>" + kBox + "<Transform translation='0 10 0'>" + kBox +
                           "</Transform></Group><Transform translation='100 0 0'><Group USE='g'/></Transform>" + kBox);
  EXPECT_EQ(model.triangles.size(), 12u * 5);
  EXPECT_TRUE(sizeOf(model).isApprox(Vec3(102, 14, 6)));
  const Model hidden = load("<LOD>" + kBox +
                            "<Transform DEF='t' translation='0 10 0'><Shape DEF='s'><Box size='1 1 1'/>"
                            "</Shape></Transform></LOD><Group><Shape USE='s'/></Group><Transform USE='t'/>");
  EXPECT_EQ(hidden.triangles.size(), 36u);
}

TEST(X3dPlain, AGroupWithinItselfIsLeftOut) {
  const Model model = load("<Group DEF='g'>" + kBox + "<Group USE='g'/></Group>");
  EXPECT_EQ(model.triangles.size(), 12u);
  EXPECT_TRUE(warns(model, "USE of 'g' within it"));
}

TEST(X3dPlain, WhatIsUsedWithoutEndIsRefused) {
  std::string nodes = "<Group DEF='g0'>" + kBox + "</Group>";
  for (int i = 1; i < 12; ++i) {
    nodes += "<Group DEF='g" + std::to_string(i) + "'>";
    for (int k = 0; k < 8; ++k) nodes += "<Group USE='g" + std::to_string(i - 1) + "'/>";
    nodes += "</Group>";
  }
  std::vector<std::string> warnings;
  EXPECT_THROW(plainX3d(document(nodes), warnings), Error);
}

TEST(X3dPlain, AConeStandsOnItsBase) {
  const Model cone = load("<Shape><Cone bottomRadius='2' height='6'/></Shape>");
  EXPECT_TRUE(sizeOf(cone).isApprox(Vec3(4, 6, 4)));
  for (const Vec3& p : cone.positions) EXPECT_NEAR(Vec2(p.x(), p.z()).norm(), p.y() > 0 ? 0 : 2, 1e-6);
  EXPECT_TRUE(cone.warnings.empty());
  EXPECT_EQ(load("<Shape><Cone bottom='false'/></Shape>").triangles.size(), 64u);
}

// The corners of the section lie in planes at right angles to the spine, about its points.
TEST(X3dPlain, AnExtrusionIsAtRightAnglesToItsSpine) {
  const Vec3 size = sizeOf(
      load("<Shape><Extrusion crossSection='.1 .1 .1 -.1 -.1 -.1 -.1 .1 .1 .1' spine='0 0 0 0 1 -1 0 2 -2'/></Shape>"));
  const double out = 0.1 / std::sqrt(2.0);
  EXPECT_TRUE(size.isApprox(Vec3(0.2, 2 + 2 * out, 2 + 2 * out), 1e-6)) << size.transpose();
  EXPECT_TRUE(sizeOf(load("<Shape><Extrusion/></Shape>")).isApprox(Vec3(2, 1, 2)));
  const std::string turned = "<Shape><Extrusion scale='1 2' orientation='0 9 0 1.5707963267948966'/></Shape>";
  EXPECT_TRUE(sizeOf(load(turned)).isApprox(Vec3(4, 1, 2), 1e-6));
  EXPECT_EQ(load("<Shape><Extrusion beginCap='false' endCap='false'/></Shape>").triangles.size(), 8u);
  // A square ring: each mitre is as wide as the section over the cosine of half the bend.
  const Model ring = load(
      "<Shape><Extrusion crossSection='.1 .1 .1 -.1 -.1 -.1 -.1 .1 .1 .1' beginCap='false' endCap='false' "
      "spine='1 0 1 1 0 -1 -1 0 -1 -1 0 1 1 0 1'/></Shape>");
  EXPECT_EQ(ring.triangles.size(), 32u);
  EXPECT_NEAR(sizeOf(ring).y(), 0.2, 1e-6);
}

TEST(X3dPlain, WhatIsNotVisibleIsNotThere) {
  EXPECT_EQ(load("<Shape visible='false'><Box size='9 9 9'/></Shape><Transform visible='false'>" + kBox +
                 "</Transform>" + kBox)
                .triangles.size(),
            12u);
}

TEST(X3dPlain, NormalsOfTriangleSetsAreRead) {
  const Model model = load(
      "<Shape><TriangleSet><Coordinate point='0 0 0 1 0 0 0 1 0'/><Normal vector='0 0 1 0 0 1 0 0 1'/>"
      "<TextureCoordinate point='0 0 1 0 0 1'/></TriangleSet></Shape>");
  EXPECT_EQ(model.triangles.size(), 1u);
  ASSERT_EQ(model.normals.size(), 3u);
  EXPECT_EQ(model.normals[0], Vec3::UnitZ());
}

TEST(X3dPlain, DoubledEndsAndTooLargeCountsAreNoCorners) {
  EXPECT_EQ(load("<Shape><IndexedFaceSet coordIndex='0 1 2 -1 -1 0 2 3 -7'>" + kSquare + "</IndexedFaceSet></Shape>")
                .triangles.size(),
            2u);
  const Model model =
      load("<Shape><TriangleStripSet stripCount='400'>" + kSquare + "</TriangleStripSet></Shape>" + kBox);
  EXPECT_EQ(model.triangles.size(), 12u);
  EXPECT_TRUE(warns(model, "more corners than it has points"));
}

TEST(X3dPlain, AFieldMayComeFromAnInstanceAroundIt) {
  const std::string outer =
      "<ProtoDeclare name='Outer'><ProtoInterface><field name='q' type='SFVec3f' accessType='inputOutput' value='1 1 "
      "1'/>"
      "</ProtoInterface><ProtoBody><ProtoInstance name='Crate'><IS><connect nodeField='size' protoField='q'/></IS>"
      "</ProtoInstance></ProtoBody></ProtoDeclare>";
  const Model model =
      load(kCrate + outer + "<ProtoInstance name='Outer'><fieldValue name='q' value='3 3 3'/></ProtoInstance>");
  EXPECT_TRUE(sizeOf(model).isApprox(Vec3(13, 3, 3)));
}

TEST(X3dPlain, WhatIsLeftOutIsNamed) {
  const Model model =
      load("<Inline url='\"b.x3d\"'/><Shape><Text string='\"a\"'/></Shape><ProtoInstance name='P'/>" + kBox);
  EXPECT_EQ(model.triangles.size(), 12u);
  for (const char* words : {"Inline", "Text", "ProtoInstance 'P'"}) EXPECT_TRUE(warns(model, words)) << words;
}

TEST(X3dPlain, PrototypesThatGrowWithoutEndAreRefused) {
  std::string nodes;
  const auto declare = [&](const std::string& name, const std::string& uses, int times) {
    nodes += "<ProtoDeclare name='" + name + "'><ProtoBody><Group>";
    for (int i = 0; i < times; ++i) nodes += "<ProtoInstance name='" + uses + "'/>";
    nodes += "</Group></ProtoBody></ProtoDeclare>";
  };
  std::vector<std::string> warnings;
  declare("A", "A", 1);
  EXPECT_THROW(withoutPrototypes(document(nodes + "<ProtoInstance name='A'/>"), warnings), Error);
  nodes.clear();
  for (int i = 0; i < 12; ++i) declare("L" + std::to_string(i), "L" + std::to_string(i + 1), 10);
  EXPECT_THROW(withoutPrototypes(document(nodes + "<ProtoInstance name='L0'/>"), warnings), Error);
}

TEST(X3dPlain, DamagedFilesNeverHarm) {
  const std::string whole =
      document(kCrate + "<ProtoInstance name='Crate' DEF='c'/><ProtoInstance USE='c'/><Shape><QuadSet>" + kSquare +
               "</QuadSet></Shape><LOD>" + kBox + "</LOD>");
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    std::string text = whole;
    for (int i = 0; i < 3; ++i) text[random() % text.size()] = whole[random() % whole.size()];
    if (round % 3 == 0) text.erase(random() % text.size(), random() % 40);
    std::vector<std::string> warnings;
    try {
      EXPECT_FALSE(plainX3d(withoutPrototypes(text, warnings), warnings).empty());
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace hl::test_x3d_plain
