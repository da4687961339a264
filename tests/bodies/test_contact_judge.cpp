// R30: the impulses of a step against the conditions of Signorini and Coulomb, and against a judge that is simple and
// slow: every contact by itself, with a small step, in long double. Random piles, some pushed by a hand.
#include <gtest/gtest.h>

#include <random>

#include "bodies/test_worlds.h"

namespace hl::test_contact_judge {
namespace {

using Real = long double;
using Vec3L = Eigen::Matrix<Real, 3, 1>;
using Mat3L = Eigen::Matrix<Real, 3, 3>;

// Something with a velocity, as the step begins to solve: a body after gravity, or a hand.
struct Mover {
  Vec3L velocity = Vec3L::Zero(), spin = Vec3L::Zero();
  Real inverse_mass = 0;
  Mat3L inverse_inertia = Mat3L::Zero();

  void push(const Vec3L& impulse, const Vec3L& arm) {
    velocity += inverse_mass * impulse;
    spin += inverse_inertia * arm.cross(impulse);
  }
  Vec3L at(const Vec3L& arm) const { return velocity + spin.cross(arm); }
};

struct Touch {
  int a = 0, b = Row::kFixed;
  Vec3L normal, arm_a, arm_b;
  Real friction = 0, least = 0;  // of the velocity along the normal
  Vec3L impulse = Vec3L::Zero();
};

// The problem that a step has solved, with its impulses.
struct Contacts {
  std::vector<Mover> movers;
  std::vector<Touch> touches;

  Mat3L mobilityOf(int number, const Vec3L& arm) const {
    if (number == Row::kFixed) return Mat3L::Zero();
    const Mover& mover = movers[static_cast<std::size_t>(number)];
    Mat3L cross;
    cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    return mover.inverse_mass * Mat3L::Identity() + cross * mover.inverse_inertia * cross.transpose();
  }
  Vec3L velocity(const Touch& touch) const {
    Vec3L velocity = movers[static_cast<std::size_t>(touch.a)].at(touch.arm_a);
    if (touch.b != Row::kFixed) velocity -= movers[static_cast<std::size_t>(touch.b)].at(touch.arm_b);
    return velocity;
  }
  void apply(const Touch& touch, const Vec3L& impulse) {
    movers[static_cast<std::size_t>(touch.a)].push(impulse, touch.arm_a);
    if (touch.b != Row::kFixed) movers[static_cast<std::size_t>(touch.b)].push(-impulse, touch.arm_b);
  }
  // m/s per N s: the velocity at the touch for an impulse there.
  Mat3L mobility(const Touch& touch) const {
    return mobilityOf(touch.a, touch.arm_a) + mobilityOf(touch.b, touch.arm_b);
  }
  Real largest() const {
    Real most = 0;
    for (const Touch& touch : touches) most = std::max(most, touch.impulse.norm());
    return most;
  }
};

Vec3L across(const Vec3L& v, const Vec3L& normal) { return v - normal.dot(v) * normal; }

// The impulse that the conditions ask for where the other impulses are as they are: along the normal projected onto
// what presses, across it onto the disc of what then presses. Unchanged: the conditions hold.
Vec3L wanted(const Contacts& contacts, const Touch& touch) {
  const Mat3L mobility = contacts.mobility(touch);
  const Vec3L velocity = contacts.velocity(touch);
  const Real along = touch.normal.dot(mobility * touch.normal);
  const Real pressed =
      std::max(Real(0), touch.normal.dot(touch.impulse) - (touch.normal.dot(velocity) - touch.least) / along);
  Vec3L dragged = across(touch.impulse, touch.normal) - across(velocity, touch.normal) / (mobility.trace() - along);
  const Real most = touch.friction * pressed;
  if (dragged.norm() > most) dragged *= most / dragged.norm();
  return pressed * touch.normal + dragged;
}

// The natural map: the largest change of an impulse that the conditions ask for, over the largest impulse.
Real residual(const Contacts& contacts) {
  Real most = 0;
  for (const Touch& touch : contacts.touches) most = std::max(most, (wanted(contacts, touch) - touch.impulse).norm());
  return contacts.largest() > 0 ? most / contacts.largest() : most;
}

// The judge. False: it does not come to an end.
bool settle(Contacts& contacts) {
  for (Touch& touch : contacts.touches) {
    contacts.apply(touch, -touch.impulse);
    touch.impulse.setZero();
  }
  for (int sweep = 0; sweep < 10'000; ++sweep) {
    for (Touch& touch : contacts.touches) {
      const Vec3L impulse = wanted(contacts, touch);
      contacts.apply(touch, impulse - touch.impulse);
      touch.impulse = impulse;
    }
    if (sweep % 100 == 0 && residual(contacts) < 1e-12L) return true;
  }
  return false;
}

double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Blocks on a slope, one on the other, that move; and a hand that presses on the topmost.
class Pile {
 public:
  Pile(std::mt19937_64& random, double most_friction)
      : most_friction_(most_friction), slope_(between(random, 0, 0.5)), ground_(worldOf(random), poses_) {
    for (BodyState& body : ground_.state.bodies) {
      const double fast = between(random, 0, 1) < 0.5 ? 0 : 0.1;
      for (int i = 0; i < 3; ++i) body.velocity[i] = between(random, -fast, fast);
      for (int i = 0; i < 3; ++i) body.spin[i] = between(random, -10 * fast, 10 * fast);
    }
    if (between(random, 0, 1) < 0.5) press(random);
  }

  // A step, and the problem that it has solved.
  Contacts step() {
    Contacts contacts;
    for (std::size_t i = 0; i < ground_.state.bodies.size(); ++i) addBody(contacts, i);
    for (const HandNode& hand : hands_) {
      Mover& mover = contacts.movers.emplace_back();
      mover.velocity = (-hand.stretch / test::kStep_s).cast<Real>();
      mover.inverse_mass = 1 / Real(hand.spring_N_m * test::kStep_s * test::kStep_s);
    }
    converged_ = ground_.step(hands_).converged;
    for (const Row& row : ground_.stepper.rows()) addRow(contacts, row);
    return contacts;
  }
  bool converged() const { return converged_; }
  bool pressed() const { return !hands_.empty(); }

 private:
  World worldOf(std::mt19937_64& random) {
    World world;
    world.fixed = test::floorScene(1, slope_);
    const Mat3 turn = Eigen::AngleAxisd(slope_, Vec3::UnitZ()).toRotationMatrix();
    const int blocks = std::uniform_int_distribution<int>(1, 4)(random);
    double height = 0, aside = 0;
    for (int i = 0; i < blocks; ++i) {
      const Vec3 half(between(random, 0.01, 0.03), between(random, 0.005, 0.02), between(random, 0.01, 0.03));
      if (i > 0) aside += between(random, -0.008, 0.008);
      const Mat3 yaw = Eigen::AngleAxisd(between(random, -1, 1), Vec3::UnitY()).toRotationMatrix();
      poses_.push_back({turn * yaw, turn * Vec3(aside, height + half.y(), aside)});
      height += 2 * half.y();
      const double mass_kg = std::pow(10, between(random, -2, 0));
      world.bodies.push_back(test::block(static_cast<std::uint64_t>(i) + 1, mass_kg, half,
                                         between(random, most_friction_ / 3, most_friction_)));
    }
    top_ = turn * Vec3(aside, height, aside);
    up_ = turn.col(1);
    return world;
  }
  void press(std::mt19937_64& random) {
    HandNode& hand = hands_.emplace_back();
    hand.proxy = top_ + Vec3(between(random, -0.005, 0.005), 0, between(random, -0.005, 0.005));
    hand.stretch =
        between(random, 0, 0.002) * up_ + Vec3(between(random, -0.001, 0.001), 0, between(random, -0.001, 0.001));
    hand.contacts.push({ground_.world->bodies.back().key, hand.proxy, up_, most_friction_, most_friction_, false});
  }
  void addBody(Contacts& contacts, std::size_t i) const {
    const BodyState& body = ground_.state.bodies[i];
    Mover& mover = contacts.movers.emplace_back();
    mover.velocity = (body.velocity + test::kStep_s * ground_.world->gravity_m_s2).cast<Real>();
    mover.spin = body.spin.cast<Real>();
    mover.inverse_mass = 1 / Real(ground_.world->bodies[i].mass.mass_kg);
    mover.inverse_inertia = inverseInertia(ground_.world->bodies[i], body).cast<Real>();
  }
  static void addRow(Contacts& contacts, const Row& row) {
    Touch touch;
    touch.a = row.a;
    touch.b = row.b;
    touch.normal = row.normal.cast<Real>().normalized();
    touch.arm_a = row.arm_a.cast<Real>();
    touch.arm_b = row.arm_b.cast<Real>();
    touch.friction = row.friction;
    touch.least = -std::max(row.gap, 0.0) / test::kStep_s;
    touch.impulse = impulseOf(row).cast<Real>();
    contacts.apply(touch, touch.impulse);
    contacts.touches.push_back(touch);
  }

  double most_friction_, slope_;
  std::vector<Pose> poses_;
  Vec3 top_ = Vec3::Zero(), up_ = Vec3::UnitY();
  test::Playground ground_;
  std::vector<HandNode> hands_;
  bool converged_ = true;
};

Real apart(const Contacts& contacts, const Contacts& other) {
  Real most = 0;
  for (std::size_t i = 0; i < contacts.movers.size(); ++i)
    most = std::max(most, (contacts.movers[i].velocity - other.movers[i].velocity).norm());
  return most;
}

constexpr int kPiles = 100, kSteps = 3;

// Where a solve ends at its limit of work, it says so, and is near; the rest is solved, to some changes of 1e-11.
TEST(ContactJudge, R30AStepMeetsTheConditionsOfCoulombAndSignorini) {
  int touches = 0, pressed = 0, unsolved = 0;
  for (const double friction : {0.0, 0.1, 0.3, 0.9}) {
    std::mt19937_64 random(30);
    for (int run = 0; run < kPiles; ++run) {
      Pile pile(random, friction);
      for (int step = 0; step < kSteps; ++step) {
        const Contacts found = pile.step();
        touches += static_cast<int>(found.touches.size());
        pressed += pile.pressed();
        unsolved += !pile.converged();
        EXPECT_LT(residual(found), pile.converged() ? 1e-9L : 5e-2L) << friction << " " << run << " " << step;
      }
    }
  }
  EXPECT_GT(touches, 10'000);
  EXPECT_GT(pressed, 4 * kPiles);
  EXPECT_LT(unsolved, 4 * kPiles * kSteps / 5);
}

// Without friction there is one solution. With friction there are many: of a block that slides and turns, it is open
// which corners bear it, and so where friction acts.
TEST(ContactJudge, R30WithoutFrictionAStepFindsTheVelocitiesOfTheJudge) {
  std::mt19937_64 random(31);
  int judged = 0;
  for (int run = 0; run < kPiles / 2; ++run) {
    Pile pile(random, 0);
    const Contacts found = pile.step();
    Contacts settled = found;
    if (!pile.converged() || !settle(settled)) continue;
    ++judged;
    EXPECT_LT(apart(found, settled), 1e-8L) << run;
  }
  EXPECT_GT(judged, kPiles / 8);
}

}  // namespace
}  // namespace hl::test_contact_judge
