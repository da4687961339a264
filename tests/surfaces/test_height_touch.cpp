// A height field touched: the same bits as the same triangles as a mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "builtin.h"
#include "fields.h"
#include "guard/realtime_guard.h"
#include "proxy/proxy.h"
#include "scene/append_part.h"
#include "scene/bump_gain.h"
#include "scene/snapshot.h"

namespace hl::test_height_touch {
namespace {

std::shared_ptr<const Snapshot> sceneOf(std::shared_ptr<const Shape> shape, const Pose& pose = {}) {
  Instance instance;
  instance.shape = std::move(shape);
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = 1;
  instance.motion = Motion(pose);
  return makeSnapshot({std::move(instance)});
}

Model modelOf(const HeightField& field) {
  DrawnMesh drawn = field.drawn(~std::size_t{0});
  Model model;
  model.positions = std::move(drawn.positions);
  model.normals = std::move(drawn.normals);
  model.texcoords = std::move(drawn.texcoords);
  model.triangles = std::move(drawn.triangles);
  return model;
}

// Hills of 30 mm over 200 mm.
std::shared_ptr<const HeightField> hills(std::uint32_t side) {
  const double h = 0.2 / (side - 1);
  return test::fieldOf(side, side, h, [h](double i, double j) {
    const double x = h * i - 0.1, z = h * j - 0.1;
    return 0.009 * std::sin(40 * x) * std::cos(33 * z) + 0.004 * std::sin(87 * x + 51 * z);
  });
}

TEST(HeightTouch, AFieldIsTheSameMeshBitByBit) {
  const auto field = hills(150);
  test::Random random(1);
  for (const bool smooth : {false, true}) {
    for (const double radius : {2e-4, 1e-3, 1e-2}) {
      const auto on_request = sceneOf(makeShape(field)), mesh = sceneOf(makeShape(modelOf(*field)));
      ProxySettings settings;
      settings.radius = radius;
      settings.work_cap = kNoWorkCap;  // another index does other work
      settings.surfaces.smooth = smooth;
      settings.surfaces.static_friction = 0.3;
      settings.surfaces.dynamic_friction = 0.2;
      Vec3 finger(0.1, 0.03, 0.1);
      ProxyState a = startProxy(*on_request, settings, finger), b = startProxy(*mesh, settings, finger);
      int touched = 0;
      for (int i = 0; i < 3000; ++i) {
        finger += 4e-4 * random.inCube(1) - 0.003 * (finger - Vec3(0.1, -0.005, 0.1));
        const TickReport one = tick(a, *on_request, settings, finger), other = tick(b, *mesh, settings, finger);
        ASSERT_EQ(a.position, b.position) << i;
        ASSERT_EQ(one.iterations, other.iterations) << i;
        ASSERT_EQ(one.contacts.size(), other.contacts.size()) << i;
        touched += one.contacts.empty() ? 0 : 1;
      }
      EXPECT_GT(touched, 500);
    }
  }
}

// A bump map, and friction of a coarser image.
struct Skin {
  Material material;
  std::vector<Texture> textures{makeTexture("sine", 64), makeTexture("noise", 16)};
  Vec2 repeat{40, 3};

  Skin() {
    material.smooth = true;
    material.textureOf(Quantity::kHeight) = {0, 0, 2e-5};
    material.textureOf(Quantity::kDynamicFriction) = {1, 0.1, 0.7};
    material.textureOf(Quantity::kStiffness) = {1, 0.5, 1};
  }
  std::shared_ptr<const Snapshot> on(const std::shared_ptr<const HeightField>& field) const {
    return sceneOf(makeShape(field, material, textures, repeat));
  }
  std::shared_ptr<const Snapshot> on(Model model) const {
    model.materials = {material};
    model.textures = textures;
    repeatTexcoords(model, repeat);
    return sceneOf(makeShape(std::move(model)));
  }
};

TEST(HeightTouch, TexturesAreFeltAsOnTheSameMeshBitByBit) {
  const SceneModel terrain = makeBuiltinWorld("field:terrain:80000");
  const auto field = std::dynamic_pointer_cast<const HeightField>(terrain.surfaces.at(0).source);
  ASSERT_TRUE(field);
  const auto on_request = Skin().on(field), mesh = Skin().on(modelOf(*field)), plain = sceneOf(makeShape(field));
  ProxySettings settings;
  settings.radius = 1e-3;
  settings.work_cap = kNoWorkCap;  // another index does other work
  test::Random random(2);
  Vec3 finger(0, 0.03, 0);
  ProxyState a = startProxy(*on_request, settings, finger), b = startProxy(*mesh, settings, finger),
             c = startProxy(*plain, settings, finger);
  int touched = 0, otherwise = 0;
  for (int i = 0; i < 3000; ++i) {
    finger += 4e-4 * random.inCube(1) - 0.003 * (finger - Vec3(0, -0.005, 0));
    const TickReport one = tick(a, *on_request, settings, finger), other = tick(b, *mesh, settings, finger);
    ASSERT_EQ(a.position, b.position) << i;
    ASSERT_EQ(one.target, other.target) << i;
    ASSERT_EQ(one.contacts.size(), other.contacts.size()) << i;
    touched += one.contacts.empty() ? 0 : 1;
    tick(c, *plain, settings, finger);
    otherwise += a.position == c.position ? 0 : 1;
  }
  EXPECT_GT(touched, 1000);
  EXPECT_GT(otherwise, 1000) << "they are felt";
}

// As the mesh of the same hills has them: u to the east, v to the north.
TEST(HeightTouch, AFieldHasTheTextureCoordinatesOfTheTerrain) {
  const SceneModel terrain = makeBuiltinWorld("field:terrain:20000");
  const Model field = modelOf(dynamic_cast<const HeightField&>(*terrain.surfaces.at(0).source));
  const Model mesh = makeBuiltinScene("terrain:20000");
  ASSERT_EQ(field.positions.size(), mesh.positions.size());
  ASSERT_EQ(field.texcoords.size(), field.positions.size());
  const std::size_t side = 101;
  for (std::size_t j = 0; j < side; ++j) {
    for (std::size_t i = 0; i < side; ++i) {
      const std::size_t of_mesh = (side - 1 - j) * side + i, of_field = j * side + i;
      ASSERT_LT((field.positions[of_field] - mesh.positions[of_mesh]).norm(), 1e-6);
      ASSERT_EQ(field.texcoords[of_field], mesh.texcoords[of_mesh]);
    }
  }
}

TEST(HeightTouch, AMovedAndScaledFieldKeepsItsTextureCoordinates) {
  const auto field = hills(30);
  const auto moved = placedShape(*makeShape(field, {}, {}, Vec2(3, 4)), Vec3(-2, 3, 1).asDiagonal(), Vec3(1, 2, 3));
  for (ElementId id = 0; id < field->count(); id += 7) {
    const Primitive triangle = moved->primitive(id);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 at = triangle.vertex[i];
      const double u = (at.x() - 1) / -0.4, v = 1 - (at.z() - 3) / 0.2;
      EXPECT_LT((moved->cornerTexcoord(triangle.source, triangle.order[i]) - Vec2(3 * u, 4 * v)).norm(), 1e-12);
    }
  }
}

// A sin(2 pi n u) over a side L bends by A (2 pi n / L)^2.
TEST(HeightTouch, ABumpMapReportsItsGain) {
  const auto field = test::fieldOf(11, 11, 0.02, [](double, double) { return 0.0; });
  Material material;
  material.textureOf(Quantity::kHeight) = {0, 0, 1e-4};
  const double k = 2 * M_PI * 50 / 0.2;
  const double curvature =
      bumpCurvature_per_m(*sceneOf(makeShape(field, material, {makeTexture("sine", 256)}, Vec2(50, 1))), 0);
  EXPECT_NEAR(curvature, 0.5e-4 * k * k, 1e-3 * curvature);
}

// Over a plane of any slope the proxy stays at its radius.
TEST(HeightTouch, APlaneIsFlat) {
  for (const double slope : {0.0, 0.25, -1.5}) {
    const double h = 1e-3;
    const auto field = test::fieldOf(201, 201, h, [&](double i, double) { return slope * h * i; });
    const auto scene = sceneOf(makeShape(field));
    ProxySettings settings;
    settings.radius = 2e-3;
    const Vec3 normal = Vec3(-slope, 1, 0).normalized(), along = Vec3(1, slope, 0.3).normalized();
    const Vec3 begin(0.05, 0.05 * slope, 0.1);
    ProxyState state = startProxy(*scene, settings, begin + 0.01 * normal);
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      tick(state, *scene, settings, begin + 5e-5 * i * along - std::min(0.003, 1e-4 * i) * normal);
      if (i > 200) worst = std::max(worst, std::abs((state.position - begin).dot(normal) - settings.radius));
    }
    EXPECT_LT(worst, 1e-8) << slope;  // the samples are float
  }
}

// A ball of a radius above a sine of curvature above 1/r stands on two crests: lowest centre where it touches both.
TEST(HeightTouch, ABallStandsOnCrests) {
  const double h = 5e-5, amplitude = 5e-4, wavelength = 2e-3, radius = 5e-3;
  const auto field =
      test::fieldOf(801, 81, h, [&](double i, double) { return amplitude * std::cos(2 * M_PI * h * i / wavelength); });
  const auto scene = sceneOf(makeShape(field));
  ProxySettings settings;
  settings.radius = radius;
  const auto restAt = [&](double x) {
    const Vec3 finger(x, -1e-3, 40 * h);
    ProxyState state = startProxy(*scene, settings, Vec3(x, 0.02, 40 * h));
    for (int i = 0; i < 100; ++i) tick(state, *scene, settings, finger);
    return state.position;
  };
  // At rest between two crests, whichever way it slid: brute force over the samples.
  const Vec3 rest = restAt(10.5 * wavelength);
  double lowest = -1;
  for (int i = 0; i <= 800; ++i) {
    const double d = h * i - rest.x();
    if (std::abs(d) < radius)
      lowest =
          std::max(lowest, amplitude * std::cos(2 * M_PI * h * i / wavelength) + std::sqrt(radius * radius - d * d));
  }
  EXPECT_NEAR(rest.y(), lowest, 1e-6);
  EXPECT_LT(rest.y(), amplitude + radius);
}

// What a server shows of a field that a client sends again and again.
class SentField {
 public:
  const Snapshot& show(const std::function<double(double, double)>& height) {
    constexpr std::uint32_t kSide = 21;
    Instance instance;
    instance.shape = makeShape(test::fieldOf(kSide, kSide, 0.004, height)->placed(Mat3::Identity(), {-0.04, 0, -0.04}));
    instance.surfaces = surfacesOf(instance.shape);
    instance.key = 1;
    instance.replaced_in = number_ > 0 ? number_ + 1 : 0;
    snapshot_ = makeSnapshot({instance}, "", ++number_);
    return *snapshot_;
  }
  const Snapshot& now() const { return *snapshot_; }

 private:
  std::uint64_t number_ = 0;
  std::shared_ptr<const Snapshot> snapshot_;
};

// By less and by far more than its radius; level, sloped and rough.
TEST(HeightTouch, AFieldThatIsSentHigherLiftsTheProxy) {
  for (const double slope : {0.0, 0.5, 3.0}) {
    SentField sent;
    ProxySettings settings;
    settings.radius = 0.003;
    const auto ground = [&](double level) {
      return [=](double i, double j) { return level + slope * 0.004 * (i - 10) + 1e-4 * std::sin(7 * i + 3 * j); };
    };
    ProxyState state = startProxy(sent.show(ground(0)), settings, {0, 0.05, 0});
    const Vec3 finger(0, -0.02, 0);
    for (int i = 0; i < 50; ++i) tick(state, sent.now(), settings, finger);
    for (const double level : {0.001, 0.003, 0.007, 0.015, 0.031, 0.02, 0.06, 0.0, 0.05}) {
      sent.show(ground(level));
      for (int i = 0; i < 50; ++i) {
        tick(state, sent.now(), settings, finger);
        const double least = level + slope * state.position.x() - 2e-4 + settings.radius * std::hypot(1, slope) * 0.99;
        ASSERT_GE(state.position.y(), least) << "slope " << slope << ", level " << level << ", tick " << i;
      }
    }
  }
}

// Whoever came below it, through a gap or around its rim, is not lifted through it.
TEST(HeightTouch, AProxyThatWasBelowAFieldStaysBelow) {
  SentField sent;
  ProxySettings settings;
  settings.radius = 0.003;
  const auto level = [](double y) { return [y](double, double) { return y; }; };
  ProxyState state = startProxy(sent.show(level(0)), settings, {0, -0.03, 0});
  const Vec3 finger(0, 0.01, 0);
  tick(state, sent.now(), settings, finger);
  for (const double y : {0.0, 0.004, -0.0005, -0.001, 0.002}) {
    sent.show(level(y));
    for (int i = 0; i < 50; ++i) {
      tick(state, sent.now(), settings, finger);
      ASSERT_LT(state.position.y(), y) << "level " << y << ", tick " << i;
    }
    EXPECT_NEAR(state.position.y(), y - settings.radius, 1e-6);
  }
}

TEST(HeightTouch, TicksAllocateNothing) {
  const auto field = hills(500);
  for (const auto& scene : {sceneOf(makeShape(field)), Skin().on(field)}) {
    ProxySettings settings;
    settings.radius = 1e-3;
    Vec3 finger(0.1, 0.03, 0.1);
    ProxyState state = startProxy(*scene, settings, finger);
    const RealtimeGuard guard;
    for (int i = 0; i < 500; ++i) {
      finger += Vec3(5e-5, i < 200 ? -2e-4 : 0, 2e-5);
      tick(state, *scene, settings, finger);
    }
    EXPECT_LT(state.position.x(), 0.2);
  }
}

}  // namespace
}  // namespace hl::test_height_touch
