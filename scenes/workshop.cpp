#include "workshop.h"

#include <string>
#include <utility>

#include "solids.h"

namespace hl {

namespace {

constexpr double kWood_kg_m3 = 700, kPlastic_kg_m3 = 1500, kSteel_kg_m3 = 7800;
constexpr std::size_t kSides = 32;

BodySpec bodySpec(double density_kg_m3, double friction, BodyShape shape = BodyShape::kHull) {
  BodySpec spec;
  spec.density_kg_m3 = density_kg_m3;
  spec.surface = {friction, friction, 0};
  spec.shape = shape;
  return spec;
}

/// The scene while it is put together.
class Workshop {
 public:
  SceneModel make() {
    table();
    door(Vec3(-0.1, 0, -0.06));
    drawer(Vec3(0.095, 0, -0.06));
    dominoes(Vec3(-0.13, 0, 0.075));
    pile(Vec3(-0.02, 0, -0.06));
    button("button 1", Vec3(0.02, 0, 0.03));
    button("button 2", Vec3(0.05, 0, 0.03));
    rocker(Vec3(0.09, 0, 0.03));
    seesaw(Vec3(-0.09, 0, 0.02));
    top(Vec3(-0.02, 0, 0));
    bowl(Vec3(0.03, 0, 0.075));
    soft(Vec3(0.11, 0, 0.075));
    ring(Vec3(0.035, 0, -0.03));
    return std::move(scene_);
  }

 private:
  void stand(Model model, const Vec3& at) { appendSolid(scene_.model, std::move(model), at); }
  // Its number among the bodies, from 1.
  std::uint64_t body(std::string name, Model model, const Vec3& at, const BodySpec& spec) {
    model.materials.front().smooth = true;
    scene_.bodies.push_back({std::move(name), std::move(model), {Mat3::Identity(), at}, spec});
    return scene_.bodies.size();
  }
  JointForces& joint(std::string name, JointKind kind, std::uint64_t body, const Vec3& anchor, const Vec3& axis) {
    JointSpec spec;
    spec.name = std::move(name);
    spec.kind = kind;
    spec.body_a = body;
    spec.anchor_W = anchor;
    spec.axis_W = axis;
    scene_.mechanics.joints.push_back(std::move(spec));
    return scene_.mechanics.joints.back().along;
  }

  void table() {
    scene_.model.name = "workshop";
    scene_.model.materials.front().smooth = true;
    stand(boxSolid(Vec3(0.15, 0.005, 0.1)), Vec3(0, -0.005, 0));
  }

  // Two posts, and a door between them that a latch keeps closed.
  void door(const Vec3& at) {
    for (const double side : {-1.0, 1.0}) stand(boxSolid(Vec3(0.003, 0.033, 0.003)), at + Vec3(side * 0.028, 0.033, 0));
    Model panel = boxSolid(Vec3(0.0235, 0.03, 0.002));
    appendSolid(panel, ballSolid(0.004, 16), Vec3(0.018, 0, 0.005));
    const std::uint64_t number = body("door", std::move(panel), at + Vec3(0, 0.032, 0), bodySpec(kWood_kg_m3, 0.3));
    JointForces& hinge = joint("door hinge", JointKind::kHinge, number, at + Vec3(-0.0235, 0.032, 0), Vec3::UnitY());
    hinge.low = -1.9;
    hinge.high = 1.9;
    hinge.friction = 0.002;
    hinge.damping = 1e-4;
    hinge.table = {{-0.1, -0.05, 0.05, 0.1}, {0, 0.03, -0.03, 0}};
  }

  // A case that is open in front, and a tray that slides out of it.
  void drawer(const Vec3& at) {
    for (const double side : {-1.0, 1.0}) stand(boxSolid(Vec3(0.002, 0.014, 0.022)), at + Vec3(side * 0.026, 0.014, 0));
    stand(boxSolid(Vec3(0.028, 0.002, 0.022)), at + Vec3(0, 0.03, 0));
    stand(boxSolid(Vec3(0.024, 0.014, 0.001)), at + Vec3(0, 0.014, -0.021));
    Model tray = boxSolid(Vec3(0.022, 0.001, 0.019));
    for (const double side : {-1.0, 1.0})
      appendSolid(tray, boxSolid(Vec3(0.001, 0.009, 0.019)), Vec3(side * 0.021, 0.01, 0));
    appendSolid(tray, boxSolid(Vec3(0.02, 0.009, 0.001)), Vec3(0, 0.01, -0.018));
    appendSolid(tray, boxSolid(Vec3(0.022, 0.01, 0.001)), Vec3(0, 0.009, 0.02));
    appendSolid(tray, ballSolid(0.004, 16), Vec3(0, 0.009, 0.024));
    BodySpec spec = bodySpec(kWood_kg_m3, 0.3, BodyShape::kParts);
    spec.mass_kg = 0.02;
    const std::uint64_t number = body("drawer", std::move(tray), at + Vec3(0, 0.004, 0.002), spec);
    JointForces& slide = joint("drawer slide", JointKind::kSlider, number, at, Vec3::UnitZ());
    slide.low = 0;
    slide.high = 0.034;
    slide.friction = 0.15;
  }

  void dominoes(const Vec3& at) {
    const Vec3 half(0.002, 0.014, 0.007);
    for (int i = 0; i < 9; ++i)
      body("domino " + std::to_string(i + 1), boxSolid(half), at + Vec3(0.013 * i, half.y(), 0),
           bodySpec(kPlastic_kg_m3, 0.4, BodyShape::kBox));
  }

  // Three blocks, two on them, and one on top.
  void pile(const Vec3& at) {
    constexpr double kHalf_m = 0.009, kApart_m = 0.0195;
    int number = 0;
    for (int row = 0; row < 3; ++row) {
      for (int i = 0; i < 3 - row; ++i)
        body("block " + std::to_string(++number), boxSolid(Vec3::Constant(kHalf_m)),
             at + Vec3(kApart_m * (i - 0.5 * (2 - row)), kHalf_m * (2 * row + 1), 0),
             bodySpec(kWood_kg_m3, 0.5, BodyShape::kBox));
    }
  }

  // The cap gives way with a click: beyond 1.8 mm it pushes back less than before.
  void button(const std::string& name, const Vec3& at) {
    for (const double side : {-1.0, 1.0}) {
      stand(boxSolid(Vec3(0.001, 0.003, 0.01)), at + Vec3(side * 0.009, 0.003, 0));
      stand(boxSolid(Vec3(0.008, 0.003, 0.001)), at + Vec3(0, 0.003, side * 0.009));
    }
    BodySpec spec = bodySpec(kPlastic_kg_m3, 0.2, BodyShape::kCylinder);
    spec.mass_kg = 0.003;
    const std::uint64_t number = body(name, cylinderSolid(0.007, 0.003, kSides), at + Vec3(0, 0.0075, 0), spec);
    JointForces& slide = joint(name + " slide", JointKind::kSlider, number, at, Vec3::UnitY());
    slide.low = -0.004;
    slide.high = 0;
    slide.damping = 0.05;
    slide.table = {{-0.004, -0.0022, -0.0018, 0}, {1.6, 0.5, 1.2, 0.3}};
  }

  // Its spring pushes it away from the middle, to either side.
  void rocker(const Vec3& at) {
    stand(boxSolid(Vec3(0.003, 0.003, 0.006)), at + Vec3(0, 0.003, 0));
    BodySpec spec = bodySpec(kPlastic_kg_m3, 0.3, BodyShape::kBox);
    spec.mass_kg = 0.004;
    const std::uint64_t number = body("rocker", boxSolid(Vec3(0.015, 0.002, 0.006)), at + Vec3(0, 0.009, 0), spec);
    JointForces& hinge = joint("rocker hinge", JointKind::kHinge, number, at + Vec3(0, 0.009, 0), Vec3::UnitZ());
    hinge.low = -0.3;
    hinge.high = 0.3;
    hinge.damping = 2e-5;
    hinge.table = {{-0.3, -0.05, 0.05, 0.3}, {-0.004, -0.008, 0.008, 0.004}};
  }

  void seesaw(const Vec3& at) {
    stand(boxSolid(Vec3(0.002, 0.005, 0.008)), at + Vec3(0, 0.005, 0));
    const std::uint64_t number =
        body("seesaw", boxSolid(Vec3(0.035, 0.0015, 0.009)), at + Vec3(0, 0.0125, 0), bodySpec(kWood_kg_m3, 0.5));
    JointForces& hinge = joint("seesaw hinge", JointKind::kHinge, number, at + Vec3(0, 0.0125, 0), Vec3::UnitZ());
    hinge.low = -0.28;
    hinge.high = 0.28;
    hinge.friction = 2e-4;
    body("weight", boxSolid(Vec3::Constant(0.006)), at + Vec3(-0.027, 0.02, 0), bodySpec(2 * kWood_kg_m3, 0.6));
  }

  void top(const Vec3& at) {
    Model model =
        turnedSolid({{0, 0}, {0.016, 0.007}, {0.016, 0.01}, {0.002, 0.013}, {0.002, 0.024}, {0, 0.024}}, kSides, false);
    BodySpec spec = bodySpec(kPlastic_kg_m3, 0.05);
    spec.spin_rad_s = Vec3(0, 150, 0);
    body("top", std::move(model), at + Vec3(0, 1e-5, 0), spec);
  }

  void bowl(const Vec3& at) {
    stand(turnedSolid({{0, 0},
                       {0.012, 0},
                       {0.022, 0.006},
                       {0.027, 0.016},
                       {0.025, 0.016},
                       {0.02, 0.008},
                       {0.011, 0.003},
                       {0, 0.002}},
                      kSides, true),
          at);
    // At the bottom: nothing stops a ball that rolls to and fro.
    body("ball", ballSolid(0.006, kSides), at + Vec3(0, 0.00801, 0), bodySpec(kSteel_kg_m3, 0.3, BodyShape::kBall));
  }

  // It stays where it is, and gives way under the finger.
  void soft(const Vec3& at) {
    BodySpec spec = bodySpec(kWood_kg_m3, 0.6, BodyShape::kBox);
    spec.fixed = true;
    body("soft block", boxSolid(Vec3(0.02, 0.012, 0.015)), at + Vec3(0, 0.012, 0), spec);
    scene_.bodies.back().model.materials.front().stiffness = 0.15;
  }

  // It lies around a peg, which keeps it there, and can be lifted off.
  void ring(const Vec3& at) {
    constexpr double kHalfHeight = 0.004;
    stand(cylinderSolid(0.004, 0.012, kSides), at + Vec3(0, 0.012, 0));
    body("ring", ringSolid(0.009, 0.015, kHalfHeight, 16), at + Vec3(0.002, kHalfHeight, 0),
         bodySpec(kWood_kg_m3, 0.3, BodyShape::kParts));
  }

  SceneModel scene_;
};

}  // namespace

SceneModel makeWorkshop() { return Workshop().make(); }

}  // namespace hl
