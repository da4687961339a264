#include "golden/cases.h"

#include <algorithm>
#include <bit>

#include "builtin.h"

namespace hl::golden {

namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr double kSpeed_m = 0.15e-3;            // m per tick: 0.15 m/s at 1 kHz
constexpr std::int64_t kFrame_ns = 33'000'000;  // between two frames of what moves

// SplitMix64: the standard's distributions differ from library to library.
class Numbers {
 public:
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t x = state_;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }
  double within(double low, double high) { return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53); }

 private:
  std::uint64_t state_ = 1997;
};

// FNV-1a over words, each of them mixed once more: a bit at the top of a word reaches the whole hash.
class Hash {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3u;
    value_ ^= value_ >> 32;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

void addTick(Hash& hash, const ProxyState& state, const TickReport& report) {
  hash.add(state.position);
  hash.add(state.sticking.springs.stretch_m);
  hash.add(state.stiffness);
  hash.add(report.target);
  hash.add(report.injected_J);
  hash.add(report.moved_J);
  hash.add(std::uint64_t{report.capped()} << 1 | std::uint64_t{state.free});
  for (const ProxyContact& contact : report.contacts) {
    hash.add(contact.point);
    hash.add(contact.normal);
    hash.add(contact.multiplier_m);
    hash.add(contact.stiffness);
    hash.add(contact.static_friction);
  }
  hash.add(state.ledger.tank_J);
  hash.add(state.ledger.injected_J);
  hash.add(state.ledger.dissipated_J);
}

// A finger that strokes from vertex to vertex of the model, mostly a little beneath the surface.
class Finger {
 public:
  explicit Finger(const Model& model) : model_(model), from_(model.positions.front()), to_(from_) {}

  Vec3 next() {
    if (step_ >= steps_) choose();
    const double s = static_cast<double>(++step_) / static_cast<double>(steps_);
    return from_ + s * s * (3 - 2 * s) * (to_ - from_);
  }

 private:
  void choose() {
    constexpr int kTries = 16;  // the nearest of so many: strokes stay near the surface
    from_ = to_;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTries; ++i) {
      const std::size_t vertex = random_.next() % model_.positions.size();
      const Vec3 place = model_.positions[vertex] + random_.within(-0.004, 0.001) * model_.normals[vertex];
      const double distance_m = (place - from_).norm();
      if (!(distance_m < nearest_m)) continue;
      nearest_m = distance_m;
      to_ = place;
    }
    step_ = 0;
    steps_ = 20 + static_cast<std::int64_t>(nearest_m / kSpeed_m);
  }

  const Model& model_;
  Numbers random_;
  Vec3 from_, to_;
  std::int64_t step_ = 0, steps_ = 0;
};

// The scene, and what moves it from frame to frame as a client at 30 frames a second does.
class World {
 public:
  World(const Case& which, HierarchyKind hierarchy) : moves_(which.moves) {
    Model model = makeBuiltinScene(which.scene);
    if (which.change != nullptr) which.change(model);
    shape_ = makeShape(std::move(model), hierarchy);
    surfaces_ = surfacesOf(shape_);
    show();
  }

  const Model& model() const { return shape_->model; }
  const Snapshot& at(std::int64_t time_ns) {
    if (moves_ && time_ns % kFrame_ns == 0) {
      motion_ = motion_.then(goal(), time_ns, time_ns + kFrame_ns);
      show();
    }
    return *snapshot_;
  }

 private:
  // Another place near by, turned by another quaternion near one.
  Pose goal() {
    const auto part = [&] { return random_.within(-1, 1); };
    Eigen::Quaterniond turn(1, 0, 0, 0);
    turn.x() = 0.01 * part();
    turn.y() = 0.02 * part();
    turn.z() = 0.01 * part();
    turn.normalize();
    Pose pose;
    pose.rotation = turn.toRotationMatrix();
    for (int i = 0; i < 3; ++i) pose.origin[i] = 0.002 * part();
    return pose;
  }
  void show() {
    Instance instance;
    instance.shape = shape_;
    instance.surfaces = surfaces_;
    instance.motion = motion_;
    instance.key = 1;
    snapshot_ = makeSnapshot({std::move(instance)}, {}, ++number_);
  }

  bool moves_;
  std::uint64_t number_ = 0;
  Numbers random_;
  Motion motion_;
  std::shared_ptr<const Shape> shape_;
  std::shared_ptr<const Surfaces> surfaces_;
  std::shared_ptr<const Snapshot> snapshot_;
};

Material& only(Model& model) { return model.materials.front(); }

void modulate(Model& model, Quantity quantity, const char* kind, double low, double high) {
  only(model).textureOf(quantity) = {static_cast<std::uint32_t>(model.textures.size()), low, high};
  model.textures.push_back(makeTexture(kind, 32));
}

void smooth(Model& model) { only(model).smooth = true; }
void friction(Model& model) {
  only(model).static_friction = 0.5;
  only(model).dynamic_friction = 0.3;
}
void stribeck(Model& model) {
  friction(model);
  only(model).stribeck_m_s = 0.02;
  only(model).presliding_N_m = 4000;
}
void viscosity(Model& model) { only(model).viscosity_Ns_m = 2; }
void stiffness(Model& model) { only(model).stiffness = 0.4; }
void stiffnessTexture(Model& model) { modulate(model, Quantity::kStiffness, "noise", 0.3, 1); }
void frictionTexture(Model& model) {
  modulate(model, Quantity::kStaticFriction, "lines", 0.2, 0.6);
  modulate(model, Quantity::kDynamicFriction, "checker", 0, 0.4);
}
void viscosityTexture(Model& model) { modulate(model, Quantity::kViscosity, "sine", 0, 4); }
void heightTexture(Model& model) { modulate(model, Quantity::kHeight, "sine", 0, 2e-4); }
void everything(Model& model) {
  smooth(model);
  stribeck(model);
  viscosity(model);
  stiffnessTexture(model);
  frictionTexture(model);
  heightTexture(model);
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> kAll{
      {"teapot", "teapot"},
      {"walker", "walker"},
      {"terrain", "terrain"},
      {"sphere", "sphere"},
      {"plane", "plane"},
      {"pipe", "pipe"},
      {"pits", "pits"},
      {"soup", "soup"},
      {"smooth", "terrain:5000", smooth},
      {"friction", "terrain:5000", friction},
      {"stribeck and presliding", "terrain:5000", stribeck},
      {"viscosity", "terrain:5000", viscosity},
      {"stiffness", "terrain:5000", stiffness},
      {"texture of stiffness", "terrain:5000", stiffnessTexture},
      {"texture of friction", "terrain:5000", frictionTexture},
      {"texture of viscosity", "terrain:5000", viscosityTexture},
      {"texture of height", "terrain:5000", heightTexture},
      {"everything", "sphere:5000", everything},
      {"moving", "sphere:5000", nullptr, true},
      {"moving, everything", "sphere:5000", everything, true},
  };
  return kAll;
}

std::size_t elementsOf(const Case& which) { return makeBuiltinScene(which.scene).elements(); }

std::vector<std::uint64_t> hashesOf(const Case& which, HierarchyKind hierarchy,
                                    const std::vector<std::int64_t>& ticks) {
  World world(which, hierarchy);
  Finger finger(world.model());
  ManyRecentPrimitives recent;
  ProxySettings settings;
  settings.work_cap = kNoWorkCap;  // where a tick is out of work, hierarchies differ
  Hash hash;
  std::vector<std::uint64_t> hashes;
  ProxyState state = startProxy(world.at(0), settings, finger.next());
  for (std::int64_t i = 1; i <= ticks.back(); ++i) {
    const std::int64_t time_ns = i * kPeriod_ns;
    const SceneAt scene(world.at(time_ns), time_ns, recent);
    addTick(hash, state, tick(state, scene, settings, finger.next()));
    if (i == ticks[hashes.size()]) hashes.push_back(hash.value());
  }
  return hashes;
}

}  // namespace hl::golden
