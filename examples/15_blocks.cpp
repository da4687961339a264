// Ten blocks on a floor, in two towers, which the finger can push over: bodies move by themselves, and the program is
// sent where they are.
//
//   15_blocks [URL [SECONDS]]
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <hl/hl.hpp>
#include <string>
#include <thread>

namespace {

constexpr HLuint kFloor = 1, kBlock = 2;
constexpr double kHalf_m = 0.01;  // of a block's side
constexpr int kBlocks = 10;

void drawBox(double x, double y, double z) {
  constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  const hl::PrimitiveScope quads(HL_QUADS);
  for (const auto& face : kFaces) {
    for (const int corner : face)
      hlVertex3d((corner & 1) != 0 ? x : -x, (corner & 2) != 0 ? y : -y, (corner & 4) != 0 ? z : -z);
  }
}

void defineObjects() {
  {
    const hl::ObjectScope floor(kFloor);
    drawBox(0.12, 0.01, 0.12);
  }
  const hl::ObjectScope block(kBlock);
  hlBodyi(HL_BODY_SHAPE, HL_BODY_BOX);
  hlBodyd(HL_BODY_MASS, 0.02);  // kg
  drawBox(kHalf_m, kHalf_m, kHalf_m);
}

// Block i starts at its place in one of the towers; its name is i + 1.
void draw() {
  {
    const hl::MatrixScope matrix;
    hlTranslated(0, -0.01, 0);
    hlCallObject(kFloor);
  }
  for (int i = 0; i < kBlocks; ++i) {
    const hl::MatrixScope matrix;
    const hl::NameScope name(static_cast<HLuint>(i + 1));
    hlTranslated(i < kBlocks / 2 ? -0.03 : 0.03, kHalf_m * (1 + 2.02 * (i % (kBlocks / 2))), 0);
    hlCallObject(kBlock);
  }
}

void print(double t) {
  std::printf("%4.1f s", t);
  for (const HLbody& body : hl::bodies())
    std::printf("  %u: %.3f %.3f %.3f", body.name, body.position[0], body.position[1], body.position[2]);
  std::printf("\n");
  for (const HLbody& body : hl::bodies()) {
    if (body.position[1] < 4 * kHalf_m && (body.name - 1) % (kBlocks / 2) == kBlocks / 2 - 1)
      std::printf("fallen: block %u\n", body.name);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 20;
  const hl::Context context(url);
  hlWorkspaced(0, 0.06, 0, 1);
  defineObjects();
  draw();
  hlFinish();
  hl::check();
  for (int i = 0; i < 60 * seconds; ++i) {
    const double t = i / 60.0;
    // Nobody holds the simulated device of inproc:, so the program moves its hand: to and fro through the towers.
    if (url.starts_with("inproc:")) hlHandGoal3d(0.07 * std::cos(2 * t), 0.07, 0);
    hlPoll();
    if (i == 120) {  // whoever touches nothing sees a tower fall all the same
      const hl::NameScope top(5);
      hlBodyImpulsed(kBlock, -0.008, 0, 0, -0.03, 9 * kHalf_m, 0, 0);
    }
    if (i % 60 == 0) print(t);
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  hl::check();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "15_blocks: %s\n", error.what());
  return 2;
}
