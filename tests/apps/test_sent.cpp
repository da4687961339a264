// Files that a page sends: the program without rights that reads them gives what a file of the command line is.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/load_scene.h"
#include "io/load_sent.h"
#include "temp_folder.h"

namespace hl::test_sent {
namespace {

using test::fileWith;

SceneModel sent(const std::string& path, const std::string& name) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const std::unique_ptr<const int, void (*)(const int*)> closed(&file, [](const int* it) { close(*it); });
  const std::atomic<bool> given_up{false};
  return loadSent(file, name, {HL_PROGRAM, {"hl", "read-sent"}}, {}, given_up);
}

std::string refusalOfSent(const std::string& path, const std::string& name) {
  try {
    sent(path, name);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// To the bit: what their triangles are, and what they feel like.
void expectSame(const SceneModel& one, const SceneModel& other, const std::string& what) {
  ASSERT_EQ(one.surfaces.size(), other.surfaces.size()) << what;
  EXPECT_EQ(one.model.elements(), other.model.elements()) << what;
  for (std::size_t i = 0; i < one.surfaces.size(); ++i) {
    const SceneSurface &a = one.surfaces[i], &b = other.surfaces[i];
    EXPECT_EQ(a.name, b.name) << what;
    EXPECT_EQ(a.material, b.material) << what;
    ASSERT_EQ(a.source->count(), b.source->count()) << what;
    EXPECT_EQ(a.source->triangles(), b.source->triangles()) << what;
    EXPECT_EQ(a.source->bounds().min, b.source->bounds().min) << what;
    EXPECT_EQ(a.source->bounds().max, b.source->bounds().max) << what;
    const DrawnMesh drawn = a.source->drawn(10'000), again = b.source->drawn(10'000);
    EXPECT_EQ(drawn.positions, again.positions) << what;
  }
}

// Three hundred samples along each side: more than one thread would take them where there are several.
std::string manyHeights() {
  std::string values;
  for (int i = 0; i < 300 * 300; ++i) values += (i > 0 ? "," : "") + std::to_string(i % 7);
  return R"({"heights":{"columns":300,"rows":300,"values":[)" + values + "]}}";
}

TEST(SentScene, SurfacesOfASceneFileComeAsTheyAre) {
  const std::string volume = R"("volume":{"size":[2,2,2],"values":[0,0,0,0,1,1,1,1])";
  const std::vector<std::string> objects{
      R"({"heights":{"columns":2,"rows":2,"values":[0,0,0,1]},"material":{"stiffness":0.5}})",
      R"({"heights":{"columns":2,"rows":2,"values":[500,500,500,501],"camera":[10,10,0.5,0.5],"verticalScale":0.001}})",
      "{" + volume + R"(,"iso":0.5},"name":"wall"})",
      "{" + volume + R"(,"iso":0.5}},{)" + volume + R"(,"iso":0.25},"transform":{"translate":{"x":3}}})",
      R"({"cloud":{"positions":[0,0,0,1,0,0,0,1,0]}})",
      R"({"implicit":{"expression":{"sphere":{"radius":0.02}}}})",
      R"({"volume":{"builtin":"ct:phantom:41"}},{"volume":{"builtin":"ct:phantom:41","iso":300}})",
      R"({"cloud":{"builtin":"points:sphere:1000"}})",
      R"({"builtin":"sdf:torus"})",
      R"({"builtin":"sphere:500"},{"builtin":"sdf:torus"},{"cloud":{"builtin":"points:sphere:1000"}})",
      manyHeights()};
  for (const std::string& object : objects) {
    const std::string path = fileWith("surfaces.hl.json", "{\"objects\":[" + object + "]}");
    SceneModel came;
    ASSERT_NO_THROW(came = sent(path, "surfaces.hl.json")) << object.substr(0, 200);
    expectSame(came, loadScene(path), object.substr(0, 200));
  }
}

// Not the descriptor by which it is read.
TEST(SentScene, AnErrorOfItsTextNamesTheFileAndTheLine) {
  try {
    sent(fileWith("text.hl.json", "{\n\"objects\": [,]}"), "mine.hl.json");
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("mine.hl.json: line 2: this is not JSON")) << error.what();
  }
}

// Surfaces of one volume share its samples; there too.
TEST(SentScene, AVolumeThatIsSharedComesOnce) {
  const std::string path = fileWith("shared.hl.json", R"({"objects":[{"volume":{"builtin":"ct:phantom:41"}},
      {"volume":{"builtin":"ct:phantom:41","iso":300}}]})");
  const SceneModel came = sent(path, "shared.hl.json");
  ASSERT_EQ(came.surfaces.size(), 2u);
  EXPECT_EQ(came.surfaces[0].source->shared().of, came.surfaces[1].source->shared().of);
}

TEST(SentScene, ATileOfSrtmLiesWhereItsNameSays) {
  const std::string path = fileWith("N47E008.hgt", std::string(2 * 101 * 101, '\1'));
  expectSame(sent(path, "N47E008.hgt"), loadScene(path), "N47E008.hgt");
  const SceneModel elsewhere = sent(path, "N00E008.hgt");
  EXPECT_GT(elsewhere.surfaces.front().source->bounds().size().x(),
            1.4 * sent(path, "N47E008.hgt").surfaces.front().source->bounds().size().x());
}

TEST(SentScene, ErrorsNameTheFileAsItsUserDoes) {
  const std::string path = fileWith("cut.gltf", R"({"asset":{"version":"2.0"},"nodes":[)");
  const std::string refusal = refusalOfSent(path, "my part.gltf");
  EXPECT_TRUE(refusal.starts_with("my part.gltf: ")) << refusal;
  EXPECT_EQ(refusal.find("hl-sent-file"), std::string::npos) << refusal;
  EXPECT_EQ(refusal.find("/proc/"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace hl::test_sent
