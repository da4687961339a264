// The long run of random scenes: in each a random path, and each promise of docs/trace.md judged by plain means: by
// looking at every primitive, by the solid angle of closed surfaces, by trying every set of planes. What a piece has
// found wrong is said with how to run it again. Ticks at the iteration cap are counted, and judged but for being at
// rest.
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "soak/clearance.h"
#include "soak/finger.h"
#include "soak/random_scenes.h"
#include "soak/random_surfaces.h"
#include "soak/run_options.h"

namespace hl::soak {

namespace {

constexpr int kMovingTicks = 60, kRestingTicks = 20, kStretch = 20;  // of one scene
constexpr double kEps = std::numeric_limits<double>::epsilon();

// Where a tick ends between edges that all but face each other: docs/trace.md.
constexpr double kMaxResidual = 1.5e-5;

// radii: between planes that contradict each other by rounding the proxy is held within the skin, 1e-10 of the radius.
constexpr double kMaxAway = 1e-10;

// How often the surface is wound about a place, by the solid angle of each triangle (van Oosterom and Strackee 1983).
double windingNumber(const std::vector<std::array<Vec3, 3>>& solid, const Vec3& place) {
  double angle = 0;
  for (const auto& triangle : solid) {
    const Vec3 a = (triangle[0] - place).normalized(), b = (triangle[1] - place).normalized(),
               c = (triangle[2] - place).normalized();
    angle += 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return angle / (4 * M_PI);
}

// The part of the unit vector `pull` that no sum of normals with weights >= 0 resists: the least over all sets of up to
// three of them.
double unresisted(const std::vector<Vec3>& normals, const Vec3& pull) {
  double least = 1;
  const auto offer = [&](const std::vector<std::size_t>& set) {
    Eigen::MatrixXd n(3, static_cast<Eigen::Index>(set.size()));
    for (std::size_t i = 0; i < set.size(); ++i) n.col(static_cast<Eigen::Index>(i)) = -normals[set[i]];
    const Eigen::VectorXd weights = n.colPivHouseholderQr().solve(pull);
    if ((weights.array() >= 0).all()) least = std::min(least, (pull - n * weights).norm());
  };
  for (std::size_t i = 0; i < normals.size(); ++i) {
    offer({i});
    for (std::size_t j = 0; j < i; ++j) {
      offer({i, j});
      for (std::size_t k = 0; k < j; ++k) offer({i, j, k});
    }
  }
  return least;
}

struct Seen {
  std::uint64_t scenes = 0, ticks = 0, touching = 0, capped = 0, unplaced = 0;
  double most_residual = 0, least_above = 1;
  std::string fault;

  void add(const Seen& other) {
    scenes += other.scenes;
    ticks += other.ticks;
    touching += other.touching;
    capped += other.capped;
    unplaced += other.unplaced;
    most_residual = std::max(most_residual, other.most_residual);
    least_above = std::min(least_above, other.least_above);
  }
};

class Run {
 public:
  Run(std::uint64_t seed, std::uint64_t number, bool surfaces)
      : random_(generatorOf(seed, number)),
        scene_(surfaces ? drawSurface(random_) : drawScene(random_)),
        clearance_(scene_.primitives),
        path_(random_, Vec3::Constant(scene_.half)) {}

  Seen run() {
    seen_.scenes = 1;
    finger_ = toWorld(path_.anywhere());
    state_ = startProxy(*scene_.snapshot, scene_.settings, finger_);
    shuffled_ = startProxy(*scene_.shuffled, scene_.settings, finger_);
    for (int i = 0; i < kMovingTicks + kRestingTicks && seen_.fault.empty(); ++i) {
      if (i < kMovingTicks) finger_ = i % kStretch < kStretch / 2 ? towardSurface(i) : wandering();
      resting_ticks_ = i < kMovingTicks ? 0 : resting_ticks_ + 1;
      tickOnce();
    }
    return seen_;
  }

 private:
  double radius() const { return scene_.settings.radius; }
  Vec3 toWorld(const Vec3& p) const { return scene_.centre_W + radius() * p; }
  void blame(const std::string& what) {
    if (seen_.fault.empty()) seen_.fault = fmt::format("tick {}: {}", seen_.ticks, what);
  }

  Vec3 wandering() { return toWorld(path_.next((state_.position - scene_.centre_W) / radius())); }

  // Into what a primitive is about, at any speed, and now and then far beyond.
  Vec3 towardSurface(int i) {
    if (i % (kStretch / 2) == 0) {
      const auto chosen = static_cast<std::size_t>(random_.below(static_cast<int>(scene_.primitives.size())));
      const auto& v = scene_.primitives[chosen].vertex;
      const double u = random_.uniform(0, 1), w = random_.uniform(0, 1 - u);
      const bool at_vertex = random_.below(3) == 0;
      const double off = at_vertex ? std::pow(10.0, random_.uniform(-9, 0)) : random_.uniform(0, 2);
      aim_ = (at_vertex ? v[0] : Vec3(v[0] + u * (v[1] - v[0]) + w * (v[2] - v[0]))) + radius() * random_.inCube(off);
      if (random_.below(6) == 0) aim_ += std::pow(10.0, random_.uniform(1, 10)) * radius() * random_.direction();
      part_ = random_.below(3) == 0 ? 1 : random_.uniform(0.01, 0.5);
    }
    return finger_ + part_ * (aim_ - finger_);
  }

  void tickOnce() {
    const ProxyState before = state_;
    const TickReport report = tick(state_, *scene_.snapshot, scene_.settings, finger_);
    const TickReport other = tick(shuffled_, *scene_.shuffled, scene_.settings, finger_);
    ++seen_.ticks;
    seen_.touching += report.contacts.empty() ? 0 : 1;
    seen_.capped += report.capped() ? 1 : 0;
    seen_.unplaced += report.placed() ? 0 : 1;
    const bool same = state_.position == shuffled_.position && report.target == other.target;
    if (scene_.settings.work_cap == kNoWorkCap && !same)
      blame(fmt::format("the order of the primitives changes bits, by {:.3g} radii",
                        (state_.position - shuffled_.position).norm() / radius()));
    if (!state_.position.allFinite() || !report.target.allFinite() || !std::isfinite(report.injected_J))
      return blame("a number is not finite");
    if (!report.placed()) return judgeUnplaced(report);
    judgeClearance();
    if (before.free) judgeCrossing(before);
    judgeForce(report);
    if (before.free) judgeEnergy(before, report);
    if (!report.capped()) judgeRest(report);
  }

  void judgeUnplaced(const TickReport& report) {
    if (report.target != finger_ || !report.contacts.empty()) blame("a proxy without a place pulls");
  }

  // What rounding may cost: as of soak.cpp.
  void judgeClearance() {
    const double above = clearance_.at(state_.position, 2 * radius()) / radius() - 1;
    seen_.least_above = std::min(seen_.least_above, above);
    const double rounding = std::max(1e-6, 20 * std::sqrt(kEps * scene_.snapshot->extent / radius()));
    if (above < -rounding) blame(fmt::format("the proxy is too near by {:.3g} radii", -above));
  }

  void judgeCrossing(const ProxyState& before) {
    if (scene_.solid.empty()) return;
    const double change = windingNumber(scene_.solid, state_.position) - windingNumber(scene_.solid, before.position);
    if (std::abs(change) > 0.5) blame("the proxy has crossed a closed surface");
  }

  // target = finger + s (proxy - finger), s the surfaces' or, where energy is short, less or what it was.
  void judgeForce(const TickReport& report) {
    const Vec3 gap = state_.position - finger_, pull = report.target - finger_;
    const double rounding = 64 * kEps * (finger_.norm() + scene_.snapshot->extent);
    const double s = state_.touching ? state_.stiffness : gap.norm() > 0 && pull.norm() == 0 ? 0 : 1;
    if ((pull - s * gap).norm() > rounding) blame("the target is not finger + s (proxy - finger)");
    if (!(s >= 0 && s <= 1 + 1e-12)) blame("s is not within 0 and 1");
    constexpr double kOfMean = 1e-11;  // of the stiffness: a mean over contacts, some of which pull
    const bool one_stiffness = scene_.effect == Effect::kNone || scene_.effect == Effect::kStiffness;
    if (one_stiffness && !report.contacts.empty() &&
        std::abs(s - scene_.stiffness) * gap.norm() > rounding + kOfMean * gap.norm())
      blame("s is not that of the surface");
    if (one_stiffness && pull.norm() > scene_.stiffness * gap.norm() + rounding)
      blame("a tick on its way pulls harder");
  }

  void judgeEnergy(const ProxyState& before, const TickReport& report) {
    const double gap2_D = (before.position - finger_).squaredNorm() / std::pow(scene_.settings.world_per_device, 2);
    const double rounding_J = 1e-12 + 64 * kEps * 0.5 * scene_.settings.spring_N_m * gap2_D;
    const bool adds = scene_.effect == Effect::kShading || scene_.effect == Effect::kEverything;
    if ((scene_.settings.ledger == LedgerMode::kStrict || !adds) && report.injected_J > rounding_J)
      blame(fmt::format("a tick has added {:.3g} J", report.injected_J));
    if (scene_.settings.ledger == LedgerMode::kTank && report.injected_J > before.ledger.tank_J + rounding_J)
      blame(fmt::format("a tick has added {:.3g} J, and the tank held {:.3g} J", report.injected_J,
                        before.ledger.tank_J));
    if (adds) return;
    const double far = (before.position - finger_).norm(), now = (state_.position - finger_).norm();
    if (now > far + kMaxAway * radius() + 64 * kEps * (far + scene_.snapshot->extent))
      blame(fmt::format("the proxy has gone away from the finger, by {:.3g} radii", (now - far) / radius()));
  }

  // At rest the pull is a sum of normals; with friction, within its cone once the finger stands still.
  void judgeRest(const TickReport& report) {
    const bool plain = scene_.effect == Effect::kNone || scene_.effect == Effect::kStiffness;
    const Vec3 pull = finger_ - state_.position;
    if (pull.norm() < 1e-6 * radius() + 64 * kEps * scene_.snapshot->extent) return;
    if (report.ending == Ending::kOutOfWork) return;  // on its way
    if (plain) {
      std::vector<Vec3> normals = normalsAbout(state_.position);
      if (normals.size() > 40) return;
      const double residual = unresisted(normals, pull.normalized());
      seen_.most_residual = std::max(seen_.most_residual, residual);
      if (residual > kMaxResidual) blame(fmt::format("the proxy is not at rest: residual {:.3g}", residual));
    } else if (scene_.effect == Effect::kFriction && resting_ticks_ > kRestingTicks / 2) {
      Vec3 along = pull;
      double most = 0;
      for (const ProxyContact& contact : report.contacts) {
        along += contact.multiplier_m * contact.normal;
        most += scene_.static_friction * contact.multiplier_m;
      }
      if (along.norm() > (1 + 1e-6) * most + 1e-6 * pull.norm())
        blame(fmt::format("friction holds {:.6g} of the pull, and may hold {:.6g}", along.norm() / pull.norm(),
                          most / pull.norm()));
    }
  }

  std::vector<Vec3> normalsAbout(const Vec3& place) const {
    std::vector<Vec3> normals;
    const double within = radius() * (1 + 1e-6) + 4096 * kEps * scene_.snapshot->extent;
    for (const Primitive& primitive : scene_.primitives) {
      const ClosestPoint nearest = closestPoint(primitive, place);
      if (nearest.distance <= within) normals.push_back(nearest.normal);
    }
    return normals;
  }

  test::Random random_;
  const RandomScene scene_;
  const Clearance clearance_;
  Finger path_;
  Vec3 finger_ = Vec3::Zero();
  ProxyState state_, shuffled_;
  Vec3 aim_ = Vec3::Zero();
  double part_ = 1;
  int resting_ticks_ = 0;
  Seen seen_;

 public:
  const RandomScene& scene() const { return scene_; }
};

struct Options : RunOptions {
  std::uint64_t scenes = 1000;
  bool surfaces = false;
};

Options parse(int argc, char** argv) {
  Options options;
  CLI::App app("Random scenes and paths, and every promise of a tick judged by plain means.", "soak_scenes");
  app.add_option("--scenes", options.scenes, "How many")->capture_default_str();
  app.add_flag("--surfaces", options.surfaces, "Surfaces that make their triangles or points, each beside its mesh");
  addRunOptions(app, options, "scene");
  parseOrExit(app, argc, argv);
  return options;
}

int run(const Options& options) {
  const Pieces pieces = piecesOf(options, static_cast<double>(options.scenes), 1);
  Seen all;
  Faults faults;
  Progress progress(pieces.count());
  const auto one = [&](std::uint64_t number) {
    Run run(options.seed, number, options.surfaces);
    Seen seen = run.run();
    if (!seen.fault.empty())
      seen.fault = fmt::format("FAULT in {} with effect {}, {}; again: soak_scenes --seed {} --scene {}{}",
                               run.scene().what, static_cast<int>(run.scene().effect), seen.fault, options.seed, number,
                               options.surfaces ? " --surfaces" : "");
    return seen;
  };
  runPieces(pieces, progress, one, [&](std::uint64_t number, const Seen& seen) {
    all.add(seen);
    if (!seen.fault.empty()) faults[number] = seen.fault;
  });
  for (const auto& [number, fault] : faults) fmt::print("{}\n", fault);
  fmt::print(
      "{} ticks in {} scenes, {} in contact, {} at the cap, {} without a place; clearance >= radius (1 + {:.2g}), "
      "residual <= {:.2g}; {} faults\n",
      all.ticks, all.scenes, all.touching, all.capped, all.unplaced, all.least_above, all.most_residual, faults.size());
  return faults.empty() ? 0 : 1;
}

}  // namespace

}  // namespace hl::soak

int main(int argc, char** argv) { return hl::soak::run(hl::soak::parse(argc, argv)); }
