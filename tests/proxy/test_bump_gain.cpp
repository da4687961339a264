// The gain of a bump map, as `hl info` says it, against the slopes that a tick has.
#include "scene/bump_gain.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <vector>

#include "effect_scenes.h"
#include "geometry/scenes.h"
#include "proxy/patch.h"

namespace hl::test_bump_gain {
namespace {

constexpr double kSide = 0.2;  // of the floor, m
constexpr double kHigh_m = 1e-4;
constexpr PrimitiveId kTriangle{0, 0};
const MaterialOverride kNothingSet;

Texture imageOf(std::size_t width, std::size_t height, Wrap wrap, std::vector<float> texels) {
  Texture texture{"image", width, height, std::move(texels), wrap, Filter::kBilinear};
  checkTexture(texture);
  return texture;
}

Texture randomImage(test::Random& random) {
  const auto width = static_cast<std::size_t>(1 + random.below(16)),
             height = static_cast<std::size_t>(1 + random.below(16));
  std::vector<float> texels;
  for (std::size_t i = 0; i < width * height; ++i) texels.push_back(static_cast<float>(random.uniform(0, 1)));
  return imageOf(width, height, random.below(2) == 0 ? Wrap::kRepeat : Wrap::kClamp, std::move(texels));
}

// A floor over which u goes from 0 to `repeat` along x and v along -z.
std::shared_ptr<const Snapshot> floorOf(const Texture& texture, const Vec2& repeat) {
  Model model = test::floorModel();
  for (Vec2& uv : model.texcoords) uv = uv.cwiseProduct(repeat);
  model.textures.push_back(texture);
  model.materials[0].textureOf(Quantity::kHeight) = {0, 0, kHigh_m};
  return test::snapshotOf(std::move(model));
}

/// What the tick turns the normal by, anywhere on the plane of the floor's first triangle.
class FeltSlope {
 public:
  explicit FeltSlope(const SceneAt& scene)
      : patch_(scene, Surface(scene, kNothingSet, kTriangle), {kTriangle, Vec3::UnitY(), {1, 0, 0}}),
        from_(scene.primitive(kTriangle).vertex[0]) {}

  /// dh/dx and dh/d(-z) where x and -z are these, from the floor's corner.
  Vec2 at(const Vec2& place) const {
    const Vec3 step = Vec3(place.x() - kSide / 2, 0, kSide / 2 - place.y()) - from_;
    const Vec3 normal = patch_.shadingNormal(patch_.weightsOver(step)).normal;
    return Vec2(-normal.x(), normal.z()) / normal.y();
  }
  /// How its slope changes about the place, by steps of `step`.
  double gainAt(const Vec2& place, const Vec2& step) const {
    Eigen::Matrix2d change;
    change << (at(place + Vec2(step.x(), 0)) - at(place - Vec2(step.x(), 0))) / (2 * step.x()),
        (at(place + Vec2(0, step.y())) - at(place - Vec2(0, step.y()))) / (2 * step.y());
    return Eigen::JacobiSVD<Eigen::Matrix2d>(change).singularValues()[0];
  }

 private:
  Patch patch_;
  Vec3 from_;
};

// Over all cells between the centres of texels, those beyond the ends too: near their corners, and between them.
double largestGain(const FeltSlope& felt, const Texture& texture, const Vec2& repeat) {
  const Vec2 texel(kSide / (repeat.x() * static_cast<double>(texture.width)),
                   kSide / (repeat.y() * static_cast<double>(texture.height)));
  double largest = 0;
  for (int j = -1; j <= static_cast<int>(texture.height); ++j) {
    for (int i = -1; i <= static_cast<int>(texture.width); ++i) {
      for (const double s : {0.001, 0.4, 0.999}) {
        for (const double t : {0.001, 0.4, 0.999}) {
          const Vec2 place = texel.cwiseProduct(Vec2(i + 0.5 + s, j + 0.5 + t));
          largest = std::max(largest, felt.gainAt(place, 5e-4 * texel));
        }
      }
    }
  }
  return largest;
}

TEST(BumpGain, IsTheLargestOfTheSlopesThatATickHas) {
  test::Random random(41);
  for (int round = 0; round < 120; ++round) {
    const Texture texture = randomImage(random);
    const Vec2 repeat(random.uniform(0.5, 20), random.uniform(0.5, 20));
    const auto snapshot = floorOf(texture, repeat);
    const SceneAt scene(*snapshot);
    const double brute = largestGain(FeltSlope(scene), texture, repeat);
    const double said = bumpCurvature_per_m(*snapshot, 0);
    EXPECT_NEAR(said, brute, 5e-3 * said + 1e-9) << texture.width << " x " << texture.height << ", " << round;
    EXPECT_GE(said, brute * (1 - 1e-6)) << round;
    EXPECT_EQ(said > 0, hasSlope(texture, {1, 1})) << round;
  }
}

// Columns of one texel: each texel's two neighbours are equal.
TEST(BumpGain, OfAPatternOfTwoTexelsIsNone) {
  std::vector<float> one, two;
  for (int i = 0; i < 64; ++i) {
    one.push_back(static_cast<float>(i % 2));
    two.push_back(static_cast<float>(i / 2 % 2));
  }
  const Texture narrow = imageOf(8, 8, Wrap::kRepeat, one), wide = imageOf(8, 8, Wrap::kRepeat, two);
  EXPECT_EQ(bumpCurvature_per_m(*floorOf(narrow, {10, 10}), 0), 0);
  EXPECT_FALSE(hasSlope(narrow, {1, 1}));
  // Half the difference of 1 a texel, which turns round from texel to texel; 400 texels a metre.
  EXPECT_NEAR(bumpCurvature_per_m(*floorOf(wide, {10, 10}), 0), kHigh_m * 400 * 400, 1e-9);
  EXPECT_TRUE(hasSlope(wide, {1, 0}));
  EXPECT_FALSE(hasSlope(wide, {0, 1}));
}

// Where triangles have texture coordinates that are not at right angles it may say too much, and never too little.
TEST(BumpGain, OfShearedTexcoordsIsABound) {
  test::Random random(42);
  for (int round = 0; round < 50; ++round) {
    const Texture texture = randomImage(random);
    Model model = test::floorModel();
    const double shear = random.uniform(-1, 1);
    for (Vec2& uv : model.texcoords) uv = 5 * Vec2(uv.x() + shear * uv.y(), uv.y());
    model.textures.push_back(texture);
    model.materials[0].textureOf(Quantity::kHeight) = {0, 0, kHigh_m};
    const auto snapshot = test::snapshotOf(std::move(model));
    const SceneAt scene(*snapshot);
    const FeltSlope felt(scene);
    const double said = bumpCurvature_per_m(*snapshot, 0);
    for (int i = 0; i < 500; ++i) {
      const Vec2 place(random.uniform(0, kSide), random.uniform(0, kSide));
      EXPECT_LE(felt.gainAt(place, Vec2(1e-9, 1e-9)), said * (1 + 1e-3) + 1e-6) << round;
    }
  }
}

}  // namespace
}  // namespace hl::test_bump_gain
