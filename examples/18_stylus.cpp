// A pen that writes on a sheet while it is held upright, and only then: how the stylus of the device is turned.
//
//   18_stylus [URL [SECONDS]]
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <hl/hl.hpp>
#include <string>
#include <thread>

namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kSteepest = 50 * kPi / 180;  // from upright: the ink flows

void drawSheet() {
  const hl::PrimitiveScope quads(HL_QUADS);
  hlVertex3d(-0.06, 0, 0.06);
  hlVertex3d(0.06, 0, 0.06);
  hlVertex3d(0.06, 0, -0.06);
  hlVertex3d(-0.06, 0, -0.06);
}

// The angle between the shaft and the vertical: the shaft is the z axis of the stylus.
double slope() {
  const auto [x, y, z, w] = hl::get<4>(HL_STYLUS_ROTATION);
  const double up = 2 * (y * z - w * x);  // the y component of the turned z axis
  return std::acos(std::fmin(1, std::fmax(-1, up)));
}

// To and fro on the sheet, now upright, now lying.
void moveHand(double t) {
  hlHandGoal3d(0.04 * std::sin(t), -0.005, 0);
  const double angle = -kPi / 2 * (0.5 + 0.5 * std::cos(t / 2));  // about x: -90 degrees is upright
  hlHandTurn4d(std::sin(angle / 2), 0, 0, std::cos(angle / 2));
}

// Adds to `written` what the pen has gone on the sheet since the time before.
class Pen {
 public:
  void follow() {
    const auto proxy = hl::get<3>(HL_PROXY_POSITION);
    writes_ = hl::get(HL_CONTACT_COUNT) > 0 && slope() < kSteepest;
    if (writes_) written_m_ += std::hypot(proxy[0] - before_[0], proxy[2] - before_[2]);
    before_ = proxy;
  }
  void print() const {
    std::printf("shaft %2.0f degrees from upright, %s, %.0f mm written\n", slope() * 180 / kPi,
                writes_ ? "writes" : "does not write", 1e3 * written_m_);
  }

 private:
  std::array<double, 3> before_{};
  double written_m_ = 0;
  bool writes_ = false;
};

}  // namespace

int main(int argc, char** argv) try {
  const std::string url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 20;
  const hl::Context context(url);
  if (hl::get(HL_DEVICE_WRIST) == 0) std::puts("this device does not tell how its stylus is turned");
  hlWorkspaced(0, 0.02, 0, 1);
  drawSheet();
  hlFinish();
  hl::check();
  Pen pen;
  for (int i = 0; i < 60 * seconds; ++i) {
    // Nobody holds the simulated device of inproc:, so the program moves its hand.
    if (url.starts_with("inproc:")) moveHand(i / 60.0);
    hlPoll();
    pen.follow();
    if (i % 20 == 0) pen.print();
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  hl::check();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "18_stylus: %s\n", error.what());
  return 2;
}
