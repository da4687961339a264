// CAD files through hl-cad: units, scenes, what is broken, and what is kept.
#include <gtest/gtest.h>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TDataStd_Name.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "cad/cad_document.h"
#include "cad_shapes.h"
#include "io/load_model.h"
#include "io/load_scene_file.h"
#include "load_refusal.h"
#include "scene/scene_model.h"
#include "temp_folder.h"

namespace hl::test_cad_file {
namespace {

namespace fs = std::filesystem;
using test::fileWith;
using test::loadRefusal;
using test::tempFile;

// What is kept stays with the test.
class CadFile : public testing::Test {
 protected:
  static fs::path cacheOfThis() {
    return test::tempFolder() / testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  static fs::path onlyEntry() { return fs::directory_iterator(cacheOfThis() / "hl")->path(); }
  void SetUp() override {
    setenv("XDG_CACHE_HOME", cacheOfThis().c_str(), 1);
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  }
};

std::string stepFile(const TopoDS_Shape& shape, const std::string& name, const char* unit = "MM") {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.unit", unit);
  STEPControl_Writer writer;
  writer.Transfer(shape, STEPControl_AsIs);
  writer.Write(tempFile(name).c_str());
  Interface_Static::SetCVal("write.step.unit", "MM");
  return tempFile(name);
}

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void expectSize(const Model& model, const Vec3& size) {
  EXPECT_LT((model.bounds().size() - size).cwiseAbs().maxCoeff(), 1e-8) << model.bounds().size().transpose();
}

TEST_F(CadFile, LengthsBecomeMetresWhateverTheUnitOfTheFile) {
  const TopoDS_Shape box = test::boxOf({0, 0, 0}, {10, 20, 30});
  const Vec3 size(0.01, 0.02, 0.03);
  for (const char* unit : {"MM", "INCH", "M"}) {
    SCOPED_TRACE(unit);
    const Model model = loadModel(stepFile(box, "box.step", unit));
    expectSize(model, size);
    EXPECT_EQ(model.triangles.size(), 12u);
    EXPECT_EQ(model.normals.size(), model.positions.size());
  }
  IGESControl_Writer iges("INCH", 0);
  iges.AddShape(box);
  iges.Write(tempFile("box.igs").c_str());
  expectSize(loadModel(tempFile("box.igs")), size);
  BRepTools::Write(box, tempFile("box.brep").c_str());
  expectSize(loadModel(tempFile("box.brep")), size);
}

TEST_F(CadFile, AnAssemblyHasAllItsParts) {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  gp_Trsf move;
  move.SetTranslation(gp_Vec(0, 0, 50));
  const TopoDS_Shape block = test::bored(5, 10);
  builder.Add(all, block);
  builder.Add(all, block.Moved(TopLoc_Location(move)));
  const Model model = loadModel(stepFile(all, "two.stp"));
  ASSERT_TRUE(model.reading.cad);
  EXPECT_EQ(model.reading.cad->solids, 2u);
  EXPECT_EQ(model.reading.cad->faces, 14u);
  expectSize(model, {0.02, 0.02, 0.06});
  EXPECT_GT(model.reading.cad->tolerance_m, 0);
}

// A red box and two balls of one part, the second of which is green in the assembly; and a box with a name of letters
// beyond ASCII, whose colour is that of its faces.
Handle(TDocStd_Document) assembly() {
  Handle(TDocStd_Document) document = newCadDocument();
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const auto paint = [&](const auto& what, int red, int green, int blue) {
    colours->SetColor(what, Quantity_Color(red / 255.0, green / 255.0, blue / 255.0, Quantity_TOC_sRGB),
                      XCAFDoc_ColorSurf);
  };
  const auto named = [](const TDF_Label& label, const char* name) {
    TDataStd_Name::Set(label, TCollection_ExtendedString(name, Standard_True));
    return label;
  };
  const auto at = [](double x) {
    gp_Trsf move;
    move.SetTranslation(gp_Vec(x, 0, 0));
    return TopLoc_Location(move);
  };
  const TopoDS_Shape plain = test::boxOf({0, 0, 0}, {5, 5, 5});
  const TDF_Label box = named(shapes->AddShape(test::boxOf({0, 0, 0}, {10, 20, 30}), Standard_False), "box");
  const TDF_Label ball = named(shapes->AddShape(BRepPrimAPI_MakeSphere(10).Shape(), Standard_False), "ball");
  const TDF_Label cube = named(shapes->AddShape(plain, Standard_False), "W\xc3\xbcrfel");
  paint(box, 200, 30, 40);
  paint(ball, 10, 20, 250);
  for (TopExp_Explorer face(plain, TopAbs_FACE); face.More(); face.Next())
    paint(shapes->AddSubShape(cube, face.Current()), 1, 128, 255);
  const TDF_Label whole = named(shapes->NewShape(), "whole");
  named(shapes->AddComponent(whole, box, at(0)), "box:1");
  shapes->AddComponent(whole, ball, at(50));
  paint(shapes->AddComponent(whole, ball, at(100)), 0, 255, 0);
  shapes->AddComponent(whole, cube, at(150));
  shapes->UpdateAssemblies();
  return document;
}

struct WantedPart {
  const char* name;
  std::optional<Rgb> colour;
  Vec3 low, high;
};

void expectParts(const std::string& path, const std::vector<WantedPart>& wanted) {
  LoadOptions options;
  options.cad = {1e-5, 0.1};
  const auto scene = makeSnapshot(loadModelScene(path, options));
  ASSERT_EQ(scene->instances.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Instance& part = scene->instances[i];
    ASSERT_TRUE(part.label);
    EXPECT_EQ(part.label->name, wanted[i].name);
    EXPECT_EQ(part.label->colour, wanted[i].colour) << wanted[i].name;
    EXPECT_LT((part.shape->bounds.min - wanted[i].low).norm(), 3e-5) << wanted[i].name;
    EXPECT_LT((part.shape->bounds.max - wanted[i].high).norm(), 3e-5) << wanted[i].name;
  }
}

TEST_F(CadFile, EachSolidIsAnObjectWithNameAndColour) {
  STEPCAFControl_Writer step;
  step.Transfer(assembly(), STEPControl_AsIs);
  step.Write(tempFile("whole.step").c_str());
  expectParts(tempFile("whole.step"), {{"box", Rgb{200, 30, 40}, {0, 0, 0}, {0.01, 0.02, 0.03}},
                                       {"ball", Rgb{10, 20, 250}, {0.04, -0.01, -0.01}, {0.06, 0.01, 0.01}},
                                       {"ball 2", Rgb{0, 255, 0}, {0.09, -0.01, -0.01}, {0.11, 0.01, 0.01}},
                                       {"W\xc3\xbcrfel", Rgb{1, 128, 255}, {0.15, 0, 0}, {0.155, 0.005, 0.005}}});
  const Model one = loadModel(tempFile("whole.step"));
  EXPECT_TRUE(one.parts.empty()) << "in a scene file it is one object";
  EXPECT_EQ(one.reading.cad->solids, 4u);
}

TEST_F(CadFile, SolidsOfIgesHaveNamesAndColoursToo) {
  Handle(TDocStd_Document) document = newCadDocument();
  const TDF_Label box =
      XCAFDoc_DocumentTool::ShapeTool(document->Main())->AddShape(test::boxOf({0, 0, 0}, {10, 20, 30}), Standard_False);
  TDataStd_Name::Set(box, TCollection_ExtendedString("box"));
  XCAFDoc_DocumentTool::ColorTool(document->Main())
      ->SetColor(box, Quantity_Color(0.2, 0.4, 1, Quantity_TOC_sRGB), XCAFDoc_ColorSurf);
  IGESControl_Controller::Init();
  Interface_Static::SetIVal("write.iges.brep.mode", 1);  // solids, and not only faces
  IGESCAFControl_Writer iges;
  iges.Transfer(document);
  iges.ComputeModel();
  iges.Write(tempFile("box.iges").c_str());
  Interface_Static::SetIVal("write.iges.brep.mode", 0);
  expectParts(tempFile("box.iges"), {{"box", Rgb{51, 102, 255}, {0, 0, 0}, {0.01, 0.02, 0.03}}});
}

// Solids without names are numbered, and what is no solid is an object too.
TEST_F(CadFile, WhatHasNoNameIsNumberedAndWhatIsNoSolidIsKept) {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  builder.Add(all, test::boxOf({0, 0, 0}, {10, 10, 10}));
  builder.Add(all, test::boxOf({20, 0, 0}, {30, 10, 10}));
  const TopoDS_Shape loose = test::boxOf({40, 0, 0}, {50, 10, 20});
  builder.Add(all, TopExp_Explorer(loose, TopAbs_FACE).Current());
  BRepTools::Write(all, tempFile("bare.brep").c_str());
  expectParts(tempFile("bare.brep"), {{"solid", {}, {0, 0, 0}, {0.01, 0.01, 0.01}},
                                      {"solid 2", {}, {0.02, 0, 0}, {0.03, 0.01, 0.01}},
                                      {"what is no solid", {}, {0.04, 0, 0}, {0.04, 0.01, 0.02}}});
}

TEST_F(CadFile, SceneFilesSayHowTheyAreMeshed) {
  stepFile(BRepPrimAPI_MakeSphere(10).Shape(), "ball.step");
  const auto scene = [](const std::string& more) {
    return fileWith("s.hl.json", R"({"objects": [{"file": "ball.step")" + more + "}]}");
  };
  const SceneModel coarse = loadSceneFile(scene(R"(, "meshing": {"deflectionM": 1e-4, "angleRad": 0.5})"));
  const SceneModel fine = loadSceneFile(scene(R"(, "meshing": {"deflectionM": 1e-5})"));
  EXPECT_GT(fine.model.triangles.size(), 2 * coarse.model.triangles.size());
  EXPECT_EQ(coarse.model.reading.cad->deflection_m, 1e-4);
  for (const char* bad : {R"(, "meshing": {"deflectionM": -1})", R"(, "meshing": {"angleRad": 4})"})
    EXPECT_THROW(loadSceneFile(scene(bad)), Error) << bad;
  EXPECT_THROW(loadSceneFile(fileWith("t.hl.json", R"({"objects": [{"builtin": "teapot", "meshing": {}}]})")), Error);
}

TEST_F(CadFile, WhatIsBrokenGivesOneLine) {
  const std::string good = contentOf(stepFile(test::bored(5, 10), "good.step"));
  std::vector<std::string> paths{fileWith("empty.step", ""), fileWith("other.brep", good), fileWith("other.igs", good)};
  for (const std::size_t part : {1u, 3u, 7u})
    paths.push_back(fileWith("cut" + std::to_string(part) + ".step", good.substr(0, good.size() * part / 8)));
  for (const char* ending : {".step", ".iges", ".brep"}) {
    paths.push_back(fileWith(std::string("noise") + ending, std::string(3000, '\x9e')));
    paths.push_back(fileWith(std::string("text") + ending, "nothing of the kind\n"));
  }
  for (const std::string& path : paths) {
    const std::string line = loadRefusal(path);
    EXPECT_TRUE(line.starts_with(path + ": ")) << path << " '" << line << "'";
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

// At many places: OpenCASCADE goes on for ever where a number of a BREP file is missing, and takes what is there of
// IGES.
TEST_F(CadFile, CutFilesAreRefused) {
  const TopoDS_Shape shape = test::bored(5, 10);
  const std::string brep = tempFile("whole.brep"), iges = tempFile("whole.igs");
  BRepTools::Write(shape, brep.c_str());
  IGESControl_Writer writer;
  writer.AddShape(shape);
  writer.Write(iges.c_str());
  for (const std::string& whole : {brep, iges}) {
    ASSERT_EQ(loadRefusal(whole), "");
    const std::string content = contentOf(whole), ending = whole.substr(whole.find_last_of('.'));
    for (std::size_t part = 1; part < 20; ++part) {
      const std::string line = loadRefusal(fileWith("cut" + ending, content.substr(0, content.size() * part / 20)));
      EXPECT_NE(line, "") << part << ending;
      EXPECT_EQ(line.find("too long"), std::string::npos) << part << ending;
    }
  }
}

TEST_F(CadFile, ASecondReadingGivesTheSameAndABrokenEntryIsMadeAnew) {
  const std::string path = stepFile(test::rounded(2), "part.step");
  LoadOptions options;
  options.cad = {1e-4, 0.3};
  const Model first = loadModel(path, options);
  ASSERT_EQ(std::distance(fs::directory_iterator(cacheOfThis() / "hl"), {}), 1);
  const std::string entry = contentOf(onlyEntry());
  const auto expectSame = [&](const Model& model) {
    EXPECT_EQ(model.positions, first.positions);
    EXPECT_EQ(model.normals, first.normals);
    EXPECT_EQ(model.triangles, first.triangles);
    EXPECT_EQ(model.reading.cad->error_m, first.reading.cad->error_m);
  };
  expectSame(loadModel(path, options));
  for (const std::size_t at : {std::size_t{0}, entry.size() / 2, entry.size() - 1}) {
    std::string broken = entry;
    broken[at] = static_cast<char>(broken[at] ^ 4);
    std::ofstream(onlyEntry(), std::ios::binary) << broken;
    expectSame(loadModel(path, options));
    EXPECT_EQ(contentOf(onlyEntry()), entry) << at;
  }
  std::ofstream(onlyEntry(), std::ios::binary) << entry.substr(0, 100);
  expectSame(loadModel(path, options));
  options.cad.deflection_m = 1e-5;
  EXPECT_NE(loadModel(path, options).positions, first.positions);
}

TEST_F(CadFile, FilesOfOthersAreRead) {
  for (const char* name : {"step/screw.step", "occ/bottle.brep", "iges/bearing.iges"}) {
    const fs::path path = fs::path("/usr/share/opencascade/data") / name;
    if (!fs::exists(path)) GTEST_SKIP() << path << ": not installed (occt-misc)";
    LoadOptions options;
    options.cad = {2e-5, 0.3};
    const Model model = loadModel(path, options);
    EXPECT_GT(model.triangles.size(), 500u) << name;
    EXPECT_LT(model.reading.cad->error_m, options.cad.deflection_m + model.reading.cad->tolerance_m) << name;
  }
}

}  // namespace
}  // namespace hl::test_cad_file
