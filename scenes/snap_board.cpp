#include "snap_board.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/plain_math.h"
#include "solids.h"

namespace hl {

namespace {

constexpr std::size_t kRound = 24;
constexpr double kCapture_m = 0.003, kRelease_N = 2.5;

/// The scene while it is put together.
class SnapBoard {
 public:
  SceneModel make() {
    scene_.model.name = "snaps";
    scene_.model.materials.front().smooth = true;
    appendSolid(scene_.model, boxSolid(Vec3(0.11, 0.005, 0.07)), Vec3(0, -0.005, 0));
    socket("socket 1", Vec3(-0.09, 0, -0.05));
    socket("socket 2", Vec3(-0.06, 0, -0.05));
    rail(Vec3(-0.03, 0, -0.05), Vec3(0.05, 0, -0.05));
    curve(Vec3(-0.095, 0, 0.045));
    snap({"sheet", {Vec3(0.095, 0.02, 0)}, Vec3::UnitX(), kCapture_m / 2, 1});
    drag(Vec3(-0.01, 0.01, -0.005));
    handle(Vec3(0.055, 0, 0));
    magnet(Vec3(0.055, 0, 0.045));
    return std::move(scene_);
  }

 private:
  void snap(SnapSpec snap) { scene_.snaps.push_back(std::move(snap)); }

  void pin(const Vec3& at, double height_m) {
    appendSolid(scene_.model, cylinderSolid(0.002, height_m / 2, kRound), at + Vec3(0, height_m / 2, 0));
  }

  // A point above a pin.
  void socket(const std::string& name, const Vec3& at) {
    constexpr double kPin_m = 0.02, kAbove_m = 0.008;
    pin(at, kPin_m);
    snap({name, {at + Vec3(0, kPin_m + kAbove_m, 0)}, std::nullopt, kCapture_m, kRelease_N});
  }

  // A line between the tops of two posts, so far from them that a proxy at its ends touches neither.
  void rail(const Vec3& from, const Vec3& to) {
    constexpr double kPost_m = 0.032, kHeight_m = 0.028, kFree_m = 0.007;
    pin(from, kPost_m);
    pin(to, kPost_m);
    const Vec3 along = kFree_m * (to - from).normalized(), up(0, kHeight_m, 0);
    snap({"rail", {from + along + up, to - along + up}, std::nullopt, kCapture_m, kRelease_N});
  }

  // Two waves on the board, a drawn line beneath them.
  void curve(const Vec3& at) {
    constexpr int kCorners = 33;
    constexpr double kLength_m = 0.1, kWave_m = 0.016, kTurn = 12.566370614359172;  // 4 pi
    SnapSpec path{"curve", {}, std::nullopt, kCapture_m, kRelease_N};
    for (int i = 0; i < kCorners; ++i) {
      const double part = static_cast<double>(i) / (kCorners - 1);
      path.points.emplace_back(at + Vec3(kLength_m * part, 0, -kWave_m * plain::sin(kTurn * part)));
    }
    draw(path.points);
    snap(std::move(path));
  }

  void draw(const std::vector<Vec3>& points) {
    Model& model = scene_.model;
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    model.positions.insert(model.positions.end(), points.begin(), points.end());
    model.normals.resize(model.positions.size(), Vec3::Zero());
    for (std::uint32_t i = 1; i < points.size(); ++i) model.segments.push_back({first + i - 1, first + i});
  }

  void drag(const Vec3& at) {
    FieldSpec field{"drag", FieldKind::kDrag, {at}, std::nullopt, 0.025};
    field.damping_Ns_m = 4;
    scene_.fields.push_back(std::move(field));
  }

  SceneBody& block(std::string name, const Vec3& at, double mass_kg) {
    constexpr double kHalf_m = 0.01;
    BodySpec spec;
    spec.mass_kg = mass_kg;
    spec.shape = BodyShape::kBox;
    spec.surface = {0.4, 0.4, 0};
    scene_.bodies.push_back(
        {std::move(name), boxSolid(Vec3::Constant(kHalf_m)), {Mat3::Identity(), at + Vec3(0, kHalf_m, 0)}, spec});
    return scene_.bodies.back();
  }

  // 0.5 N, less than what the handle holds.
  void handle(const Vec3& at) {
    block("block with a handle", at, 0.05)
        .snaps.push_back({"handle", {Vec3(0, 0.018, 0)}, std::nullopt, kCapture_m, kRelease_N});
  }

  void magnet(const Vec3& at) {
    block("magnetic block", at, 0.05)
        .fields.push_back({"magnet", FieldKind::kMagnet, {Vec3::Zero()}, std::nullopt, 0.035, 0.5});
  }

  SceneModel scene_;
};

}  // namespace

SceneModel makeSnapBoard() { return SnapBoard().make(); }

}  // namespace hl
