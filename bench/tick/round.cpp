#include "tick/round.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "tick/own_queries.h"

namespace hl::bench {

namespace {

constexpr std::size_t kMaxForNone = 11'000;  // primitives: testing every one takes a millisecond and more
constexpr std::size_t kTicksForNone = 1000;
constexpr double kPeerRow_s = 5;  // of questions to a peer, for one row

std::string number(std::size_t n) { return std::to_string(n) + " primitives"; }

ProxySettings settingsOf(const Case& of) {
  ProxySettings settings;
  settings.radius = of.radius_m;
  return settings;
}

}  // namespace

const Answers* Case::ownTo(Question question) const {
  const Question same = question == Question::kNearest ? Question::kNear : question;
  const auto* const found = std::find(kOwnQuestions.begin(), kOwnQuestions.end(), same);
  return found == kOwnQuestions.end() ? nullptr : &own[static_cast<std::size_t>(found - kOwnQuestions.begin())];
}

Round::Round(const SuitePlan& plan, const SuiteOutput& output, const BenchScene& scene, std::size_t size)
    : plan_(plan), output_(output), scene_(scene) {
  say("making about " + number(size));
  shape_ = makeShape(scene.make(size));
  plain_ = makeSnapshotOf(shape_, Feel::kPlain);
  if (plain_->primitives == 0) throw Error(scene.name + ": nothing in it can be touched");
  mesh_ = trianglesOf(*shape_);
  mean_edge_m_ = meanEdge_m(mesh_);
  say("building " + number(plain_->primitives));
  cost_ = costOf(*shape_, HierarchyKind::kBvh);
}

void Round::run() {
  for (const RadiusMode mode : plan_.radii) {
    for (const FingerMotion motion : plan_.motions) measureTicks(motion, mode);
  }
  if (scene_.effects) measureEffects();
  measureHierarchies();
  if (plan_.peers) measurePeers();
}

void Round::say(const std::string& what) const { output_.progress(scene_.name + ": " + what); }

Row Round::rowOf(const Case& of, const std::string& who, const std::string& question) const {
  Row row;
  row.scene = scene_.name;
  row.motion = nameOf(of.motion);
  row.radius = nameOf(of.mode);
  row.radius_m = of.radius_m;
  row.who = who;
  row.question = question;
  row.primitives = plain_->primitives;
  row.mean_edge_m = mean_edge_m_;
  return row;
}

void Round::putTicks(const Case& of, HierarchyKind hierarchy, Feel feel, const TickTimes& ticks,
                     const Cost& cost) const {
  Row row = rowOf(of, "hl", "tick");
  row.hierarchy = nameOf(hierarchy);
  row.surface = nameOf(feel);
  row.times = ticks.times.middle();
  row.single = ticks.times.all();
  row.capped = ticks.capped;
  row.out_of_work = ticks.out_of_work;
  row.cost = cost;
  row.to_plain = row.times.mean_us() / of.plain.mean_us();
  output_.row(row);
}

void Round::measureTicks(FingerMotion motion, RadiusMode mode) {
  const double radius_m = mode == RadiusMode::kFixed ? plan_.radius_m : plan_.radius_edges * mean_edge_m_;
  if (!(radius_m > 0)) {
    output_.note(scene_.name + ", " + nameOf(motion) + ": no radius in proportion to a mesh without triangles");
    return;
  }
  say(std::string(nameOf(motion)) + " on " + number(plain_->primitives));
  Case next{motion, mode, radius_m};
  const double world_per_hand = mode == RadiusMode::kZoomed ? radius_m / plan_.radius_m : 1;
  next.path = planPath(*plain_, motion, settingsOf(next), plan_.ticks, world_per_hand);
  const TickTimes plain = timeTicks(*plain_, settingsOf(next), next.path, plan_.ticks);
  next.plain = plain.times.middle();
  putTicks(next, HierarchyKind::kBvh, Feel::kPlain, plain, cost_);
  cases_.push_back(std::move(next));
}

const Case* Round::slide() const {
  const auto found = std::find_if(cases_.begin(), cases_.end(), [](const Case& of) {
    return of.motion == FingerMotion::kSliding && of.mode == RadiusMode::kFixed;
  });
  return found == cases_.end() ? nullptr : &*found;
}

void Round::measureEffects() const {
  const Case* of = slide();
  if (of == nullptr) return;
  for (const Feel feel : kFeels) {
    if (feel == Feel::kPlain) continue;
    const auto snapshot = makeSnapshotOf(shape_, feel);
    putTicks(*of, HierarchyKind::kBvh, feel, timeTicks(*snapshot, settingsOf(*of), of->path, plan_.ticks), cost_);
  }
}

void Round::measureHierarchies() const {
  const Case* of = slide();
  if (of == nullptr) return;
  for (const HierarchyKind kind : plan_.hierarchies) {
    const bool none = kind == HierarchyKind::kNone;
    if (kind == HierarchyKind::kBvh || (none && plain_->primitives > kMaxForNone)) continue;
    say(std::string("hierarchy ") + hl::nameOf(kind) + " on " + number(plain_->primitives));
    const auto shape = makeShape(Model(shape_->model), kind);
    const auto snapshot = makeSnapshotOf(shape, Feel::kPlain);
    const std::size_t ticks = none ? std::min(plan_.ticks, kTicksForNone) : plan_.ticks;
    putTicks(*of, kind, Feel::kPlain, timeTicks(*snapshot, settingsOf(*of), of->path, ticks), costOf(*shape, kind));
  }
}

void Round::measurePeers() {
  if (mesh_.triangles.size() != plain_->primitives) {
    output_.note(scene_.name + ": peers left out: they take triangles alone");
    return;
  }
  for (Case& of : cases_) measureOwnQueries(of);
  for (const PeerKind& kind : peers()) {
    try {
      measurePeer(kind);
    } catch (const std::bad_alloc&) {
      output_.note(scene_.name + ", " + number(plain_->primitives) + ": " + kind.name + " left out: not enough memory");
    }
  }
}

void Round::measureOwnQueries(Case& of) const {
  of.probes = probesOf(of.path, of.radius_m);
  const auto own = makeOwnQueries(*plain_);
  for (std::size_t i = 0; i < kOwnQuestions.size(); ++i) {
    of.own[i] = timeAnswers(*own, kOwnQuestions[i], of.probes, HUGE_VAL);
    Row row = rowOf(of, "hl", nameOf(kOwnQuestions[i]));
    row.hierarchy = hl::nameOf(HierarchyKind::kBvh);
    row.times = of.own[i].times.middle();
    row.single = of.own[i].times.all();
    row.to_tick = row.times.median_us() / of.plain.median_us();
    output_.row(row);
  }
}

void Round::measurePeer(const PeerKind& kind) const {
  say(std::string("building ") + kind.name + " of " + number(plain_->primitives));
  const std::int64_t start_ns = monotonicNow_ns();
  const std::unique_ptr<Peer> peer = kind.make(mesh_);
  const double build_ns = static_cast<double>(monotonicNow_ns() - start_ns) / static_cast<double>(primitives());
  for (const Case& of : cases_) {
    say(std::string(kind.name) + ", " + nameOf(of.motion) + " on " + number(plain_->primitives));
    for (const Question question : peer->questions()) measureAnswers(of, kind.name, *peer, question, build_ns);
  }
}

void Round::measureAnswers(const Case& of, const std::string& who, Peer& peer, Question question,
                           double build_ns) const {
  const Answers answers = timeAnswers(peer, question, of.probes, kPeerRow_s);
  Row row = rowOf(of, who, nameOf(question));
  row.times = answers.times.middle();
  row.single = answers.times.all();
  row.cost.build_ns = build_ns;
  row.to_tick = row.times.median_us() / of.plain.median_us();
  if (const Answers* own = of.ownTo(question)) {
    row.to_query = row.times.median_us() / own->times.middle().median_us();
    row.agreement = compare(own->metres, answers.metres);
  }
  if (answers.metres.size() < of.probes.size()) {
    row.note = "only the first of " + std::to_string(of.probes.size()) + " places: they took " +
               std::to_string(static_cast<int>(kPeerRow_s)) + " s";
  }
  output_.row(row);
}

}  // namespace hl::bench
