#include "touch/bodies_view.h"

namespace hl {

namespace {

bool isMoving(const Body& body, const BodyState& state) {
  constexpr double kSlow_m_s = 1e-3;
  return state.velocity.norm() + state.spin.norm() * body.shape.reach > kSlow_m_s;
}

}  // namespace

// What takes time for each body is looked at seldom.
void BodiesView::follow(const BodyWorld* world) {
  if (world == nullptr) {
    bodies = moving = 0;
    kinetic_J = gravity_J = 0;
    book = {};
    return;
  }
  const WorldState& state = world->state();
  bodies = state.bodies.size();
  book = state.energy;
  dropped += world->report().dropped;
  unconverged += world->report().converged ? 0 : 1;
  returned = world->returned();
  if (state.steps % kSeldom != 0) return;
  kinetic_J = kineticEnergy_J(world->world(), state);
  gravity_J = gravityEnergy_J(world->world(), state);
  moving = 0;
  for (std::size_t i = 0; i < bodies; ++i) moving += isMoving(world->world().bodies[i], state.bodies[i]) ? 1 : 0;
}

}  // namespace hl
