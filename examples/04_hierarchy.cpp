// An arm of boxes that waves: objects within objects, and matrices between them, as one draws a robot in GL.
//
//   04_hierarchy [URL [SECONDS]]
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <hl/hl.hpp>
#include <string>
#include <thread>

namespace {

// Objects are numbers that the program may choose; the same numbers serve as names.
enum Object : HLuint { kBox = 1, kLink, kHand, kShoulder = 11, kUpperArm, kForearm, kFingers };

// A cube from 0 0 0 to 1 1 1.
void defineBox() {
  constexpr std::array<HLfloat, 24> kCorners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  constexpr std::array<HLubyte, 24> kFaces{0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 3, 7, 6, 2, 0, 4, 7, 3, 1, 2, 6, 5};
  const hl::ObjectScope definition(kBox);
  hl::drawElements<HLfloat>(HL_QUADS, {kCorners}, kFaces);
}

// A box of this size that begins in the middle of its y-z side: what joints turn about.
void callBox(double x, double y, double z) {
  const hl::MatrixScope matrix;
  hlScaled(x, y, z);
  hlTranslated(0, -0.5, -0.5);
  hlCallObject(kBox);
}

void defineParts() {
  {
    const hl::ObjectScope definition(kLink);
    callBox(0.06, 0.02, 0.03);
  }
  const hl::ObjectScope definition(kHand);
  callBox(0.02, 0.02, 0.04);
  for (const double z : {-0.015, 0.0, 0.015}) {  // three fingers, with a name of their own
    const hl::MatrixScope matrix;
    const hl::NameScope name(kFingers);
    hlTranslated(0.02, 0, z);
    callBox(0.025, 0.008, 0.008);
  }
}

// Each joint turns all that comes behind it. What has no name in an object has the name of its call.
void drawArm(double shoulder, double elbow) {
  hlLoadName(kShoulder);
  callBox(0.02, 0.06, 0.06);
  hlTranslated(0.02, 0, 0);
  hlRotated(shoulder, 0, 0, 1);
  hlLoadName(kUpperArm);
  hlCallObject(kLink);
  hlTranslated(0.06, 0, 0);
  hlRotated(elbow, 0, 0, 1);
  hlLoadName(kForearm);
  hlCallObject(kLink);
  hlTranslated(0.06, 0, 0);
  hlCallObject(kHand);
}

const char* nameOf(HLuint name) {
  constexpr std::array<const char*, 4> kNames{"shoulder", "upper arm", "forearm", "fingers"};
  return name >= kShoulder && name <= kFingers ? kNames[name - kShoulder] : "nothing";
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10;
  hl::Context context(url);
  context.onEvent(HL_EVENT_TOUCH, [](const HLevent& event) { std::printf("touching: %s\n", nameOf(event.name)); });
  hlWorkspaced(0, 0.07, 0, 1);
  defineBox();
  defineParts();
  for (int i = 0; i < 60 * seconds; ++i) {
    const double t = i / 60.0;
    {
      const hl::MatrixScope matrix;
      hlTranslated(-0.08, 0, 0);
      drawArm(15 * std::sin(t), 25 * std::sin(1.7 * t));
    }
    hlFlush();  // only the matrices are sent: the objects are there already
    // Nobody holds the simulated device of inproc:, so the program lays its hand on the arm, which then pushes it.
    if (url.starts_with("inproc:")) hlHandGoal3d(0.03 * std::sin(0.5 * t), 0.005, 0);
    context.poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  hl::check();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "04_hierarchy: %s\n", error.what());
  return 2;
}
