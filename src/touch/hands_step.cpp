#include "touch/hands_step.h"

namespace hl {

void stepHands(const Snapshot& scene, BodyWorld* bodies, BodyLoop& body_loop, std::span<HandInStep> hands) {
  FixedVector<HandAtBodies, kMaxHands> at_bodies;
  const TickRequest* any = nullptr;
  for (const HandInStep& hand : hands) {
    if (hand.loop == nullptr) {
      at_bodies.push({});
      continue;
    }
    any = hand.request;
    hand.loop->begin(scene, any->time_ns, any->finger_D, any->commands, any->spring);
    at_bodies.push(hand.loop->atBodies());
    body_loop.act(hand.loop->takeCommands());
  }
  if (any == nullptr) return;
  body_loop.step(scene, bodies, any->time_ns, any->spring.period_s, {at_bodies.begin(), at_bodies.size()});
  for (std::size_t number = 0; number < hands.size(); ++number) {
    HandInStep& hand = hands[number];
    if (hand.loop != nullptr) hand.out = hand.loop->end(bodies, number, hand.most_looks);
  }
}

}  // namespace hl
