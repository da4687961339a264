#include "proxy/tick.h"

#include <algorithm>
#include <optional>

#include "proxy/curvature_step.h"
#include "proxy/spring_energy.h"
#include "proxy/yielding.h"

namespace hl {

namespace {

// Work limit of this tick, in bounding volumes.
std::size_t mostWork(const ProxySettings& settings, const ProxyState& state) {
  return static_cast<std::size_t>(settings.work_cap) << (state.out_of_work / convergence::kTicksPerDoubling);
}

// Consecutive ticks that ran out of work.
int outOfWork(const ProxyState& state, Ending ending) {
  return ending == Ending::kOutOfWork ? std::min(state.out_of_work + 1, convergence::kMostOutOfWork) : 0;
}

}  // namespace

Tick::Tick(const SceneAt& scene, const ProxySettings& settings, ProxyState& state, const Vec3& finger, int most_looks,
           const AdhesionLoads* loads)
    : input_(scene, settings, finger),
      state_(state),
      goal_(finger),
      booking_(state, settings, finger),
      rules_(scene, settings, input_.tolerance,
             {state.touching && !state.sticking.isStuck(), state.sticking.springs, feltSpring_N_m(settings, state),
              loads}),
      constraints_(input_),
      walk_(input_, state.cache),
      work_(input_.scene, mostWork(settings, state), most_looks) {}

TickReport Tick::run() {
  TickReport report;
  while (true) {
    look();
    if (!progress_.settledOn(constraints_.set())) propose();
    if (trial_.open()) judgeTrial();
    report.ending = judge(report.iterations);
    if (report.ending != Ending::kGoesOn) break;
    ++report.iterations;
    if (!proposal_.active.empty()) last_active_ = proposal_.active;
    if (tryCurvedStep()) continue;
    advance();
    if (proposal_.rest == Proposal::Rest::kStays) {
      report.ending = Ending::kSettled;
      break;
    }
  }
  if (trial_.conclude(goal_, state_.position)) lookAgain();  // the contacts at the restored position
  close(report);
  report.work = work_.done();
  report.looks = work_.looks();
  report.used_up_at = work_.usedUpAt();
  return report;
}

void Tick::judgeTrial() {
  const bool last = atRest() || work_.usedUp();
  if (trial_.judge(goal_, proposal_.step.norm(), last, state_.position)) return lookAgain();
  if (!trial_.open()) work_.stepped();  // the trial was accepted
}

void Tick::look() {
  constraints_.gather(state_.position, goal_.place() - state_.position, state_.cache.nearby);
  work_.looked(constraints_.set());
}

void Tick::lookAgain() {
  look();
  propose();
}

void Tick::propose() {
  progress_.unsettle();
  // The once-a-tick goal has been reached, or the proxy has left the surface over an edge: move down to the surface,
  // and no farther.
  const bool passes_done = !goal_.isFinger();
  if (passes_done && !constraints_.touches()) aimAt(input_.finger);
  const bool felt = !passes_done && rules_.any(constraints_.set());
  felt ? proposeFelt() : proposePlain();
  if (booking_.spent() && constraints_.touches()) proposal_.step = Vec3::Zero();
}

void Tick::proposePlain() {
  const Vec3 gap = input_.far.shortened(goal_.place() - state_.position);
  constraints_.nearestTo(gap, proposal_);
  if (!trial_.open() && goal_.isFinger()) {
    constraints_.addCuts(state_.position, gap, walk_.slid_m(), proposal_);
  } else {
    constraints_.leaveCutsOut();
  }
}

void Tick::proposeFelt() {
  rules_.propose(constraints_.set(), state_.position, input_.gap(state_.position), proposal_);
  const bool resisted = proposal_.resistance != Proposal::Resistance::kNone;
  if (!proposal_.may_raise_energy && !resisted) return proposePlain();  // only the true planes act here
  if (proposal_.may_raise_energy && input_.settings.shading == ShadingPasses::kOnce)
    aimAt(state_.position + proposal_.step);
}

void Tick::aimAt(const Vec3& place) {
  goal_.aimAt(place);
  progress_.begin();
}

Ending Tick::judge(int iterations) const {
  if (progress_.settledOn(constraints_.set())) return Ending::kSettled;
  // A step between tilted planes may end a little above them: there nothing holds the proxy, so it goes down again.
  const bool may_stall = constraints_.touches() || constraints_.set().crowd;
  if (progress_.stalled() && may_stall) return constraints_.set().crowd ? Ending::kCrowded : Ending::kStalled;
  if (!trial_.open() && atRest()) return endingOfRest();
  if (!trial_.open() && work_.ends()) return Ending::kOutOfWork;
  return iterations >= input_.settings.iteration_cap ? Ending::kCapped : Ending::kGoesOn;
}

// Why the proxy is at rest.
Ending Tick::endingOfRest() const {
  if (!constraints_.touches()) return Ending::kReached;
  if (booking_.spent()) return Ending::kNoEnergy;
  return proposal_.rule == Proposal::Rule::kFelt && rules_.postpones() ? Ending::kPostponed : Ending::kStationary;
}

// On a rounded edge or corner, steps by tangent planes alone converge slowly. Newton's step uses the curvature.
bool Tick::tryCurvedStep() {
  const SolverResult& plain = constraints_.solved();
  if (proposal_.rule != Proposal::Rule::kPlain || plain.active_count == 0 || work_.usedUp() || trial_.open())
    return false;
  const ContactSet& set = constraints_.set();
  const double plain_m = plain.point.norm();
  const std::optional<Vec3> step = curvatureStep(set, input_.scene, plain, input_.tolerance, trial_.boldness());
  if (!step || !trial_.mayBegin(step->norm() / plain_m)) return false;
  Vec3 there = state_.position;
  // A step that is stopped by an impact counts only if it went farther than the plain step would.
  const Walk::Made made = walk_.go(set, Walk::Along::kSurface, *step, there);
  if (made == Walk::Made::kPart && (there - state_.position).norm() <= plain_m) return false;
  trial_.begin(state_.position);
  state_.position = there;
  return true;
}

// Makes one step, shortened by impacts and by the energy budget.
void Tick::advance() {
  const ContactSet& set = constraints_.set();
  const Vec3 from = state_.position;
  const bool follows = constraints_.touches() || proposal_.rule == Proposal::Rule::kCuts;
  const Walk::Along along = follows ? Walk::Along::kSurface : Walk::Along::kAir;
  const bool is_free = proposal_.descends() && goal_.isFinger();
  const Vec3 step = is_free ? proposal_.step : booking_.afford(from, proposal_.step, rules_.released_J(proposal_));
  bool whole = false;
  if (follows || !goal_.isFinger()) {
    whole = walk_.go(set, along, step, state_.position) == Walk::Made::kWhole;
  } else {
    walk_.fly(set, state_.position);
  }
  trial_.open() ? trial_.descended() : work_.stepped();
  if (progress_.idleAt(state_.position, goal_) && !trial_.open() && ledByRounding(from)) progress_.stall();
  if (heldByCrowd(from)) progress_.stall();
  if (proposal_.rule == Proposal::Rule::kFelt)
    rules_.moved(proposal_, state_.position - from);
  else
    rules_.movedPlainly(set);
  settle(whole && !booking_.spent(), state_.position - from);
}

// Whether the step is as short as steps between planes that are tilted by rounding within the skin (Tolerances::lean).
bool Tick::ledByRounding(const Vec3& from) const {
  return proposal_.step.norm() <= input_.tolerance.lean() * input_.gap(from).norm();
}

// Whether contacts that did not fit into the set (a crowd) stop the proxy.
bool Tick::heldByCrowd(const Vec3& from) const {
  return constraints_.set().crowd && !trial_.open() && (state_.position - from).norm() <= input_.tolerance.skin;
}

// Updates proposal_.rest after a step. `whole`: the step was made in full; otherwise the passes have not ended.
void Tick::settle(bool whole, const Vec3& step) {
  if (!whole) proposal_.rest = Proposal::Rest::kGoesOn;
  if (proposal_.rest == Proposal::Rest::kSettles) progress_.settleOn(constraints_.set());
  if (proposal_.rest == Proposal::Rest::kStays) constraints_.moveBy(step);
}

void Tick::close(TickReport& report) {
  const bool once = !goal_.isFinger();
  const bool at_finger = input_.stationary(input_.finger - state_.position, state_.position);
  const Vec3 gap = input_.gap(state_.position);
  // After passes that run once a tick: find the contacts that hold the proxy at its final position.
  if (once && constraints_.touches()) rules_.settle(constraints_.set(), state_.position, gap, proposal_);
  // No plane with a shading normal holds the proxy here: use the true planes.
  if (proposal_.active.empty() && !at_finger) constraints_.nearestTo(gap, proposal_);
  const TickEnd end = !proposal_.active.empty() ? TickEnd::kContact : at_finger ? TickEnd::kOpen : TickEnd::kOnItsWay;
  MeanStiffness surfaces;
  EnergyBooking::Causes causes{proposal_.shading, proposal_.bump, false};
  for (const ActiveContact& active : proposal_.active) {
    ProxyContact contact = rules_.describe(constraints_.set(), active);
    contact.multiplier_m /= input_.far.part(input_.finger - state_.position);
    report.contacts.push(contact);
    surfaces.add(contact.multiplier_m, contact.stiffness);
    causes.stiffness_textured |= rules_.stiffnessTextured(active.place.primitive);
  }
  report.yields = anyYields(input_.scene, input_.settings, state_.estimate, report.contacts);
  if (report.yields)
    surfaces = yieldingStiffness(input_.scene, input_.settings, state_.estimate, report.contacts,
                                 state_.position - input_.finger);
  if (end == TickEnd::kOnItsWay) {
    for (const ActiveContact& active : last_active_)
      surfaces.add(active.multiplier_m, rules_.stiffnessAt(active.place));
  }
  state_.out_of_work = outOfWork(state_, report.ending);
  state_.sticking.springs = rules_.springs();
  state_.sticking.goOn(rules_.hasSlipped(), input_.settings.period_s);
  booking_.close(state_, end, surfaces, causes, report);
}

}  // namespace hl
