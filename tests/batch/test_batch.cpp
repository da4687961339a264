// The batch calls: what they promise of many is what one does alone, and bad input changes nothing.
#include <gtest/gtest.h>
#include <hl/hl_batch.h>

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

#include "batch/ends_early.h"
#include "geometry/scenes.h"
#include "io/load_scene.h"
#include "temp_folder.h"
#include "tools/trace.h"

namespace hl::test_batch {
namespace {

using Scene = std::unique_ptr<HLbatchScene, decltype(&hlBatchDeleteScene)>;
using Fingers = std::unique_ptr<HLbatchFingers, decltype(&hlBatchDeleteFingers)>;

Scene load(const char* name) { return {hlBatchLoadScene(name, 0.1), &hlBatchDeleteScene}; }

HLbatchSettings rough() {
  HLbatchSettings settings;
  hlBatchSettings(&settings);
  settings.smooth = HL_TRUE;
  EXPECT_EQ(hlBatchSurface(&settings, HL_STATIC_FRICTION, 0.5), HL_NO_ERROR);
  EXPECT_EQ(hlBatchSurface(&settings, HL_DYNAMIC_FRICTION, 0.3), HL_NO_ERROR);
  return settings;
}

struct Results {
  explicit Results(std::size_t rows) : proxy(3 * rows), force(3 * rows), injected(rows), contacts(rows) {}
  std::vector<double> proxy, force, injected;
  std::vector<HLint> contacts;
  HLbatchResult pointers() { return {proxy.data(), force.data(), contacts.data(), injected.data()}; }
  bool operator==(const Results&) const = default;
};

// Fingers that wander about the middle of each of the sides of the scene, sample by sample.
std::vector<double> walk(test::Random& random, std::size_t samples, bool with_times) {
  std::vector<double> numbers;
  Vec3 finger = 0.05 * random.direction();
  for (std::size_t i = 0; i < samples; ++i) {
    finger += 1e-3 * random.inCube(1) - 0.01 * finger;
    if (with_times) numbers.push_back(1e-3 * static_cast<double>(i));
    numbers.insert(numbers.end(), finger.data(), finger.data() + 3);
  }
  return numbers;
}

TEST(Batch, FingersTogetherHaveTheBitsOfEachAlone) {
  constexpr std::size_t kFingers = 70, kSteps = 60;
  const Scene scene = load("teapot");
  ASSERT_TRUE(scene) << hlBatchError();
  const HLbatchSettings settings = rough();
  test::Random random(1);
  std::vector<std::vector<double>> ways;
  for (std::size_t i = 0; i < kFingers; ++i) ways.push_back(walk(random, kSteps, false));
  std::vector<Results> together;
  int touched = 0;
  for (const HLint threads : {0, 1, 3}) {
    const Fingers fingers(hlBatchMakeFingers(scene.get(), &settings, kFingers), &hlBatchDeleteFingers);
    ASSERT_TRUE(fingers);
    Results all(kFingers * kSteps);
    for (std::size_t step = 0; step < kSteps; ++step) {
      std::vector<double> positions;
      for (const auto& way : ways) positions.insert(positions.end(), &way[3 * step], &way[3 * step] + 3);
      const HLbatchResult at{&all.proxy[3 * step * kFingers], &all.force[3 * step * kFingers],
                             &all.contacts[step * kFingers], &all.injected[step * kFingers]};
      ASSERT_EQ(hlBatchStep(fingers.get(), positions.data(), threads, &at), HL_NO_ERROR) << hlBatchError();
    }
    together.push_back(all);
  }
  EXPECT_EQ(together[0], together[1]);
  EXPECT_EQ(together[0], together[2]);
  for (std::size_t i = 0; i < kFingers; ++i) {
    const Fingers alone(hlBatchMakeFingers(scene.get(), &settings, 1), &hlBatchDeleteFingers);
    for (std::size_t step = 0; step < kSteps; ++step) {
      Results one(1);
      const HLbatchResult at = one.pointers();
      ASSERT_EQ(hlBatchStep(alone.get(), &ways[i][3 * step], 1, &at), HL_NO_ERROR);
      const std::size_t row = step * kFingers + i;
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(one.proxy[k], together[0].proxy[3 * row + k]);
        ASSERT_EQ(one.force[k], together[0].force[3 * row + k]);
      }
      touched += one.contacts[0] > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(touched, 500);
}

TEST(Batch, ATraceOfManyPathsIsThatOfHlTrace) {
  constexpr std::size_t kPaths = 40;
  const Scene scene = load("rough:2000");
  ASSERT_TRUE(scene) << hlBatchError();
  test::Random random(2);
  std::vector<double> samples;
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < kPaths; ++i) {
    const std::vector<double> path = walk(random, static_cast<std::size_t>(random.below(80)), true);
    samples.insert(samples.end(), path.begin(), path.end());
    ends.push_back(samples.size() / 4);
  }
  const HLbatchSettings settings = rough();
  Results all(ends.back());
  const HLbatchResult at = all.pointers();
  ASSERT_EQ(hlBatchTrace(scene.get(), &settings, kPaths, ends.data(), samples.data(), 0, &at), HL_NO_ERROR);

  Model model = loadScene("rough:2000").model;
  fitModel(model, 0.1);
  const auto snapshot = makeSnapshot(std::move(model));
  TraceSettings single;
  single.proxy.radius = settings.radius;
  single.proxy.surfaces.smooth = true;
  single.proxy.surfaces.static_friction = 0.5;
  single.proxy.surfaces.dynamic_friction = 0.3;
  std::size_t row = 0;
  for (std::size_t i = 0; i < kPaths; ++i) {
    std::vector<PathSample> path;
    for (std::size_t k = i == 0 ? 0 : ends[i - 1]; k < ends[i]; ++k)
      path.push_back({samples[4 * k], Vec3(samples[4 * k + 1], samples[4 * k + 2], samples[4 * k + 3])});
    runTrace(*snapshot, single, path, [&](const TraceRow& one) {
      ASSERT_EQ(one.proxy, Vec3(all.proxy[3 * row], all.proxy[3 * row + 1], all.proxy[3 * row + 2])) << i;
      ASSERT_EQ(one.force, Vec3(all.force[3 * row], all.force[3 * row + 1], all.force[3 * row + 2])) << i;
      ASSERT_EQ(one.contacts, all.contacts[row]);
      ASSERT_EQ(one.injected_J, all.injected[row]);
      ++row;
    });
  }
  EXPECT_EQ(row, ends.back());
}

TEST(Batch, ClosestPointsAreThoseOfAllPrimitives) {
  test::Random random(3);
  for (int scene_number = 0; scene_number < 30; ++scene_number) {
    const int triangles = 1 + random.below(60);
    const double size = std::pow(10, random.uniform(-4, 2));
    std::vector<double> positions;
    std::vector<HLuint> indices;
    for (HLuint i = 0; i < 3 * static_cast<HLuint>(triangles); ++i) {
      const Vec3 p = size * random.inCube(1);
      positions.insert(positions.end(), p.data(), p.data() + 3);
      indices.push_back(i);
    }
    const Scene scene(hlBatchMakeScene(positions.data(), nullptr, indices.size(), indices.data(), indices.size() / 3),
                      &hlBatchDeleteScene);
    ASSERT_TRUE(scene) << hlBatchError();
    std::vector<double> points;
    for (int i = 0; i < 50; ++i) {
      const Vec3 p = size * std::pow(10, random.uniform(-2, 3)) * random.inCube(1);
      points.insert(points.end(), p.data(), p.data() + 3);
    }
    std::vector<double> nearest(150), distance(50), normal(150);
    std::vector<uint64_t> primitive(50);
    ASSERT_EQ(hlBatchClosest(scene.get(), 50, points.data(), 0, nearest.data(), distance.data(), normal.data(),
                             primitive.data()),
              HL_NO_ERROR);
    for (std::size_t i = 0; i < 50; ++i) {
      const Vec3 p(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < indices.size(); k += 3) {
        Primitive made;
        const auto at = [&](std::size_t v) {
          return Vec3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
        };
        if (makeTriangle(at(k), at(k + 1), at(k + 2), 0, made)) best = std::min(best, closestPoint(made, p).distance);
      }
      ASSERT_NEAR(distance[i], best, 1e-12 * (best + size)) << scene_number;
      const Vec3 found(nearest[3 * i], nearest[3 * i + 1], nearest[3 * i + 2]);
      ASSERT_NEAR((p - found).norm(), distance[i], 1e-12 * (best + size));
    }
  }
}

TEST(Batch, APrimitiveIsTheRowOfItsTriangleWhateverWasLeftOut) {
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0};
  const HLuint triangles[] = {0, 0, 1, 0, 1, 2, 3, 3, 3, 3, 4, 5};
  const Scene scene(hlBatchMakeScene(corners, nullptr, 6, triangles, 4), &hlBatchDeleteScene);
  ASSERT_EQ(hlBatchScenePrimitives(scene.get()), 2U);
  const double points[] = {0.1, 0.1, 1, 5.1, 0.1, 1};
  uint64_t primitive[2] = {};
  ASSERT_EQ(hlBatchClosest(scene.get(), 2, points, 0, nullptr, nullptr, nullptr, primitive), HL_NO_ERROR);
  EXPECT_EQ(primitive[0], 1U);
  EXPECT_EQ(primitive[1], 3U);
}

// Each trace has the bodies to itself: those side by side are those one after the other.
TEST(Batch, TracesOfASceneWithBodiesMoveBodiesOfTheirOwn) {
  const std::string file = test::fileWith("block.hl.json", R"({"gravityMS2": {"y": 0}, "objects": [{
    "primitives": {"vertices": [-0.02,-0.02,-0.02, 0.02,-0.02,-0.02, -0.02,0.02,-0.02, 0.02,0.02,-0.02,
                                -0.02,-0.02,0.02, 0.02,-0.02,0.02, -0.02,0.02,0.02, 0.02,0.02,0.02],
                   "triangles": [0,2,3, 0,3,1, 4,5,7, 4,7,6, 0,1,5, 0,5,4, 2,6,7, 2,7,3, 0,4,6, 0,6,2, 1,3,7, 1,7,5]},
    "body": {"massKg": 0.1, "shape": "BOX"}}]})");
  const Scene scene(hlBatchLoadScene(file.c_str(), 0), &hlBatchDeleteScene);
  ASSERT_TRUE(scene) << hlBatchError();
  HLbatchSettings settings;
  hlBatchSettings(&settings);
  std::vector<double> samples;
  constexpr std::size_t kPaths = 6, kSamples = 200;
  std::vector<std::size_t> ends;
  for (std::size_t path = 0; path < kPaths; ++path) {
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double t = 1e-3 * static_cast<double>(i);
      samples.insert(samples.end(), {t, -0.05 + t * (0.2 + 0.1 * static_cast<double>(path)), 0, 0});
    }
    ends.push_back(samples.size() / 4);
  }
  const auto traced = [&](HLint threads) {
    Results results(ends.back());
    const HLbatchResult pointers = results.pointers();
    EXPECT_EQ(hlBatchTrace(scene.get(), &settings, kPaths, ends.data(), samples.data(), threads, &pointers),
              HL_NO_ERROR);
    return results;
  };
  const Results one = traced(1);
  EXPECT_EQ(one, traced(4));
  double hardest = 0;
  for (const double force : one.force) hardest = std::max(hardest, std::abs(force));
  EXPECT_GT(hardest, 0.01) << "nothing was pushed";
  EXPECT_EQ(hlBatchMakeFingers(scene.get(), &settings, 2), nullptr);
  EXPECT_NE(std::string(hlBatchError()).find("bodies"), std::string::npos);
}

TEST(Batch, FieldsAndSnapsAreFelt) {
  const std::string file = test::fileWith("fields.hl.json", R"({"objects": [{
    "primitives": {"vertices": [0, 1, 0], "points": [0]},
    "fields": [{"points": [0, 0, 0], "reach": 0.03, "forceN": 2}],
    "snaps": [{"points": [0.5, 0, 0], "capture": 0.002, "releaseN": 3}]}]})");
  const Scene scene(hlBatchLoadScene(file.c_str(), 0), &hlBatchDeleteScene);
  ASSERT_TRUE(scene) << hlBatchError();
  HLbatchSettings settings;
  hlBatchSettings(&settings);
  const Fingers fingers(hlBatchMakeFingers(scene.get(), &settings, 2), &hlBatchDeleteFingers);
  ASSERT_TRUE(fingers) << hlBatchError();
  const std::array<double, 6> positions{0.01, 0, 0, 0.501, 0, 0};
  Results results(2);
  const HLbatchResult at = results.pointers();
  ASSERT_EQ(hlBatchStep(fingers.get(), positions.data(), 1, &at), HL_NO_ERROR) << hlBatchError();
  EXPECT_NEAR(results.force[0], -2, 1e-9);
  EXPECT_NEAR(results.force[3], -0.001 * settings.spring, 1e-9);
}

TEST(Batch, ACallThatIsCancelledEndsEarlyWithAnError) {
  const Scene scene = load("teapot");
  const std::vector<double> points(3000);
  std::vector<double> distance(1000);
  std::atomic<bool> stop = false;
  const auto closest = [&](HLint threads) {
    return hlBatchClosest(scene.get(), 1000, points.data(), threads, nullptr, distance.data(), nullptr, nullptr);
  };
  {
    const EndsEarly ends_early(stop);
    EXPECT_EQ(closest(1), HL_NO_ERROR);
    stop = true;
    EXPECT_EQ(closest(1), HL_INVALID_VALUE);
    EXPECT_STREQ(hlBatchError(), "hlBatchClosest: the call was ended early");
    EXPECT_EQ(closest(0), HL_INVALID_VALUE);
  }
  EXPECT_EQ(closest(1'000'000), HL_NO_ERROR) << "and with as many threads as there are";
}

// A path of millions of samples takes seconds to be read.
TEST(Batch, ATraceThatIsCancelledDoesNotReadItsSamples) {
  const Scene scene = load("teapot");
  HLbatchSettings settings;
  hlBatchSettings(&settings);
  const std::vector<double> samples(4 * 1000, std::nan(""));
  const std::size_t end = 1000;
  const HLbatchResult nowhere{};
  const std::atomic<bool> stop = true;
  const EndsEarly ends_early(stop);
  EXPECT_EQ(hlBatchTrace(scene.get(), &settings, 1, &end, samples.data(), 1, &nowhere), HL_INVALID_VALUE);
  EXPECT_STREQ(hlBatchError(), "hlBatchTrace: the call was ended early");
}

TEST(Batch, AFingerBeginsAnewAfterAReset) {
  const double wall[] = {0, -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1};
  const HLuint triangles[] = {0, 1, 2, 0, 2, 3};
  const Scene scene(hlBatchMakeScene(wall, nullptr, 4, triangles, 2), &hlBatchDeleteScene);
  HLbatchSettings settings;
  hlBatchSettings(&settings);
  const Fingers fingers(hlBatchMakeFingers(scene.get(), &settings, 2), &hlBatchDeleteFingers);
  Results results(2);
  const HLbatchResult at = results.pointers();
  const std::vector<double> outside{0.2, 0, 0, 0.2, 0, 0}, other{-0.2, 0, 0, -0.2, 0, 0};
  ASSERT_EQ(hlBatchStep(fingers.get(), outside.data(), 0, &at), HL_NO_ERROR);
  const unsigned char mask[] = {0, 1};
  hlBatchResetFingers(fingers.get(), mask);
  ASSERT_EQ(hlBatchStep(fingers.get(), other.data(), 0, &at), HL_NO_ERROR);
  EXPECT_NEAR(results.proxy[0], settings.radius, 1e-9) << "held by the wall";
  EXPECT_EQ(results.proxy[3], -0.2) << "began there";
}

TEST(Batch, ASceneLivesAsLongAsItsFingers) {
  HLbatchSettings settings;
  hlBatchSettings(&settings);
  Scene scene = load("teapot");
  const Fingers fingers(hlBatchMakeFingers(scene.get(), &settings, 1), &hlBatchDeleteFingers);
  EXPECT_GT(hlBatchScenePrimitives(scene.get()), 1000u);
  double low[3], high[3];
  hlBatchSceneBounds(scene.get(), low, high);
  EXPECT_NEAR(std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}), 0.1, 1e-9);
  scene.reset();
  Results results(1);
  const HLbatchResult at = results.pointers();
  const double position[] = {0, 0, 0};
  EXPECT_EQ(hlBatchStep(fingers.get(), position, 0, &at), HL_NO_ERROR);
}

TEST(Batch, BadInputIsRefusedWithALine) {
  EXPECT_EQ(hlBatchLoadScene("/nonexistent.obj", 0), nullptr);
  EXPECT_EQ(std::string(hlBatchError()), "hlBatchLoadScene: /nonexistent.obj: there is no such file");
  EXPECT_EQ(hlBatchLoadScene(nullptr, 0), nullptr);
  EXPECT_EQ(hlBatchLoadScene("teapot", -1), nullptr);
  const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const HLuint bad[] = {0, 1, 3}, same[] = {0, 1, 1};
  EXPECT_EQ(hlBatchMakeScene(positions, nullptr, 3, bad, 1), nullptr);
  EXPECT_EQ(std::string(hlBatchError()), "hlBatchMakeScene: an index names no vertex");
  EXPECT_EQ(hlBatchMakeScene(positions, nullptr, 3, same, 1), nullptr) << "nothing in it can be touched";
  constexpr std::size_t kOfNoArray = std::size_t{1} << 60;
  EXPECT_EQ(hlBatchMakeScene(positions, nullptr, kOfNoArray, same, 1), nullptr);
  EXPECT_EQ(hlBatchMakeScene(positions, nullptr, 3, same, kOfNoArray), nullptr);
  EXPECT_EQ(hlBatchMakePoints(positions, nullptr, kOfNoArray, 0), nullptr);
  EXPECT_EQ(std::string(hlBatchError()), "hlBatchMakePoints: there are too many points");

  EXPECT_EQ(hlBatchMakeImplicit(R"({"expression": {"sphere": {"radius": 1}, "box": {}}})"), nullptr);
  EXPECT_EQ(std::string(hlBatchError()),
            "hlBatchMakeImplicit: no JSON of an implicit surface: expression: \"box\" is a second one of values that "
            "exclude each other: sphere, box, cylinder, capsule, torus, halfSpace, gyroid, union, intersection, "
            "difference, shell, offset");

  const Scene scene = load("teapot");
  HLbatchSettings settings;
  hlBatchSettings(&settings);
  EXPECT_EQ(hlBatchSurface(&settings, HL_STIFFNESS, 2), HL_INVALID_VALUE);
  EXPECT_EQ(hlBatchSurface(&settings, HL_HEIGHT, 1), HL_INVALID_VALUE);
  EXPECT_EQ(hlBatchSurface(&settings, HL_VISCOSITY, std::nan("")), HL_INVALID_VALUE);
  HLbatchSettings flat = settings;
  flat.radius = 0;
  EXPECT_EQ(hlBatchMakeFingers(scene.get(), &flat, 1), nullptr);
  HLbatchSettings neither = settings;
  neither.smooth = 7;
  EXPECT_EQ(hlBatchMakeFingers(scene.get(), &neither, 1), nullptr);
  EXPECT_EQ(std::string(hlBatchError()), "hlBatchMakeFingers: smooth must be HL_TRUE, HL_FALSE or -1");
  const Fingers fingers(hlBatchMakeFingers(scene.get(), &settings, 1), &hlBatchDeleteFingers);
  Results results(2);
  const HLbatchResult at = results.pointers();
  const double nowhere[] = {0, std::nan(""), 0};
  EXPECT_EQ(hlBatchStep(fingers.get(), nowhere, 0, &at), HL_INVALID_VALUE);
  EXPECT_EQ(hlBatchStep(fingers.get(), positions, -1, &at), HL_INVALID_VALUE);
  EXPECT_EQ(hlBatchStep(nullptr, positions, 0, &at), HL_INVALID_VALUE);
  const double falling[] = {0, 0, 0, 0, 0, 0, 0, 0};
  const std::size_t end = 2;
  EXPECT_EQ(hlBatchTrace(scene.get(), &settings, 1, &end, falling, 0, &at), HL_INVALID_VALUE);
  EXPECT_EQ(std::string(hlBatchError()), "hlBatchTrace: the times of a path must rise, by 1e-15 s at least");
  hlBatchDeleteScene(nullptr);
  hlBatchDeleteFingers(nullptr);
  hlBatchResetFingers(nullptr, nullptr);
}

// One scene, several threads of the caller.
TEST(Batch, ASceneMayBeUsedByThreadsAtOnce) {
  const Scene scene = load("teapot");
  HLbatchSettings settings;
  hlBatchSettings(&settings);
  std::vector<Results> results(4, Results(100));
  std::vector<std::thread> threads;
  for (Results& own : results) {
    threads.emplace_back([&] {
      test::Random random(9);
      const std::vector<double> path = walk(random, 100, true);
      const std::size_t end = 100;
      const HLbatchResult at = own.pointers();
      EXPECT_EQ(hlBatchTrace(scene.get(), &settings, 1, &end, path.data(), 2, &at), HL_NO_ERROR);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Results& own : results) EXPECT_EQ(own, results[0]);
}

}  // namespace
}  // namespace hl::test_batch
