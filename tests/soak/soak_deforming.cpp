// The long run of meshes that bend: random closed meshes, whose vertices move on straight lines from frame to frame,
// and a proxy that is inside or outside of each. Looks for what must never happen: a mesh that has passed the proxy.
// Ends with code 1 when it has seen any of it. The judge looks at every triangle where it is at that moment: how often
// the mesh winds around the proxy, and how near it is; it shares no code with the proxy, its queries or its closest
// point.
//
// Where a mesh closes in on the proxy from all sides, or is folded through itself with the proxy in between, there is
// no room for it and no side: such lives end and are counted apart. A sign of them is a proxy that is pinched: it is
// not clear of the meshes by a tenth of its radius. Looks that found it squeezed by less are counted too.
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/judge.h"
#include "proxy/proxy.h"
#include "soak/finger.h"
#include "soak/run_options.h"

namespace hl::soak {

namespace {

constexpr double kRadius = 1;  // all lengths are in radii
constexpr int kBendingsPerLife = 25, kLivesPerPiece = 4;
constexpr std::int64_t kTick_ns = 1'000'000;
// Squeezed by several faces and edges at once the proxy comes clear by and by; carry() ends that at kPushTries.
constexpr double kClear = kRadius * (1 - 1e-4);
// Below it the proxy's centre no longer has the room that each step leaves it.
constexpr double kPinched = 0.9 * kRadius;

// The vertices of a closed mesh on a grid around a solid, and how it may bend.
class Solid {
 public:
  Solid(test::Random& random, int kind) : random_(random), kind_(kind) { kind == 0 ? makeSlab() : makeBlob(); }

  const Model& model() const { return model_; }

  /// Another place for each vertex.
  std::vector<Vec3> bent(const std::vector<Vec3>& before) {
    std::vector<Vec3> next = random_.below(3) == 0 ? before : model_.positions;
    const int changes = 1 + random_.below(3);
    for (int i = 0; i < changes; ++i) change(next);
    return next;
  }

 private:
  // A block whose upper side is a fine sheet.
  void makeSlab() {
    cells_ = 10 + random_.below(14);
    half_ = random_.uniform(6, 14);
    const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(i * (cells_ + 1) + k); };
    const auto along = [&](int i) { return half_ * (2.0 * i / cells_ - 1); };
    for (int i = 0; i <= cells_; ++i) {
      for (int k = 0; k <= cells_; ++k) {
        model_.positions.emplace_back(along(i), 0, along(k));
        free_.push_back(i > 0 && i < cells_ && k > 0 && k < cells_);
      }
    }
    for (int i = 0; i < cells_; ++i) {
      for (int k = 0; k < cells_; ++k) quad(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
    }
    closeBelow(at);
  }
  template <typename At>
  void closeBelow(const At& at) {
    std::vector<std::uint32_t> rim;
    for (int i = 0; i < cells_; ++i) rim.push_back(at(i, 0));
    for (int k = 0; k < cells_; ++k) rim.push_back(at(cells_, k));
    for (int i = cells_; i > 0; --i) rim.push_back(at(i, cells_));
    for (int k = cells_; k > 0; --k) rim.push_back(at(0, k));
    const auto bottom = static_cast<std::uint32_t>(model_.positions.size());
    model_.positions.emplace_back(0, -40, 0);
    free_.push_back(false);
    for (std::size_t i = 0; i < rim.size(); ++i)
      model_.triangles.push_back({bottom, rim[i], rim[(i + 1) % rim.size()]});
  }
  void makeBlob() {
    cells_ = 8 + random_.below(10);
    half_ = random_.uniform(3, 9);
    const int around = 2 * cells_;
    const auto at = [&](int i, int k) { return static_cast<std::uint32_t>((i - 1) * around + k % around); };
    for (int i = 1; i < cells_; ++i) {
      for (int k = 0; k < around; ++k) {
        const double polar = M_PI * i / cells_, azimuth = 2 * M_PI * k / around;
        model_.positions.push_back(
            half_ * Vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth)));
      }
    }
    const auto top = static_cast<std::uint32_t>(model_.positions.size());
    model_.positions.emplace_back(0, half_, 0);
    model_.positions.emplace_back(0, -half_, 0);
    for (int k = 0; k < around; ++k) {
      model_.triangles.push_back({top, at(1, k + 1), at(1, k)});
      model_.triangles.push_back({top + 1, at(cells_ - 1, k), at(cells_ - 1, k + 1)});
      for (int i = 1; i + 1 < cells_; ++i) quad(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
    }
    free_.assign(model_.positions.size(), true);
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    model_.triangles.push_back({a, b, c});
    model_.triangles.push_back({a, c, d});
  }

  template <typename Move>
  void forEachFree(std::vector<Vec3>& positions, const Move& move) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (free_[i]) positions[i] += move(positions[i]);
    }
  }
  void change(std::vector<Vec3>& p) {
    const double size = half_ * std::pow(10.0, random_.uniform(-2, -0.2));
    const Vec3 way = size * random_.direction(), middle = random_.inCube(half_);
    const double width = random_.uniform(1.2, half_);
    const Vec3 wave = random_.uniform(0.2, 1.5) * random_.direction();
    const double phase = random_.uniform(0, 2 * M_PI);
    switch (random_.below(6)) {
      case 0:  // a pit or a hill, somewhere
        return forEachFree(p, [&](const Vec3& x) -> Vec3 {
          return std::exp(-(x - middle).squaredNorm() / (width * width)) * 2 * way;
        });
      case 1:  // a wave
        return forEachFree(p, [&](const Vec3& x) -> Vec3 { return 0.5 * std::sin(wave.dot(x) + phase) * way; });
      case 2:  // aside
        return forEachFree(p, [&](const Vec3&) -> Vec3 { return way; });
      case 3:  // noise
        return forEachFree(p, [&](const Vec3&) -> Vec3 { return 0.3 * std::min(size, 1.0) * random_.direction(); });
      case 4: {  // larger, smaller or flatter
        const Vec3 factor(random_.uniform(-0.4, 0.6), random_.uniform(-0.4, 0.6), random_.uniform(-0.4, 0.6));
        return forEachFree(p, [&](const Vec3& x) -> Vec3 { return factor.cwiseProduct(x); });
      }
      default:
        return shrink(p);
    }
  }
  // Some triangles become lines or points.
  void shrink(std::vector<Vec3>& p) {
    for (int i = 1 + random_.below(8); i > 0; --i) {
      const auto& t =
          model_.triangles[static_cast<std::size_t>(random_.below(static_cast<int>(model_.triangles.size())))];
      if (!free_[t[0]] || !free_[t[1]] || !free_[t[2]]) continue;
      p[t[1]] = p[t[0]];
      if (random_.below(2) == 0) p[t[2]] = p[t[0]];
    }
  }

  test::Random& random_;
  const int kind_;
  int cells_ = 0;
  double half_ = 0;
  Model model_;
  std::vector<bool> free_;  // vertices that may move
};

// A solid angle of each triangle, by the formula of van Oosterom and Strackee; all in parts of the sphere.
double windingAround(const Model& model, const std::vector<Vec3>& positions, const Vec3& p) {
  double sum = 0;
  for (const auto& t : model.triangles) {
    const Vec3 a = positions[t[0]] - p, b = positions[t[1]] - p, c = positions[t[2]] - p;
    const double x = a.norm(), y = b.norm(), z = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
  }
  return sum / (2 * M_PI);
}

double clearanceOf(const Model& model, const std::vector<Vec3>& positions, const Vec3& p) {
  double nearest = 2 * kRadius;
  for (const auto& t : model.triangles) {
    const std::array<Vec3, 3> v{positions[t[0]], positions[t[1]], positions[t[2]]};
    const Vec3 low = v[0].cwiseMin(v[1]).cwiseMin(v[2]), high = v[0].cwiseMax(v[1]).cwiseMax(v[2]);
    if (((low - p).cwiseMax(p - high).array() > nearest).any()) continue;
    Primitive triangle;
    if (!makeTriangle(v[0], v[1], v[2], 0, triangle)) continue;
    nearest = std::min(nearest, static_cast<double>(test::judgedDistance(triangle, p.cast<test::Real>())));
  }
  return nearest;
}

struct Seen {
  std::uint64_t bendings = 0, ticks = 0, touching = 0, capped = 0, pinched = 0, squeezed = 0, lives = 0;
  double least_above = 1;  // of clearance / radius - 1, where nothing pinches it
  std::string fault;

  void add(const Seen& other) {
    bendings += other.bendings;
    ticks += other.ticks;
    touching += other.touching;
    capped += other.capped;
    pinched += other.pinched;
    squeezed += other.squeezed;
    lives += other.lives;
    least_above = std::min(least_above, other.least_above);
  }
};

class Piece {
 public:
  Piece(std::uint64_t seed, std::uint64_t number) : random_(generatorOf(seed, number)) {
    settings_.radius = kRadius;
    if (random_.below(3) == 0) settings_.surfaces.static_friction = settings_.surfaces.dynamic_friction = 0.5;
  }
  Seen run() {
    for (int i = 0; i < kLivesPerPiece && seen_.fault.empty(); ++i) live();
    return seen_;
  }

 private:
  struct Mesh {
    Solid solid;
    Pose pose;
    std::shared_ptr<const Shape> shape;
    std::shared_ptr<const MeshMotion> mesh_motion;
    int winding = 0;
  };

  void live() {
    ++seen_.lives;
    meshes_.clear();
    const int count = 1 + random_.below(3);
    for (int i = 0; i < count; ++i) addMesh(i == 0 ? random_.below(2) : 1, i);
    time_ns_ = 0;
    number_ = 0;
    pinched_ = false;
    show();
    Finger finger(random_, Vec3::Constant(10));
    do {
      state_ = startProxy(SceneAt(*scene_, time_ns_), settings_, finger.anywhere());
    } while (!state_.free);
    for (Mesh& mesh : meshes_) mesh.winding = windingOf(mesh);
    for (int i = 0; i < kBendingsPerLife && seen_.fault.empty() && !pinched_; ++i) bendOnce(finger);
    seen_.pinched += pinched_ ? 1 : 0;
  }
  void addMesh(int kind, int i) {
    Mesh mesh{Solid(random_, kind), {}, nullptr, nullptr, 0};
    if (i > 0)
      mesh.pose = {Eigen::AngleAxisd(random_.uniform(0, 3), random_.direction()).toRotationMatrix(),
                   random_.inCube(20)};
    mesh.shape = makeShape(Model(mesh.solid.model()));
    meshes_.push_back(std::move(mesh));
  }
  void show() {
    std::vector<Instance> instances;
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      Instance instance;
      instance.shape = meshes_[i].shape;
      instance.surfaces = surfacesOf(instance.shape);
      instance.motion = Motion(meshes_[i].pose);
      instance.key = i + 1;
      instance.mesh_motion = meshes_[i].mesh_motion;
      instances.push_back(std::move(instance));
    }
    scene_ = makeSnapshot(std::move(instances), "bending", ++number_);
  }

  // Each mesh, or some, from where it is; then ticks until all have come to rest, or nearly.
  void bendOnce(Finger& finger) {
    ++seen_.bendings;
    const std::int64_t frame_ns = kTick_ns * (5 + random_.below(46));  // 200 to 20 Hz
    for (Mesh& mesh : meshes_) {
      if (random_.below(4) == 0) continue;
      Model model = mesh.shape->model;
      model.positions = mesh.solid.bent(model.positions);
      auto next = makeShape(std::move(model), *mesh.shape);
      const bool goes_on = mesh.mesh_motion && mesh.mesh_motion->end_ns() > time_ns_;
      mesh.mesh_motion = std::make_shared<MeshMotion>(
          goes_on ? mesh.mesh_motion->then(next, time_ns_, time_ns_ + frame_ns)
                  : MeshMotion(MeshTransition(mesh.shape, next, time_ns_, time_ns_ + frame_ns)));
      mesh.shape = std::move(next);
    }
    show();
    const std::int64_t until_ns = time_ns_ + frame_ns - kTick_ns * random_.below(3);
    const std::int64_t looked_at_ns = time_ns_ + kTick_ns * random_.below(static_cast<int>(frame_ns / kTick_ns));
    while (time_ns_ < until_ns && seen_.fault.empty() && !pinched_) {
      time_ns_ += kTick_ns;
      tickOnce(finger);
      if (time_ns_ == looked_at_ns || time_ns_ >= until_ns) judge();
    }
  }
  void tickOnce(Finger& finger) {
    const SceneAt scene(*scene_, time_ns_);
    const TickReport report = tick(state_, scene, settings_, finger.next(state_.position));
    ++seen_.ticks;
    seen_.touching += state_.touching ? 1 : 0;
    seen_.capped += report.capped() ? 1 : 0;
    bool near = false;
    scene.primitivesWithin(state_.position, kPinched, [&](PrimitiveId, const ClosestPoint&) { near = true; });
    pinched_ = near || !state_.free;
  }

  std::vector<Vec3> placesOf(const Mesh& mesh) const {
    std::vector<Vec3> places = mesh.shape->model.positions;
    if (mesh.mesh_motion && time_ns_ < mesh.mesh_motion->end_ns()) {
      const MeshTransition& way = mesh.mesh_motion->at(time_ns_);
      const double part = std::clamp(
          static_cast<double>(time_ns_ - way.begin_ns()) / static_cast<double>(way.end_ns() - way.begin_ns()), 0.0,
          1.0);
      for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = way.given_from()->model.positions[i] +
                    part * (way.given_to()->model.positions[i] - way.given_from()->model.positions[i]);
    }
    return places;
  }
  int windingOf(const Mesh& mesh) const {
    return static_cast<int>(
        std::lround(windingAround(mesh.shape->model, placesOf(mesh), mesh.pose.toObject(state_.position))));
  }
  void judge() {
    if (pinched_) return;
    if (!state_.position.allFinite()) return blame("the proxy is not finite");
    for (const Mesh& mesh : meshes_) {
      const Vec3 p = mesh.pose.toObject(state_.position);
      const double above = clearanceOf(mesh.shape->model, placesOf(mesh), p) / kRadius - 1;
      seen_.least_above = std::min(seen_.least_above, above);
      seen_.squeezed += above < kClear - 1 ? 1 : 0;
      if (windingOf(mesh) != mesh.winding) return blame("a mesh has passed the proxy");
    }
  }
  void blame(const std::string& what) {
    seen_.fault = fmt::format("bending {}, tick {}: {}", seen_.bendings, seen_.ticks, what);
  }

  test::Random random_;
  ProxySettings settings_;
  std::vector<Mesh> meshes_;
  std::shared_ptr<const Snapshot> scene_;
  std::uint64_t number_ = 0;
  std::int64_t time_ns_ = 0;
  ProxyState state_;
  bool pinched_ = false;
  Seen seen_;
};

struct Options : RunOptions {
  double bendings = 1e6;
};

Options parse(int argc, char** argv) {
  Options options;
  CLI::App app("The long run of meshes that bend against a proxy.", "soak_deforming");
  app.add_option("--bendings", options.bendings, "How many at most, rounded up to pieces of 100")
      ->capture_default_str();
  addRunOptions(app, options);
  parseOrExit(app, argc, argv);
  return options;
}

int run(const Options& options) {
  const Pieces pieces = piecesOf(options, options.bendings, kBendingsPerLife * kLivesPerPiece);
  Seen all;
  Faults faults;
  Progress progress(pieces.count());
  const auto collect = [&](std::uint64_t number, const Seen& seen) {
    all.add(seen);
    if (seen.fault.empty()) return;
    addFault(faults, number,
             fmt::format("FAULT in {}; again: soak_deforming --seed {} --piece {}", seen.fault, options.seed, number));
  };
  runPieces(
      pieces, progress, [&](std::uint64_t number) { return Piece(options.seed, number).run(); }, collect);
  fmt::print(
      "{} bendings in {} lives, {} ticks, {:.0f} % in contact, {} at the cap; {} lives ended in a pinch, {} looks "
      "found it squeezed; "
      "clearance >= radius (1 + {:.2g})\n",
      all.bendings, all.lives, all.ticks,
      100.0 * static_cast<double>(all.touching) / static_cast<double>(std::max<std::uint64_t>(1, all.ticks)),
      all.capped, all.pinched, all.squeezed, all.least_above);
  return report(faults);
}

}  // namespace

}  // namespace hl::soak

int main(int argc, char** argv) { return hl::soak::run(hl::soak::parse(argc, argv)); }
