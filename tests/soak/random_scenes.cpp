#include "soak/random_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/make_primitive.h"
#include "scene/snapshot.h"
#include "soak/add_triangle.h"

namespace hl::soak {

namespace {

// All lengths are in radii of the proxy until the scene is placed.
struct Drawing {
  Model model;
  std::size_t closed = 0;  // the first so many triangles make closed surfaces
};

void addQuad(Model& model, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  addTriangle(model, a, b, c);
  addTriangle(model, a, c, d);
}

// A parallelepiped of three edges about a centre, closed.
void addSolid(Model& model, const Vec3& centre, const Mat3& edges) {
  const Vec3 u = edges.col(0), v = edges.col(1), w = edges.col(2), o = centre - 0.5 * (u + v + w);
  addQuad(model, o, o + v, o + u + v, o + u);
  addQuad(model, o + w, o + u + w, o + u + v + w, o + v + w);
  addQuad(model, o, o + u, o + u + w, o + w);
  addQuad(model, o + v, o + v + w, o + u + v + w, o + u + v);
  addQuad(model, o, o + w, o + v + w, o + v);
  addQuad(model, o + u, o + u + v, o + u + v + w, o + u + w);
}

double anySize(test::Random& random, double low, double high) {
  return std::pow(10.0, random.uniform(std::log10(low), std::log10(high)));
}

Mat3 turned(test::Random& random) {
  return Eigen::AngleAxisd(random.uniform(0, M_PI), random.direction()).toRotationMatrix();
}

void drawBoxes(test::Random& random, Model& model) {
  for (int i = 1 + random.below(6); i > 0; --i) {
    const Vec3 size(anySize(random, 1e-3, 10), anySize(random, 0.1, 10), anySize(random, 0.1, 10));
    const Mat3 edges = (random.below(2) == 0 ? Mat3(Mat3::Identity()) : turned(random)) * Mat3(size.asDiagonal());
    addSolid(model, random.below(4) == 0 ? Vec3(Vec3::Zero()) : random.inCube(6), edges);
  }
}

void drawShells(test::Random& random, Model& model) {
  double half = random.uniform(0.3, 3);
  for (int i = 2 + random.below(5); i > 0; --i) {
    addSolid(model, Vec3::Zero(), Mat3(Vec3::Constant(2 * half).asDiagonal()));
    half += random.below(4) == 0 ? anySize(random, 1e-9, 1e-2) : random.uniform(0.1, 3);
  }
}

// A cone with its floor, of many or few sides, sharp or flat.
void drawCone(test::Random& random, Model& model) {
  const int sides = 3 + random.below(60);
  const double radius = anySize(random, 0.3, 8), height = anySize(random, 0.2, 12);
  const auto at = [&](int i) {
    const double angle = 2 * M_PI * (i % sides) / sides;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  for (int i = 0; i < sides; ++i) {
    addTriangle(model, at(i), at(i + 1), Vec3(0, 0, height));
    addTriangle(model, at(i + 1), at(i), Vec3::Zero());
  }
}

void drawCage(test::Random& random, Model& model) {
  const double gap = random.uniform(1.5, 3), thick = anySize(random, 1e-2, 0.5);
  for (int i = -2; i <= 2; ++i) {
    for (int k = -2; k <= 2; ++k) addSolid(model, gap * Vec3(i, k, 0), Mat3(Vec3(thick, thick, 12).asDiagonal()));
  }
}

// Walls that lean toward each other, about as far apart as the proxy is wide.
void drawSlots(test::Random& random, Model& model) {
  double x = -6;
  while (x < 6) {
    const double lean = random.below(2) == 0 ? 0 : random.uniform(-0.3, 0.3);
    addQuad(model, {x, -6, -4}, {x, 6, -4}, {x + 4 * lean, 6, 4}, {x + 4 * lean, -6, 4});
    x += 2 * (1 + (random.below(2) == 0 ? 1 : -1) * anySize(random, 1e-12, 0.9));
  }
}

void drawSoup(test::Random& random, Model& model) {
  for (int i = 3 + random.below(80); i > 0; --i) {
    const Vec3 a = random.inCube(8), b = a + random.inCube(anySize(random, 0.1, 8));
    const double thin = random.below(3) == 0 ? anySize(random, 1e-8, 1e-2) : 3;
    addTriangle(model, a, b, a + random.uniform(0, 1) * (b - a) + thin * random.direction());
  }
}

void drawSegmentsAndPoints(test::Random& random, Model& model) {
  for (int i = 1 + random.below(40); i > 0; --i) {
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    model.positions.push_back(random.inCube(6));
    if (random.below(2) == 0) {
      model.points.push_back(first);
    } else {
      model.positions.push_back(model.positions[first] + random.inCube(anySize(random, 1e-3, 6)));
      model.segments.push_back({first, first + 1});
    }
  }
}

// A smooth sheet with some of its faces there twice, or almost: moved by a few roundings.
void drawDoubleSheet(test::Random& random, Model& model) {
  const int n = 2 + random.below(5);
  const double wave = random.uniform(0, 1.5);
  const auto at = [&](int i, int k) {
    const double x = 8.0 * i / n - 4, y = 8.0 * k / n - 4;
    return Vec3(x, y, wave * std::sin(x) * std::cos(0.7 * y));
  };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const Vec3 off = random.below(3) == 0 ? random.inCube(1e-15) : Vec3(Vec3::Zero());
      addQuad(model, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
      if (random.below(2) == 0) addQuad(model, at(i, k) + off, at(i + 1, k), at(i + 1, k + 1) + off, at(i, k + 1));
    }
  }
}

using Draw = void (*)(test::Random&, Model&);
struct Kind {
  const char* name;
  Draw draw;
  bool closed;
};
constexpr std::array<Kind, 9> kKinds{{{"boxes", drawBoxes, true},
                                      {"shells", drawShells, true},
                                      {"cone", drawCone, true},
                                      {"cage", drawCage, true},
                                      {"slots", drawSlots, false},
                                      {"soup", drawSoup, false},
                                      {"segments and points", drawSegmentsAndPoints, false},
                                      {"double sheet", drawDoubleSheet, false},
                                      {"boxes in soup", drawBoxes, true}}};

void dressModel(test::Random& random, RandomScene& scene, Model& model) {
  Material& material = model.materials[0];
  dress(random, scene, material);
  if (scene.effect != Effect::kShading && scene.effect != Effect::kEverything) return;
  material.smooth = true;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    model.normals.push_back((Vec3::UnitZ() + 0.5 * random.inCube(1)).normalized());
    model.texcoords.emplace_back(random.uniform(-2, 2), random.uniform(-2, 2));
  }
  if (scene.effect == Effect::kShading) return;
  material.viscosity_Ns_m = random.uniform(0, 10);
  material.presliding_N_m = random.below(2) == 0 ? 0 : random.uniform(0, 1e4);
  model.textures = {makeTexture("noise", 16), makeTexture("sine", 16)};
  material.textureOf(Quantity::kStiffness) = {0, 0, 1};
  material.textureOf(Quantity::kHeight) = {1, 0, 0.1 * scene.settings.radius};
}

// As a shape leaves out what is degenerate, so does the judge.
void keepPrimitives(const Model& model, std::size_t closed, RandomScene& scene) {
  Primitive made;
  const auto& at = model.positions;
  bool all_closed = true;
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    const auto& t = model.triangles[i];
    const bool kept = makeTriangle(at[t[0]], at[t[1]], at[t[2]], 0, made);
    if (kept) scene.primitives.push_back(made);
    all_closed = all_closed && (kept || i >= closed);
  }
  for (std::size_t i = 0; all_closed && i < closed; ++i) {
    const auto& t = model.triangles[i];
    scene.solid.push_back({at[t[0]], at[t[1]], at[t[2]]});
  }
  for (const auto& s : model.segments) {
    if (test::makeSegment(at[s[0]], at[s[1]], 0, made)) scene.primitives.push_back(made);
  }
  for (const auto p : model.points) {
    if (test::makePoint(at[p], 0, made)) scene.primitives.push_back(made);
  }
}

}  // namespace

void drawRules(test::Random& random, RandomScene& scene) {
  scene.settings.ledger = static_cast<LedgerMode>(random.below(3));
  if (random.below(2) == 0) scene.settings.work_cap = kNoWorkCap;
}

void dress(test::Random& random, RandomScene& scene, Material& material) {
  if (scene.effect == Effect::kNone) return;
  scene.stiffness = material.stiffness = random.uniform(0, 1);
  if (scene.effect != Effect::kFriction && scene.effect != Effect::kEverything) return;
  material.dynamic_friction = random.uniform(0, 1);
  material.static_friction = material.dynamic_friction * random.uniform(1, 2);
  scene.static_friction = material.static_friction;
}

RandomScene drawScene(test::Random& random) {
  RandomScene scene;
  const Kind& kind = kKinds[static_cast<std::size_t>(random.below(kKinds.size()))];
  Model model;
  kind.draw(random, model);
  const std::size_t closed = kind.closed ? model.triangles.size() : 0;
  if (&kind == &kKinds.back()) drawSoup(random, model);
  scene.what = kind.name;
  scene.effect = static_cast<Effect>(random.below(5));
  scene.settings.radius = random.below(2) == 0 ? 1e-3 : anySize(random, 1e-6, 1e3);
  scene.settings.world_per_device = scene.settings.radius / 1e-3;
  drawRules(random, scene);
  const double away = random.below(2) == 0 ? 0 : anySize(random, 1, 1e4);
  scene.centre_W = scene.settings.radius * away * random.direction();
  const double coarse = random.below(3) == 0 ? anySize(random, 1, 1e3) : 1;  // the scene, beside the proxy
  scene.half = 8 * coarse;
  dressModel(random, scene, model);
  const Mat3 linear = coarse * scene.settings.radius * (random.below(2) == 0 ? Mat3(Mat3::Identity()) : turned(random));
  placeModel(model, {linear, scene.centre_W});
  keepPrimitives(model, closed, scene);
  Model other = model;
  std::shuffle(other.triangles.begin(), other.triangles.end(), random.engine());
  std::shuffle(other.segments.begin(), other.segments.end(), random.engine());
  std::shuffle(other.points.begin(), other.points.end(), random.engine());
  scene.snapshot = makeSnapshot(std::move(model), HierarchyKind::kBvh);
  scene.shuffled = makeSnapshot(std::move(other), random.below(2) == 0 ? HierarchyKind::kNone : HierarchyKind::kBvh);
  return scene;
}

}  // namespace hl::soak
