// Virtual buttons, as in the paper's Figure 11: touching a button chooses a model, and while an arrow is touched the
// chosen model moves, into the others if one likes: nothing needs to know where they cross.
//
//   07_events_buttons [URL [SECONDS]]
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <hl/hl.hpp>
#include <string>
#include <thread>
#include <vector>

namespace {

enum Name : HLuint { kBall = 1, kRing, kCone, kFirstButton = 11, kLeft = 21, kRight = 22 };
constexpr std::array<const char*, 4> kNames{"", "ball", "ring", "cone"};
constexpr HLuint kPlate = 100;          // the object that all buttons are
constexpr double kSpeed_m_s = 0.04;     // of a model while an arrow is touched
constexpr double kButtonHeight = 0.01;  // m
constexpr double kPressedHeight = 0.007;

struct App {
  std::array<double, 4> place{0, -0.04, 0.0, 0.05};  // m along x, by model
  HLuint chosen = kBall;
  double direction = 0;
};

// A model: the curve (radius, height), 0 <= t <= 1, turned about y.
void defineTurned(HLuint object, const std::function<std::array<double, 2>(double)>& curve) {
  const hl::ObjectScope definition(object);
  for (int i = 0; i < 16; ++i) {
    const hl::PrimitiveScope strip(HL_QUAD_STRIP);
    for (int j = 0; j <= 32; ++j) {
      for (const int side : {0, 1}) {
        const auto [radius, height] = curve((i + side) / 16.0);
        const double angle = 2 * M_PI * j / 32;
        hlVertex3d(radius * std::sin(angle), height, radius * std::cos(angle));
      }
    }
  }
}

void defineObjects() {
  defineTurned(kBall, [](double t) { return std::array{0.02 * std::sin(M_PI * t), 0.02 - 0.02 * std::cos(M_PI * t)}; });
  defineTurned(kRing, [](double t) {
    return std::array{0.02 - 0.008 * std::cos(2 * M_PI * t), 0.008 + 0.008 * std::sin(2 * M_PI * t)};
  });
  defineTurned(kCone, [](double t) { return std::array{0.02 * (1 - t), 0.04 * t}; });
  const hl::ObjectScope definition(kPlate);
  const hl::PrimitiveScope quad(HL_QUADS);
  for (const auto& [x, z] : {std::array{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}) hlVertex3d(0.008 * x, 0, 0.008 * z);
}

void drawButton(HLuint name, double x, bool pressed) {
  const hl::MatrixScope matrix;
  const hl::NameScope button(name);
  hlTranslated(x, pressed ? kPressedHeight : kButtonHeight, 0.05);
  hlCallObject(kPlate);
}

// Each model has a surface of its own; the chosen model's button stays pressed.
void draw(const App& app) {
  constexpr std::array<float, 4> kStiffness{0, 0.5F, 1, 1}, kFriction{0, 0, 0.1F, 0.6F};
  for (HLuint model = kBall; model <= kCone; ++model) {
    const hl::MatrixScope matrix;
    const hl::AttribScope surface;
    hlLoadName(model);
    hlTranslated(app.place[model], 0, 0);
    hlMaterialf(HL_STIFFNESS, kStiffness[model]);
    hlMaterialf(HL_STATIC_FRICTION, kFriction[model]);
    hlCallObject(model);
  }
  for (HLuint model = kBall; model <= kCone; ++model)
    drawButton(kFirstButton + model, -0.08 + 0.02 * model, app.chosen == model);
  drawButton(kLeft, 0.03, false);
  drawButton(kRight, 0.06, false);
}

void onTouch(App& app, const HLevent& event) {
  const bool touched = event.kind == HL_EVENT_TOUCH;
  if (touched && event.name <= kCone) std::printf("touching: %s\n", kNames[event.name]);
  if (event.name == kLeft || event.name == kRight) {
    app.direction = !touched ? 0 : event.name == kLeft ? -1 : 1;
    if (!touched) std::printf("moved: %s to %.3f\n", kNames[app.chosen], app.place[app.chosen]);
  }
  const HLuint model = event.name - kFirstButton;
  if (!touched || model < kBall || model > kCone) return;
  app.chosen = model;
  std::printf("chosen: %s\n", kNames[model]);
}

// The edge where two models cross, which neither of them has.
void reportCrossing() {
  const std::vector<HLcontact> contacts = hl::contacts();
  if (contacts.size() < 2) return;
  const HLuint one = contacts[0].name, other = contacts[1].name;
  if (one != other && one <= kCone && other <= kCone) std::printf("between: %s and %s\n", kNames[one], kNames[other]);
}

// Nobody holds the simulated device of inproc:, so the program moves its hand: it chooses the ring, moves it into the
// ball, and feels where they cross.
void moveHand(double t) {
  struct Goal {
    double x, y, z;
  };
  constexpr double kAbove = 0.05;
  constexpr std::array<Goal, 8> kTour{{{-0.04, kAbove, 0.05},
                                       {-0.04, 0, 0.05},
                                       {-0.04, kAbove, 0.05},
                                       {0.03, kAbove, 0.05},
                                       {0.03, 0, 0.05},
                                       {0.03, kAbove, 0.05},
                                       {-0.021, kAbove, 0},
                                       {-0.021, 0, 0}}};
  const Goal& goal = kTour[static_cast<std::size_t>(t) % kTour.size()];
  hlHandGoal3d(goal.x, goal.y, goal.z);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 20;
  hl::Context context(url);
  App app;
  for (const HLenum kind : {HL_EVENT_TOUCH, HL_EVENT_UNTOUCH})
    context.onEvent(kind, [&app](const HLevent& event) { onTouch(app, event); });
  hlWorkspaced(0, 0.08, 0.02, 1);
  defineObjects();
  for (int i = 0; i < 60 * seconds; ++i) {
    if (url.starts_with("inproc:")) moveHand(i / 60.0);
    context.poll();
    if (i % 30 == 0) reportCrossing();
    double& place = app.place[app.chosen];
    place = std::clamp(place + app.direction * kSpeed_m_s / 60, -0.08, 0.08);
    draw(app);
    hlFlush();
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  hl::check();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "07_events_buttons: %s\n", error.what());
  return 2;
}
