#include "proxy/constraints.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace hl {

namespace {

std::span<const Plane> planesOf(const ContactSet& set) { return {set.planes.begin(), set.planes.size()}; }

}  // namespace

void Constraints::gather(const Vec3& position, const Vec3& toward, SweepCache& cache) {
  gatherContacts(input_.scene, position, toward, input_.tolerance.touching, input_.tolerance.reach, cache, set_,
                 input_.settings.surfaces);
}

// Whether the subproblem is infeasible, or its step leads away from the goal by much more than the proxy is below the
// planes. The second happens where planes almost face each other: rounding decides where they intersect.
bool Constraints::strays(const Vec3& gap) const {
  if (solved_.violation > input_.tolerance.feasible) return true;
  if (set_.planes.size() < 2) return false;
  double depth = input_.tolerance.skin;
  for (const Plane& plane : set_.planes) depth = std::max(depth, plane.offset);
  return (gap - solved_.point).norm() > gap.norm() + accuracy::kMaxStrayPerDepth * depth;
}

void Constraints::nearestTo(const Vec3& gap, Proposal& proposal) {
  solved_ = nearestAbove(planesOf(set_), gap, input_.tolerance.feasible);
  if (strays(gap)) {
    relaxToCentre(set_);
    solved_ = nearestAbove(planesOf(set_), gap, input_.tolerance.feasible);
    // The planes enclose the proxy more tightly than rounding can resolve: make no step.
    if (strays(gap)) solved_.point = Vec3::Zero();
  }
  proposal = {};
  proposal.step = solved_.point;
  cuts_.update(set_);
  for (std::size_t i = 0; i < solved_.active_count; ++i) {
    const Contact& contact = set_.contacts[solved_.active[i]];
    proposal.active.push({solved_.active[i], placeOf(contact), contact.plane.normal, solved_.multiplier[i]});
    cuts_.addActive(contact.primitive);
  }
}

void Constraints::addCuts(const Vec3& position, const Vec3& gap, double slid_m, Proposal& proposal) {
  std::optional<Vec3> step;
  if (!cuts_.empty() && cuts_in_a_row_ < convergence::kMaxCutsInARow) step = stepAboveCuts(position, gap, slid_m);
  cuts_in_a_row_ = step ? cuts_in_a_row_ + 1 : 0;
  if (!step) return;
  proposal.rule = Proposal::Rule::kCuts;
  proposal.step = *step;
}

// Nothing if no cut is active; if the step is so short that the proxy should come down to the surface; and,
// without contacts, if the step is much longer than the way slid since the last contact, as it would usually end at
// once at a new primitive.
std::optional<Vec3> Constraints::stepAboveCuts(const Vec3& position, const Vec3& gap, double slid_m) {
  RecentCuts::Planes planes;
  for (const Plane& plane : set_.planes) {
    if (!planes.push(plane)) return std::nullopt;
  }
  const std::size_t own = planes.size();
  if (cuts_.addPlanes(input_.scene, position, input_.tolerance.reach, planes) == 0) return std::nullopt;
  const SolverResult all = nearestAbove({planes.begin(), planes.size()}, gap, input_.tolerance.feasible);
  const auto* const active_end = all.active.begin() + static_cast<std::ptrdiff_t>(all.active_count);
  const bool counts = std::any_of(all.active.begin(), active_end, [&](std::size_t i) { return i >= own; });
  const double length = all.point.norm();
  if (!counts || all.violation > input_.tolerance.feasible || length <= convergence::kMinCutPerGap * gap.norm())
    return std::nullopt;
  if (!touches() && length >= convergence::kMaxCutPerSlid * slid_m) return std::nullopt;
  cuts_.keepActive();
  return all.point;
}

}  // namespace hl
