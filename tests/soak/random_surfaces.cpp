#include "soak/random_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.h"
#include "scene/scene_model.h"
#include "soak/primitives_of.h"
#include "surfaces/clouds.h"
#include "surfaces/expressions.h"
#include "surfaces/fields.h"
#include "surfaces/frames.h"
#include "surfaces/volumes.h"

namespace hl::soak {

namespace {

Source drawField(test::Random& random) { return test::randomField(random); }
Source drawVolume(test::Random& random) { return test::randomSurface(random); }
Source drawFrame(test::Random& random) { return test::randomFrame(random); }
Source drawCloud(test::Random& random) { return test::randomCloud(random); }

struct SurfaceKind {
  const char* name;
  Source (*draw)(test::Random&);
};
constexpr std::array<SurfaceKind, 6> kSurfaceKinds{{{"height field", drawField},
                                                    {"volume", drawVolume},
                                                    {"lump in a volume", drawLump},
                                                    {"expression", drawSolid},
                                                    {"depth frame", drawFrame},
                                                    {"cloud", drawCloud}}};

Model modelOf(const PrimitiveSource& source) {
  Model model;
  test::Mesh mesh = test::meshOf(source);
  model.positions = std::move(mesh.positions);
  model.triangles = std::move(mesh.triangles);
  model.points = std::move(mesh.points);
  return model;
}

// Whether each side of a triangle has one other, with the opposite direction.
bool closed(const std::vector<Primitive>& primitives) {
  std::map<std::array<double, 6>, int> sides;
  for (const Primitive& primitive : primitives) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = primitive.vertex[i], &b = primitive.vertex[(i + 1) % 3];
      ++sides[{a.x(), a.y(), a.z(), b.x(), b.y(), b.z()}];
    }
  }
  return std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
    const auto& [s, count] = side;
    const auto other = sides.find({s[3], s[4], s[5], s[0], s[1], s[2]});
    return count == 1 && other != sides.end() && other->second == 1;
  });
}

void keepPrimitives(const Model& model, RandomScene& scene) {
  scene.primitives = primitivesOf(model);
  if (!model.points.empty() || !closed(scene.primitives)) return;
  for (const Primitive& primitive : scene.primitives) scene.solid.push_back(primitive.vertex);
}

// Of about the distance between vertices, and much more or less.
void drawRadius(test::Random& random, const Box& bounds, RandomScene& scene) {
  const double apart = bounds.size().norm() / std::sqrt(static_cast<double>(scene.primitives.size()));
  scene.settings.radius = (apart > 0 ? apart : 1e-3) * std::pow(10.0, random.uniform(-1.5, 1));
  scene.settings.world_per_device = scene.settings.radius / 1e-3;
  scene.centre_W = bounds.centre();
  scene.half = 0.5 * bounds.size().maxCoeff() / scene.settings.radius + 2;
}

}  // namespace

Source drawLump(test::Random& random) {
  const auto side = static_cast<std::uint32_t>(6 + random.below(14));
  const double middle = 0.5 * (side - 1), noise = random.below(2) == 0 ? 0 : std::pow(10.0, random.uniform(-3, 0.5));
  const Vec3 waves = random.inCube(1.5);
  const auto volume = test::volumeOf({side, side, side}, [&](const Vec3& at) {
    const Vec3 p = at - Vec3::Constant(middle);
    if (p.cwiseAbs().maxCoeff() > middle - 1) return -10.0;
    return 0.8 * middle - p.norm() + 2 * std::sin(waves.dot(p)) + noise * random.uniform(-1, 1);
  });
  const Mat3 turn = Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix();
  GridFrame frame = test::cubicFrame(1).placed(1e-3 * turn, 1e-3 * random.inCube(100));
  if (random.below(2) == 0) frame.axes.col(0) *= -random.uniform(0.3, 2);
  return std::make_shared<const IsoSurface>(volume, frame, IsoValue{0, SolidSide::kAbove});
}

// An expression that cannot be kept is drawn again.
Source drawSolid(test::Random& random) {
  while (true) {
    try {
      Expression solid = test::randomSolid(random);
      const Mat3 turn = Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix();
      return test::surfaceOf(std::move(solid), 1e-4)->placed(turn, random.inCube(0.05));
    } catch (const Error&) {
    }
  }
}

namespace {

RandomScene drawAnySurface(test::Random& random) {
  constexpr std::size_t kMaxPrimitives = 8000;
  RandomScene scene;
  Source source;
  Model mesh;
  const SurfaceKind& kind = kSurfaceKinds[static_cast<std::size_t>(random.below(kSurfaceKinds.size()))];
  scene.what = kind.name;
  do {
    source = kind.draw(random);
    if (source->triangles() <= kMaxPrimitives) mesh = modelOf(*source);
  } while (mesh.elements() == 0);
  keepPrimitives(mesh, scene);
  drawRadius(random, source->bounds(), scene);
  drawRules(random, scene);
  scene.effect = static_cast<Effect>(random.below(3));  // a mesh has no true normals to shade with
  SceneSurface surface{scene.what, source};
  dress(random, scene, surface.material);
  mesh.materials = {surface.material};
  SceneModel model;
  model.surfaces.push_back(std::move(surface));
  scene.snapshot = makeSnapshot(std::move(model));
  // The bounds of a surface may be larger than those of its mesh, and tolerances depend on them.
  auto as_mesh = std::make_shared<Snapshot>(*makeSnapshot(std::move(mesh), HierarchyKind::kBvh));
  as_mesh->extent = scene.snapshot->extent;
  as_mesh->bounds = scene.snapshot->bounds;
  scene.shuffled = std::move(as_mesh);
  return scene;
}

// Far smaller a proxy knows too little of where it is; far larger, fingers would be where none may be.
bool isFelt(const RandomScene& scene) {
  constexpr double kMinPart = 1e-7, kMax_m = 1e5;
  return scene.settings.radius > kMinPart * scene.snapshot->extent && scene.settings.radius < kMax_m;
}

}  // namespace

RandomScene drawSurface(test::Random& random) {
  RandomScene scene = drawAnySurface(random);
  while (!isFelt(scene)) scene = drawAnySurface(random);
  return scene;
}

}  // namespace hl::soak
