// A path that leads the finger, a socket that keeps it until it is pulled off, and a magnet beside them: snaps and
// fields.
//
//   17_snaps [URL [SECONDS]]
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <hl/hl.hpp>
#include <string>
#include <thread>

namespace {

constexpr HLuint kGuide = 1;
constexpr std::array<const char*, 2> kSnaps{"path", "socket"};
// m, x y z each: on a plate, around a corner.
constexpr std::array<HLdouble, 9> kPath{-0.05, 0, 0.03, 0.02, 0, 0.03, 0.02, 0, -0.03};

void drawPlate() {
  const hl::PrimitiveScope quads(HL_QUADS);
  hlVertex3d(-0.08, 0, 0.06);
  hlVertex3d(0.08, 0, 0.06);
  hlVertex3d(0.08, 0, -0.06);
  hlVertex3d(-0.08, 0, -0.06);
}

void defineGuide() {
  const hl::ObjectScope guide(kGuide);
  drawPlate();
  hl::snapCurve(kPath, 0.004, 3);                             // taken from 4 mm, let go at 3 N
  hlSnapPoint3d(-0.05, 0.03, -0.03, 0.003, 2);                // a socket in the air
  hlFieldPoint3d(HL_FIELD_MAGNET, 0.05, 0.02, 0, 0.02, 0.5);  // 0.5 N at most, within 20 mm
}

// The path to and fro, and then up from the socket, 5 mm beside what it wants.
void moveHand(double t) {
  const double part = 0.5 - 0.5 * std::cos(t);
  if (std::fmod(t, 12) < 6.3)
    hlHandGoal3d(-0.05 + 0.07 * part, 0.001, 0.032);
  else
    hlHandGoal3d(-0.05, 0.03 + 0.02 * part, -0.031);
}

void print(double t) {
  const auto force = hl::get<3>(HL_FORCE);
  std::printf("%4.1f s  force %.2f N", t, std::hypot(force[0], force[1], force[2]));
  const bool held = hl::get(HL_SNAPPED_OBJECT) == kGuide;
  std::printf("  held by: %s\n", held ? kSnaps.at(static_cast<std::size_t>(hl::get(HL_SNAP_NUMBER))) : "nothing");
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 20;
  const hl::Context context(url);
  hlWorkspaced(0, 0.02, 0, 1);
  defineGuide();
  hlCallObject(kGuide);
  hlFinish();
  hl::check();
  for (int i = 0; i < 60 * seconds; ++i) {
    // Nobody holds the simulated device of inproc:, so the program moves its hand.
    if (url.starts_with("inproc:")) moveHand(i / 60.0);
    hlPoll();
    if (i % 20 == 0) print(i / 60.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  hl::check();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "17_snaps: %s\n", error.what());
  return 2;
}
