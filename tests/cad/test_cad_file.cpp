// CAD files through hl-cad: units, scenes, what is broken, and what is kept.
#include <gtest/gtest.h>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TopoDS_Compound.hxx>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "base/error.h"
#include "cad_shapes.h"
#include "io/load_model.h"
#include "io/load_scene_file.h"
#include "scene/scene_model.h"
#include "temp_folder.h"

namespace hl {
namespace {

namespace fs = std::filesystem;
using test::fileWith;
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

std::string refusalOf(const std::string& path) {
  try {
    loadModel(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
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
    const std::string line = refusalOf(path);
    EXPECT_TRUE(line.starts_with(path + ": ")) << path << " '" << line << "'";
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
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
}  // namespace hl
