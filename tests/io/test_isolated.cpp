// The process that reads foreign files: whatever it does, the program that asked gets one line in bounded time and
// keeps no process and no descriptor; and it can do nothing but read.
#include "io/isolated.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "io/load_image.h"
#include "io/load_model.h"
#include "io/model_parts.h"
#include "io/reading_cache.h"
#include "io/sandbox.h"
#include "temp_folder.h"

namespace hl::test_isolated {
namespace {

namespace fs = std::filesystem;
using test::fileWith;
using test::tempFile;
using Report = std::function<void(double)>;

IsolationLimits small() {
  IsolationLimits limits;
  limits.cpu_s = 5;
  limits.memory_bytes = std::size_t{1} << 30;
  return limits;
}

/// For a reader that is to be refused anyway: not waited for.
IsolationLimits hasty() {
  IsolationLimits limits = small();
  limits.idle_s = 0.5;
  return limits;
}

std::ptrdiff_t openDescriptors() {
  return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

/// What is wrong with an error that ended a reading, or "".
std::string faultOf(const std::string& line, std::ptrdiff_t descriptors_before) {
  if (line.empty()) return "it was taken";
  if (line.find('\n') != std::string::npos) return "more than one line: " + line;
  if (openDescriptors() != descriptors_before) return "a descriptor is left open";
  if (waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD) return "a process is left";
  return "";
}

std::string refusalOf(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string refusalOf(const std::function<Model(const Report&)>& parse, const IsolationLimits& limits = small()) {
  return refusalOf([&] { runIsolated("it", limits, parse, nullptr); });
}

void put(const void* data, std::size_t size) {
  if (::write(kKeptDescriptor, data, size) < 0) _exit(1);
}
void putLength(std::uint32_t length) { put(&length, sizeof length); }

Model points(std::size_t count) {
  Model model;
  for (std::size_t i = 0; i < count; ++i) model.positions.emplace_back(static_cast<double>(i), 0, 0);
  for (std::uint32_t i = 0; i < count; ++i) model.points.push_back(i);
  return model;
}

struct Misdeed {
  const char* name;
  std::function<Model(const Report&)> parse;
};

std::vector<Misdeed> misdeeds() {
  return {
      {"crashes", [](const Report&) -> Model { std::abort(); }},
      {"is killed",
       [](const Report&) -> Model {
         raise(SIGKILL);
         return {};
       }},
      {"stops", [](const Report&) -> Model { _exit(0); }},
      {"waits",
       [](const Report&) -> Model {
         for (;;) pause();
       }},
      {"closes its pipe and waits",
       [](const Report&) -> Model {
         close(kKeptDescriptor);
         for (;;) pause();
       }},
      {"writes garbage",
       [](const Report&) -> Model {
         for (int i = 0; i < 1000; ++i) put("garbage", 7);
         _exit(0);
       }},
      {"writes a message that is none",
       [](const Report&) -> Model {
         putLength(4);
         put("\xff\xff\xff\xff", 4);
         _exit(0);
       }},
      {"says nothing",
       [](const Report&) -> Model {
         for (;;) putLength(0);
       }},
      {"tells of more than it writes",
       [](const Report&) -> Model {
         putLength(1'000'000);
         put("x", 1);
         _exit(0);
       }},
      {"tells of 4 GB",
       [](const Report&) -> Model {
         putLength(0xffffffff);
         for (;;) pause();
       }},
      {"gives indices that are out of range",
       [](const Report&) {
         Model model = points(3);
         model.points[1] = 3;
         return model;
       }},
      {"gives normals that are too few",
       [](const Report&) {
         Model model = points(3);
         model.normals.resize(2, Vec3::Zero());
         return model;
       }},
      {"gives a texture without texels",
       [](const Report&) {
         Model model = points(3);
         model.textures.resize(1);
         return model;
       }},
      {"gives a material that is none",
       [](const Report&) {
         Model model = points(3);
         model.materials[0].stiffness = -1;
         return model;
       }},
      {"throws many lines", [](const Report&) -> Model { throw Error("one\ntwo\nthree"); }},
  };
}

TEST(Isolated, WhateverTheReaderDoesIsOneLineAndNothingIsLeft) {
  for (const Misdeed& misdeed : misdeeds()) {
    const std::ptrdiff_t before = openDescriptors();
    EXPECT_EQ(faultOf(refusalOf(misdeed.parse, hasty()), before), "") << misdeed.name;
  }
}

TEST(Isolated, AModelComesBackWhole) {
  Model model = points(600'000);
  model.normals.assign(model.positions.size(), Vec3::UnitZ());
  model.textures = {makeTexture("noise", 32)};
  model.materials.resize(2);
  model.materials[1].textureOf(Quantity::kStiffness) = {0, 0.25, 1};
  model.point_materials.assign(model.points.size(), 1);
  model.warnings = {"one", "two"};
  model.reading = {7, true};
  double last = 0;
  const Model back = runIsolated(
                         "it", small(),
                         [&](const Report& report) {
                           report(0.25);
                           return model;
                         },
                         [&](double fraction) { last = fraction; })
                         .model;
  EXPECT_EQ(last, 0.25);
  EXPECT_TRUE(back.positions == model.positions && back.normals == model.normals && back.points == model.points &&
              back.point_materials == model.point_materials && back.materials == model.materials);
  EXPECT_EQ(back.textures[0].texels, model.textures[0].texels);
  EXPECT_EQ(back.warnings, model.warnings);
  EXPECT_EQ(back.reading.joined_vertices, 7u);
}

SceneModel withBodies() {
  SceneModel scene(points(10));
  scene.mechanics.gravity_m_s2 = Vec3(1, 2, 3);
  scene.snaps = {{"a", {Vec3(1, 2, 3)}, {}, 0.5, 2}, {"b", {Vec3(1, 2, 3)}, Vec3::UnitY(), 0.5, 2}};
  scene.fields = {{"c", FieldKind::kConstant, {Vec3(1, 2, 3)}, Vec3::UnitY(), 0.5, 2, 0, 0, Vec3::UnitZ()}};
  for (int i = 1; i < 4; ++i) {
    SceneBody body;
    body.name = "body " + std::to_string(i);
    body.model = points(1000 * static_cast<std::size_t>(i));
    for (std::size_t k = 0; k < body.model.positions.size(); ++k)
      body.model.positions[k] = Vec3(k % 2 == 0 ? 1 : -1, k % 3 == 0 ? 1 : -1, k % 5 == 0 ? 1 : -1);
    body.model.textures = {makeTexture("noise", 8)};
    body.model.materials[0].textureOf(Quantity::kStiffness) = {0, 0.25, 1};
    body.model.warnings = {"of " + body.name};
    body.pose.origin = Vec3(i, 0, 0);
    body.spec.mass_kg = i;
    body.spec.shape = BodyShape::kBall;
    body.spec.fixed = i == 3;
    FieldSpec field{"f", FieldKind::kDrag, {Vec3(i, 2, 3)}, {}, 0.1 * i, 0, 0, 2, Vec3::Zero()};
    body.fields = {field};
    body.snaps = {{"of " + body.name, {Vec3(i, 2, 3), Vec3(4, 5, 6)}, {}, 0.1 * i, 2}};
    scene.bodies.push_back(body);
  }
  return scene;
}

TEST(Isolated, ASceneWithBodiesComesBackWhole) {
  const SceneModel scene = withBodies();
  const SceneModel back = runIsolated("it", small(), [&](const Report&) { return scene; }, {});
  EXPECT_EQ(back.model.positions, scene.model.positions);
  EXPECT_TRUE(back.model.warnings.empty());
  EXPECT_EQ(back.mechanics.gravity_m_s2, scene.mechanics.gravity_m_s2);
  EXPECT_EQ(back.snaps, scene.snaps);
  EXPECT_EQ(back.fields, scene.fields);
  ASSERT_EQ(back.bodies.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const SceneBody &a = scene.bodies[i], &b = back.bodies[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_TRUE(a.spec == b.spec && a.pose == b.pose && a.snaps == b.snaps && a.fields == b.fields);
    EXPECT_TRUE(a.model.positions == b.model.positions && a.model.points == b.model.points);
    EXPECT_TRUE(a.model.materials == b.model.materials && a.model.warnings == b.model.warnings);
    EXPECT_EQ(a.model.textures[0].texels, b.model.textures[0].texels);
  }
}

// Those that cannot move are no bodies for the solver: a wall may be of any number of them.
TEST(Isolated, OfBodiesThatStayThereMayBeMoreThanCanMove) {
  SceneModel scene = withBodies();
  SceneBody fixed = scene.bodies.back();
  fixed.snaps.clear();
  fixed.fields.clear();
  SceneBody moves = fixed;
  moves.spec.fixed = false;
  const auto back = [&](std::size_t many_fixed, std::size_t many_moving) {
    scene.bodies.assign(many_fixed, fixed);
    scene.bodies.insert(scene.bodies.end(), many_moving, moves);
    return runIsolated("it", {}, [&](const Report&) { return scene; }, {}).bodies.size();
  };
  EXPECT_EQ(back(kMaxBodies + 1, kMaxBodies), 2 * kMaxBodies + 1);
  EXPECT_THROW(back(0, kMaxBodies + 1), Error);
}

Model twoTriangles() {
  Model model;
  model.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  model.triangles = {{0, 1, 2}, {3, 4, 5}};
  model.parts = {{"bolt\nand more", Rgb{1, 2, 3}, 3, 1, 0}, {"nut", {}, 3, 1, 0}};
  return model;
}

TEST(Isolated, TheObjectsOfAModelComeBackWithNamesAndColours) {
  const auto scene =
      makeSnapshot(runIsolated("m", small(), [](const auto&) { return SceneModel(twoTriangles()); }, {}));
  ASSERT_EQ(scene->instances.size(), 2U);
  EXPECT_EQ(*scene->instances[0].label, (Label{"bolt", Rgb{1, 2, 3}}));
  EXPECT_EQ(*scene->instances[1].label, (Label{"nut"}));
  EXPECT_EQ(scene->instances[1].shape->bounds.min, Vec3(5, 0, 0));
  Model broken = twoTriangles();
  broken.parts[1].vertices = 4;
  EXPECT_THROW(runIsolated("m", small(), [&](const auto&) { return SceneModel(broken); }, {}), Error);
}

TEST(Isolated, SnapsThatCannotBeAreRefused) {
  const auto changed = [](const std::function<void(SnapList&)>& change) {
    return refusalOf([&] {
      runIsolated("it", hasty(),
                  [&](const Report&) {
                    SceneModel scene = withBodies();
                    change(scene.snaps);
                    return scene;
                  },
                  {});
    });
  };
  EXPECT_EQ(changed([](SnapList&) {}), "");
  EXPECT_NE(changed([](SnapList& snaps) { snaps[0].points.clear(); }), "");
  EXPECT_NE(changed([](SnapList& snaps) { snaps[0].points[0].x() = HUGE_VAL; }), "");
  EXPECT_NE(changed([](SnapList& snaps) { snaps[0].capture_m = std::nan(""); }), "");
  EXPECT_NE(changed([](SnapList& snaps) { snaps[0].release_N = 0; }), "");
  EXPECT_NE(changed([](SnapList& snaps) { snaps[1].normal = Vec3(2, 0, 0); }), "");
  EXPECT_NE(changed([](SnapList& snaps) { snaps[1].points.emplace_back(0, 0, 0); }), "");
  EXPECT_NE(changed([](SnapList& snaps) { snaps.resize(kMaxSnaps, snaps[0]); }), "");
}

TEST(Isolated, FieldsThatCannotBeAreRefused) {
  const auto changed = [](const std::function<void(FieldList&)>& change) {
    return refusalOf([&] {
      runIsolated("it", hasty(),
                  [&](const Report&) {
                    SceneModel scene = withBodies();
                    change(scene.fields);
                    return scene;
                  },
                  {});
    });
  };
  EXPECT_EQ(changed([](FieldList&) {}), "");
  EXPECT_NE(changed([](FieldList& fields) { fields[0].kind = static_cast<FieldKind>(9); }), "");
  EXPECT_NE(changed([](FieldList& fields) { fields[0].points.clear(); }), "");
  EXPECT_NE(changed([](FieldList& fields) { fields[0].reach_m = std::nan(""); }), "");
  EXPECT_NE(changed([](FieldList& fields) { fields[0].force_N = -1; }), "");
  EXPECT_NE(changed([](FieldList& fields) { fields[0].direction.setZero(); }), "");
  EXPECT_NE(changed([](FieldList& fields) { fields.resize(kMaxFields, fields[0]); }), "");
}

TEST(Isolated, BodiesThatCannotBeAreRefused) {
  const auto changed = [](const std::function<void(SceneBody&)>& change) {
    return [change](const Report&) {
      SceneModel scene = withBodies();
      change(scene.bodies[0]);
      return scene;
    };
  };
  const auto refused = [&](const std::function<void(SceneBody&)>& change) {
    return refusalOf([&] { runIsolated("it", small(), changed(change), {}); });
  };
  EXPECT_EQ(refused([](SceneBody&) {}), "");
  EXPECT_NE(refused([](SceneBody& body) { body.spec.mass_kg = -1; }), "");
  EXPECT_NE(refused([](SceneBody& body) { body.spec.velocity_m_s.x() = NAN; }), "");
  EXPECT_NE(refused([](SceneBody& body) { body.pose.rotation(0, 0) = 2; }), "");
  EXPECT_NE(refused([](SceneBody& body) { body.model.positions.assign(body.model.positions.size(), Vec3::Zero()); }),
            "");
}

TEST(Isolated, TimeOfTheProcessorIsBounded) {
  const auto spin = [](const Report&) -> Model {
    for (std::atomic<int> i = 0;; ++i) {
    }
  };
  IsolationLimits limits = small();
  limits.cpu_s = 1;
  EXPECT_NE(refusalOf(spin, limits).find("takes too long"), std::string::npos);
}

TEST(Isolated, SoIsAllTimeEvenOfOneThatReportsProgress) {
  const auto chat = [](const Report& report) -> Model {
    for (;; usleep(1000)) report(0.5);
  };
  IsolationLimits limits = small();
  limits.wall_s = 1;
  EXPECT_NE(refusalOf(chat, limits).find("takes too long"), std::string::npos);
}

#ifndef HL_SANITIZED  // sanitizers reserve terabytes of addresses: there the limit is not set
TEST(Isolated, MemoryIsBounded) {
  const auto hungry = [](const Report&) -> Model {
    const std::vector<char> all(std::size_t{16} << 30, 'x');
    return points(all.size() % 2);
  };
  EXPECT_NE(refusalOf(hungry).find("more memory"), std::string::npos);
}
#endif

TEST(LoadModel, AFaceOfBillionsOfCornersIsCut) {
  const std::string path = fileWith(
      "face.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uint int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n");
  EXPECT_NE(refusalOf([&] { loadModel(path); }).find("is no whole element of the kind 'face'"), std::string::npos);
}
TEST(Isolated, AModelOfMoreThanTheMemoryIsRefusedWhereItComes) {
  const auto endless = [](const Report&) -> Model {
    PartSender sender(kKeptDescriptor);
    proto::RecordedShape shape;
    writeMesh(points(200'000), [&](proto::RecordedShape& part) { shape = part; });
    shape.set_continues(true);
    proto::ReadingPart part;
    *part.mutable_mesh() = shape;
    const std::string bytes = part.SerializeAsString();
    for (;;) {
      putLength(static_cast<std::uint32_t>(bytes.size()));
      put(bytes.data(), bytes.size());
    }
  };
  const std::ptrdiff_t before = openDescriptors();
  EXPECT_EQ(faultOf(refusalOf(endless), before), "");
}

/// Tries what a reader of files has no use for; the names of what was not refused.
std::string held() {
  std::string done;
  const std::string file = tempFile("written");
  if (open(file.c_str(), O_WRONLY | O_CREAT, 0600) >= 0) done += " create";
  if (open(tempFile("there").c_str(), O_RDWR) >= 0) done += " write";
  if (truncate(tempFile("there").c_str(), 0) == 0) done += " truncate";
  if (unlink(tempFile("there").c_str()) == 0) done += " unlink";
  if (mkdir(tempFile("made").c_str(), 0700) == 0) done += " mkdir";
  if (socket(AF_INET, SOCK_STREAM, 0) >= 0) done += " socket";
  if (socket(AF_UNIX, SOCK_STREAM, 0) >= 0) done += " unix-socket";
  if (kill(getppid(), 0) == 0) done += " signal";
  const rlimit more{RLIM_INFINITY, RLIM_INFINITY};
  if (setrlimit(RLIMIT_CPU, &more) == 0) done += " limit";
  const pid_t child = fork();
  if (child == 0) _exit(0);
  if (child > 0) done += " fork";
  if (open(tempFile("there").c_str(), O_RDONLY) < 0) done += " and can not read";
  return done;
}

TEST(Isolated, TheReaderCanOnlyRead) {
  fileWith("there", "something");
  constexpr int kAboveThePipe = 50;
  const int opened = open(tempFile("there").c_str(), O_RDWR), secret = fcntl(opened, F_DUPFD, kAboveThePipe);
  close(opened);
  const std::string refusal = refusalOf([&](const Report&) -> Model {
    char byte = 0;
    throw Error("done:" + held() + (::write(secret, "x", 1) == 1 ? " inherited" : "") +
                (::read(secret, &byte, 1) == 1 ? " read" : ""));
  });
  close(secret);
  EXPECT_EQ(refusal, "it: done:");
}

// As a series of DICOM needs it. An iterator reports what goes wrong by throwing.
TEST(Isolated, TheReaderListsFolders) {
  const std::string file = fileWith("listed", "something");
  const auto list = [&](const Report&) -> Model {
    std::string found;
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(file).parent_path()))
      if (entry.path() == file) found = "listed";
    throw Error(found);
  };
  EXPECT_EQ(refusalOf(list), "it: listed");
}

TEST(Sandbox, LandlockAloneKeepsFilesFromBeingWritten) {
  fileWith("there", "something");
  const pid_t child = fork();
  if (child == 0) {
    if (!allowReadingByLandlock()) _exit(2);
    const bool wrote = open(tempFile("there").c_str(), O_RDWR) >= 0 || mkdir(tempFile("made").c_str(), 0700) == 0;
    const bool read = open(tempFile("there").c_str(), O_RDONLY) >= 0;
    _exit(wrote || !read ? 1 : 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WEXITSTATUS(status) == 2) GTEST_SKIP() << "this kernel has no Landlock";
  EXPECT_EQ(status, 0);
}

/// Model files that name files which are none.
std::vector<std::string> trapsWith(const std::string& name) {
  return {fileWith("trap.obj", "mtllib " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"),
          fileWith("trap.wrl", "#VRML V2.0 utf8\nInline { url \"" + name + "\" }\n"),
          fileWith("trap.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
                                    name + R"("}]})")};
}

TEST(LoadModel, AFileThatNamesAFifoDoesNotWaitForIt) {
  mkfifo(tempFile("fifo").c_str(), 0600);
  LoadOptions options;
  options.limits = hasty();
  for (const std::string& path : trapsWith("fifo")) {
    const std::ptrdiff_t before = openDescriptors();
    const std::string fault = faultOf(refusalOf([&] { loadModel(path, options); }), before);
    EXPECT_TRUE(fault.empty() || fault == "it was taken") << path << ": " << fault;
  }
  EXPECT_NE(refusalOf([&] { loadModel(trapsWith("fifo")[0], options); }).find("waits"), std::string::npos);
}

TEST(LoadModel, AnEndlessFileIsNoHarm) {
  fs::create_symlink("/dev/zero", tempFile("endless"));
  LoadOptions options;
  options.limits = hasty();
  for (const std::string& path : trapsWith("endless")) {
    const std::ptrdiff_t before = openDescriptors();
    const std::string fault = faultOf(refusalOf([&] { loadModel(path, options); }), before);
    EXPECT_TRUE(fault.empty() || fault == "it was taken") << path << ": " << fault;
  }
  for (const char* name : {"direct.obj", "direct.ply", "direct.wrl", "direct.png"}) {
    fs::create_symlink("/dev/zero", tempFile(name));
    const bool image = std::string(name).ends_with("png");
    EXPECT_NE(refusalOf([&] { image ? void(loadImage(tempFile(name))) : void(loadModel(tempFile(name), options)); }),
              "");
  }
}

// What is kept of a file is found by its content and options, and only as long as it is whole.
TEST(ReadingCache, GivesWhatWasKeptOrNothing) {
  const std::string folder = tempFile("cache");
  const ReadingCache cache(folder);
  const auto keyOf = [&](const std::string& content, const std::string& options) {
    const int file = open(fileWith("source", content).c_str(), O_RDONLY | O_CLOEXEC);
    const std::string key = cache.keyOf(file, options);
    close(file);
    return key;
  };
  SceneModel scene;
  scene.model.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0.1)};
  scene.model.triangles = {{0, 1, 2}};
  scene.model.reading.cad = CadReading{1e-6, 0.1, 2e-6, 3e-7, 4, 5};
  const std::string key = keyOf("a", "fine");
  EXPECT_FALSE(cache.find(key, {}));
  cache.keep(key, scene);
  const std::optional<SceneModel> found = cache.find(key, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->model.positions, scene.model.positions);
  EXPECT_EQ(found->model.reading.cad->tolerance_m, 3e-7);
  EXPECT_FALSE(cache.find(keyOf("b", "fine"), {}));
  EXPECT_FALSE(cache.find(keyOf("a", "coarse"), {}));
  const std::string other = keyOf("b", "fine");
  fs::copy(folder + "/" + key + ".reading", folder + "/" + other + ".reading");
  EXPECT_FALSE(cache.find(other, {}));  // an entry under another's name
}

TEST(ReadingCache, KeepsNoMoreThanItMayAndNothingWithoutAFolder) {
  SceneModel scene;
  scene.model.positions.assign(1000, Vec3::Zero());
  scene.model.points = {0};
  const ReadingCache cache(tempFile("small-cache"), 60'000);
  for (const char* key : {"a", "b", "c", "d"}) cache.keep(key, scene);
  EXPECT_TRUE(cache.find("d", {}));
  EXPECT_EQ(std::distance(fs::directory_iterator(tempFile("small-cache")), {}), 2);
  ReadingCache("").keep("a", scene);
  EXPECT_FALSE(ReadingCache("").find("a", {}));
  ReadingCache(fileWith("no-folder", "x")).keep("a", scene);
}

}  // namespace
}  // namespace hl::test_isolated
