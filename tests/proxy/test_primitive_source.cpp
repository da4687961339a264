// Surfaces that are no meshes: their primitives are made when they are asked for.
#include "geometry/primitive_source.h"

#include <gtest/gtest.h>

#include "geometry/scenes.h"
#include "guard/realtime_guard.h"
#include "proxy/proxy.h"
#include "scene/snapshot.h"
#include "sphere_source.h"

namespace hl::test_primitive_source {
namespace {

constexpr double kRadius = 1e-3;

std::shared_ptr<const Snapshot> sceneOf(std::shared_ptr<const Shape> shape, const Pose& pose) {
  Instance instance;
  instance.shape = std::move(shape);
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = 1;
  instance.motion = Motion(pose);
  return makeSnapshot({std::move(instance)});
}

TEST(PrimitiveSource, ASphereMadeOnRequestIsTheSameMeshBitByBit) {
  const auto source = std::make_shared<test::SphereSource>(0.02, 12, 16);
  test::Random random(1);
  for (const bool smooth : {false, true}) {
    for (const Pose& pose : {Pose{}, Pose{Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                                          Vec3(0.01, -0.02, 0.03)}}) {
      const auto on_request = sceneOf(makeShape(source), pose), mesh = sceneOf(makeShape(source->model()), pose);
      ASSERT_EQ(on_request->primitives, mesh->primitives);
      ProxySettings settings;
      settings.radius = kRadius;
      settings.work_cap = kNoWorkCap;  // another index does other work
      settings.surfaces.smooth = smooth;
      settings.surfaces.static_friction = 0.3;
      settings.surfaces.dynamic_friction = 0.2;
      Vec3 finger = pose.toWorld({0, 0, 0.023});
      ProxyState a = startProxy(*on_request, settings, finger), b = startProxy(*mesh, settings, finger);
      int touched = 0;
      for (int i = 0; i < 2000; ++i) {
        finger += 4e-4 * random.inCube(1) - 0.01 * (finger - pose.origin);
        const TickReport one = tick(a, *on_request, settings, finger), other = tick(b, *mesh, settings, finger);
        ASSERT_EQ(a.position, b.position) << i;
        ASSERT_EQ(one.iterations, other.iterations) << i;
        ASSERT_EQ(one.contacts.size(), other.contacts.size()) << i;
        touched += one.contacts.empty() ? 0 : 1;
      }
      EXPECT_GT(touched, 200);
    }
  }
}

// The shading of the true normal, not of the facet: at rest the force points along the radius.
TEST(PrimitiveSource, ItIsShadedByItsTrueNormal) {
  const auto scene = sceneOf(makeShape(std::make_shared<test::SphereSource>(0.02, 12, 16)), {});
  ProxySettings settings;
  settings.radius = kRadius;
  for (const bool smooth : {false, true}) {
    settings.surfaces.smooth = smooth;
    double worst_rad = 0;
    test::Random random(3);
    for (int i = 0; i < 100; ++i) {
      const Vec3 way = random.direction();
      ProxyState state = startProxy(*scene, settings, 0.03 * way);
      const Vec3 finger = 0.0185 * way;
      for (int k = 0; k < 50; ++k) tick(state, *scene, settings, finger);
      const Vec3 force = (state.position - finger).normalized();
      worst_rad = std::max(worst_rad, std::acos(std::clamp(force.dot(way), -1.0, 1.0)));
    }
    if (smooth) {
      EXPECT_LT(worst_rad, 0.02);
    } else {
      EXPECT_GT(worst_rad, 0.05);
    }
  }
}

// 2^40 triangles; an index of its own, that knows which are near.
class HugePlane final : public PrimitiveSource {
 public:
  static constexpr ElementId kColumns = ElementId{1} << 20;
  static constexpr double kCell = 1e-4;
  ElementId count() const override { return 2 * kColumns * kColumns; }
  std::array<Vec3, 3> corners(ElementId id) const override {
    const ElementId cell = id / 2;
    const double x = kCell * static_cast<double>(cell % kColumns), z = kCell * static_cast<double>(cell / kColumns);
    const Vec3 a(x, 0, z), b(x, 0, z + kCell), c(x + kCell, 0, z), d(x + kCell, 0, z + kCell);
    return id % 2 == 0 ? std::array{a, b, c} : std::array{c, b, d};
  }
  Vec3 trueNormal(ElementId, const Vec3&) const override { return Vec3::UnitY(); }
  Box bounds() const override {
    Box box;
    box.extend(Vec3::Zero());
    box.extend(Vec3(1, 0, 1) * kCell * static_cast<double>(kColumns));
    return box;
  }
  std::unique_ptr<const SpatialIndex> makeIndex() const override { return std::make_unique<Index>(); }
  std::size_t bytes() const override { return sizeof(*this); }
  double error_m() const override { return 0; }

 private:
  class Index final : public SpatialIndex {
   public:
    std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const override {
      return within(centre, centre, radius, visit);
    }
    std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double,
                      FunctionRef<double(ElementId, double)> visit) const override {
      double limit = 1;
      return within(from, from + motion, radius, [&](ElementId id) { limit = visit(id, limit); });
    }
    IndexStats stats() const override { return {}; }

   private:
    std::size_t within(const Vec3& a, const Vec3& b, double radius, FunctionRef<void(ElementId)> visit) const {
      const auto cells = [](double low, double high) {
        const auto cell = [](double x) {
          return static_cast<ElementId>(std::clamp(std::floor(x / kCell), 0.0, static_cast<double>(kColumns - 1)));
        };
        return std::pair(cell(low - 1e-9), cell(high + 1e-9));
      };
      const auto [x0, x1] = cells(std::min(a.x(), b.x()) - radius, std::max(a.x(), b.x()) + radius);
      const auto [z0, z1] = cells(std::min(a.z(), b.z()) - radius, std::max(a.z(), b.z()) + radius);
      std::size_t volumes = 0;
      for (ElementId z = z0; z <= z1; ++z) {
        for (ElementId x = x0; x <= x1; ++x, ++volumes) {
          visit(2 * (z * kColumns + x));
          visit(2 * (z * kColumns + x) + 1);
        }
      }
      return volumes;
    }
  };
};

TEST(PrimitiveSource, MoreTrianglesThanThereIsMemoryForAreTouchedLikeAPlane) {
  const auto scene = sceneOf(makeShape(std::make_shared<HugePlane>()), {});
  EXPECT_EQ(scene->primitives, std::size_t{1} << 41);
  ProxySettings settings;
  settings.radius = 2e-4;
  Vec3 finger(104.0, 1e-3, 103.9);  // where elements have numbers of 41 bits
  ProxyState state = startProxy(*scene, settings, finger);
  ManyRecentPrimitives recent;
  const RealtimeGuard guard;
  for (int i = 0; i < 300; ++i) {
    finger += Vec3(1.3e-5, i < 100 ? -1.5e-5 : 0, 0.9e-5);
    const TickReport report = tick(state, {*scene, 0, recent}, settings, finger);
    const double height = std::max(finger.y(), settings.radius);
    ASSERT_LT((state.position - Vec3(finger.x(), height, finger.z())).norm(), 1e-9) << i;
    if (i > 150) {
      ASSERT_EQ(report.contacts.size(), 1u);
      ASSERT_GT(report.contacts[0].primitive.element, ElementId{1} << 40);
    }
  }
}

}  // namespace
}  // namespace hl::test_primitive_source
