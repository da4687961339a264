// What a finger feels of frames that change nothing under it: on a frictionless plane the drag is the servo's own
// damping, whatever the program sends beside. The frames go through the calls and a server; the finger slides on the
// scenes that come out, on a virtual clock.
#include <gtest/gtest.h>
#include <hl/hl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/clock.h"
#include "device/device_models.h"
#include "felt_server.h"
#include "touch/touch_step.h"

namespace hl::client::test_felt_frames {
namespace {

constexpr std::int64_t kStep_ns = 1'000'000;
constexpr double kSpeed_m_s = 0.06;
constexpr double kRadius_m = 0.002;
constexpr double kDeep_m = 0.00107;  // of the finger below where the proxy rests: 1.07 N at 1000 N/m

// A finger that slides along x, and what the servo makes of it.
class Slider {
 public:
  explicit Slider(const std::shared_ptr<const Snapshot>& scene)
      : scenes_(scene), loop_(scenes_, {}), settings_(ServoSettings::of(premium10().info)) {
    settings_.stiffness_N_m = 1000;
    commands_.radius_W = kRadius_m;
    arm(step_.servo());
    lower();
  }

  void show(std::shared_ptr<const Snapshot> scene) { scenes_.publish(std::move(scene)); }
  /// The largest and least of drag over speed meanwhile, N s/m.
  void slide(int steps) {
    for (int i = 0; i < steps; ++i) {
      finger_.x() += kSpeed_m_s * 1e-9 * static_cast<double>(kStep_ns);
      const double drag_Ns_m = -make().force_N.x() / kSpeed_m_s;
      most_Ns_m = std::max(most_Ns_m, drag_Ns_m);
      least_Ns_m = std::min(least_Ns_m, drag_Ns_m);
      ASSERT_TRUE(step_.tick());
      ASSERT_EQ(step_.tick()->report.contacts.size(), 1U);
    }
  }
  /// Until the servo knows the speed.
  void settle() {
    slide(400);
    most_Ns_m = -HUGE_VAL;
    least_Ns_m = HUGE_VAL;
  }
  double damping_Ns_m() const { return settings_.damping_Ns_m; }

  double most_Ns_m = -HUGE_VAL, least_Ns_m = HUGE_VAL;

 private:
  // From above, slowly, while the force ramps up.
  void lower() {
    constexpr int kSteps = 2000;
    for (int i = 0; i < kSteps; ++i) {
      finger_ = {-0.3, kRadius_m + 0.01 * (1 - static_cast<double>(i) / kSteps) - kDeep_m, 0.1};
      make();
    }
  }
  ServoOutput make() {
    DeviceSample sample;
    sample.time_ns = time_ns_ += kStep_ns;
    sample.position = finger_;
    sample.status = DeviceStatus::kOk;
    return step_.onTime(loop_, commands_, settings_, sample);
  }

  SnapshotSlot scenes_;
  ProxyLoop loop_;
  ProxyCommands commands_;
  ServoSettings settings_;
  TouchStep step_;
  Vec3 finger_ = Vec3::Zero();
  std::int64_t time_ns_ = monotonicNow_ns();  // motions begin by this clock
};

// ---- What a program sends -------------------------------------------------------------------------------------------

constexpr HLuint kFloor = 1, kStone = 2, kFloorImage = 1, kStoneImage = 2;

// Frictionless where a texel is 0.
void textured(HLuint image) {
  hlBindTexture(HL_TEXTURE_2D, image);
  hlTexEnvi(HL_TEXTURE_ENV, HL_TEXTURE_QUANTITY, HL_DYNAMIC_FRICTION);
  hlTexEnvd(HL_TEXTURE_ENV, HL_TEXTURE_HIGH, 0.2);
  hlEnable(HL_TEXTURE_2D);
}

// Two columns: the finger slides on the left one.
void giveImage(HLuint image, HLubyte left, HLubyte right) {
  const std::array<HLubyte, 2> texels{left, right};
  hlBindTexture(HL_TEXTURE_2D, image);
  hlTexParameteri(HL_TEXTURE_2D, HL_TEXTURE_FILTER, HL_NEAREST);
  hlTexImage2D(HL_TEXTURE_2D, 0, HL_LUMINANCE, 2, 1, 0, HL_LUMINANCE, HL_UNSIGNED_BYTE, texels.data());
}

void square(double y) {
  constexpr std::array<std::array<double, 2>, 4> kCorners{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};
  hlBegin(HL_QUADS);
  for (const auto& [x, z] : kCorners) {
    hlTexCoord2d(0.5 * (x + 1), 0.5 * (z + 1));
    hlVertex3d(x, y, z);
  }
  hlEnd();
}

void define(HLuint object, HLuint image, double y) {
  hlNewObject(object);
  textured(image);
  square(y);
  hlEndObject();
}

void callStone(double x) {
  hlPushMatrix();
  hlTranslated(x, 0, 0);
  hlCallObject(kStone);
  hlPopMatrix();
}

void begin() {
  giveImage(kFloorImage, 0, 0);
  giveImage(kStoneImage, 0, 0);
  define(kFloor, kFloorImage, 0);
  define(kStone, kStoneImage, -0.5);
  hlCallObject(kFloor);
  callStone(0);
}

struct Sent {
  std::string what;
  std::function<void(int frame)> frame;
};

std::vector<Sent> allThatIsSent() {
  return {{"nothing", {}},
          {"calls of the same objects",
           [](int) {
             hlCallObject(kFloor);
             callStone(0);
           }},
          {"the floor defined again", [](int) { define(kFloor, kFloorImage, 0); }},
          {"another object elsewhere",
           [](int frame) {
             hlCallObject(kFloor);
             callStone(1e-3 * frame);
           }},
          {"another object bent",
           [](int frame) {
             const std::array<HLdouble, 3> corner{-1, -0.5 - 1e-3 * frame, 1};
             hlUpdateVertices(kStone, 0, 1, corner.data(), nullptr);
           }},
          {"another object that comes and goes",
           [](int frame) {
             hlCallObject(kFloor);
             if (frame % 2 == 1) callStone(0);
           }},
          {"another object's texture",
           [](int frame) { giveImage(kStoneImage, static_cast<HLubyte>(frame), static_cast<HLubyte>(255 - frame)); }},
          {"the floor's texture where the finger is not",
           [](int frame) { giveImage(kFloorImage, 0, static_cast<HLubyte>(frame)); }}};
}

// ---- The judgement --------------------------------------------------------------------------------------------------

using FeltFrames = test::FeltServer;

TEST_F(FeltFrames, TheDragOfAPlaneIsTheServosWhateverIsSentBeside) {
  constexpr int kFrames = 30;
  for (const int frames_Hz : {60, 200}) {
    for (const Sent& sent : allThatIsSent()) {
      SCOPED_TRACE(sent.what + ", " + std::to_string(frames_Hz) + " Hz");
      hlFrameInterval(1.0 / frames_Hz);
      begin();
      Slider slider(shown());
      slider.settle();
      for (int frame = 1; frame <= kFrames; ++frame) {
        if (sent.frame) {
          sent.frame(frame);
          slider.show(shown());
        }
        slider.slide(1000 / frames_Hz);
      }
      EXPECT_NEAR(slider.most_Ns_m, slider.damping_Ns_m(), 0.02 * slider.damping_Ns_m());
      EXPECT_NEAR(slider.least_Ns_m, slider.damping_Ns_m(), 0.02 * slider.damping_Ns_m());
    }
  }
}

// The judge itself: where the floor becomes rough the finger feels it.
TEST_F(FeltFrames, ATextureUnderTheFingerIsFelt) {
  begin();
  Slider slider(shown());
  slider.settle();
  giveImage(kFloorImage, 255, 0);
  slider.show(shown());
  slider.slide(200);
  EXPECT_GT(slider.most_Ns_m, 3 * slider.damping_Ns_m());
}

}  // namespace
}  // namespace hl::client::test_felt_frames
