#include "proxy/account.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

void bookCauses(Ledger& ledger, const Account::Causes& causes, double moved_J, double stiffened_J) {
  if (moved_J > 0) {
    const double bends = causes.shading_rad + causes.bump_rad;
    const double bump = bends > 0 ? causes.bump_rad / bends : 0;
    ledger.add(EnergyCause::kShading, (1 - bump) * moved_J);
    ledger.add(EnergyCause::kTexture, bump * moved_J);
  }
  if (stiffened_J > 0)
    ledger.add(causes.stiffness_textured ? EnergyCause::kTexture : EnergyCause::kStiffness, stiffened_J);
}

}  // namespace

Account::Account(const ProxyState& state, const ProxySettings& settings, const Vec3& finger)
    : settings_(settings),
      finger_(finger),
      was_touching_(state.touching),
      stiffness_before_(state.stiffness),
      distance_before_squared_((state.position - finger).squaredNorm()),
      budget_J_(state.ledger.budget_J(settings.ledger)) {}

double Account::energy_J(double stiffness, double distance_squared) const {
  const double scale = settings_.world_per_device;
  return 0.5 * settings_.spring_N_m * stiffness * distance_squared / (scale * scale);
}

double Account::affordable(const Vec3& proxy, const Vec3& step) const {
  const double joule_per_square = energy_J(was_touching_ ? stiffness_before_ : 1, 1);
  if (!(joule_per_square > 0) || !std::isfinite(budget_J_)) return 1;
  const double limit = distance_before_squared_ + budget_J_ / joule_per_square;
  const Vec3 e = proxy - finger_;
  const double a = step.squaredNorm();
  const double b = step.dot(e);
  const double c = e.squaredNorm() - limit;
  if (a + 2 * b + c <= 0) return 1;
  if (!(a > 0)) return 0;
  return std::clamp((std::sqrt(std::max(0.0, b * b - a * c)) - b) / a, 0.0, 1.0);
}

// Each surface in contact gives its own part of the force, softened by its own s: sum s_i lambda_i n_i. What friction
// holds is shared in the ratio of the normal forces. With one s for all this is the paper's equation (4),
// s (proxy - finger); a soft floor does not soften a hard wall beside it, and a contact fades in with lambda.
Vec3 Account::softPull(const ProxyState& state, const TickReport& report) const {
  const Vec3 whole = state.position - finger_;
  Vec3 normal_part = Vec3::Zero(), soft_part = Vec3::Zero();
  double sum = 0, soft_sum = 0, least = 1;
  for (const ProxyContact& contact : report.contacts) {
    const double multiplier = std::max(0.0, contact.multiplier_m);
    normal_part += multiplier * contact.normal;
    soft_part += contact.stiffness * multiplier * contact.normal;
    sum += multiplier;
    soft_sum += contact.stiffness * multiplier;
    least = std::min(least, contact.stiffness);
  }
  if (report.contacts.empty() || least == 1) return whole;
  const bool uniform = std::all_of(report.contacts.begin(), report.contacts.end(),
                                   [&](const ProxyContact& c) { return c.stiffness == least; });
  if (uniform || !(sum > 0)) return least * whole;
  return soft_part + (soft_sum / sum) * (whole - normal_part);
}

void Account::close(ProxyState& state, const Causes& causes, TickReport& report) const {
  const Vec3 whole = state.position - finger_;
  const double distance_squared = whole.squaredNorm();
  const bool touching = !report.contacts.empty();
  Vec3 pull = softPull(state, report);
  double stiffness = distance_squared > 0 ? pull.dot(whole) / distance_squared : 1;
  const double before = was_touching_ ? stiffness_before_ : stiffness;
  const double start_J = energy_J(before, distance_before_squared_);
  const double wanted_J = energy_J(stiffness, distance_squared);
  if (wanted_J > start_J + budget_J_) {
    const double part = (start_J + budget_J_) / wanted_J;
    pull *= part;
    stiffness *= part;
  }
  report.target = pull == whole ? state.position : Vec3(finger_ + pull);
  const double moved_J = energy_J(before, distance_squared);
  const double end_J = energy_J(stiffness, distance_squared);
  report.injected_J = end_J - start_J;
  bookCauses(state.ledger, causes, moved_J - start_J, end_J - moved_J);
  state.ledger.book(report.injected_J, was_touching_ && touching);
  state.touching = touching;
  if (!touching) state.rest_s = kStuck_s;
  state.stiffness = touching ? stiffness : 1;
}

}  // namespace hl
