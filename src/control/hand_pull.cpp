#include "control/hand_pull.h"

#include <algorithm>

namespace hl {

namespace {

void addSpring(Effects& effects, const HandPull& pull) {
  const double sum_N_m = effects.spring_N_m + pull.spring_N_m;
  if (sum_N_m <= 0) return;
  effects.spring_D = (effects.spring_N_m * effects.spring_D + pull.spring_N_m * pull.place_D) / sum_N_m;
  effects.spring_N_m = sum_N_m;
  effects.free_damping_Ns_m = std::max(effects.free_damping_Ns_m, pull.damping_Ns_m);
}

}  // namespace

Effects withPull(const Effects& own, const HandPull& pull, std::int64_t now_ns) {
  Effects effects = own;
  if (now_ns < pull.force_until_ns) effects.constant_N += pull.force_N;
  if (now_ns < pull.spring_until_ns) addSpring(effects, pull);
  return effects;
}

}  // namespace hl
