// MuJoCo, with its usual solver and softness; friction as a true cone.
#include <fmt/core.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cstring>

#include "base/error.h"
#include "cubes/body_engine.h"

namespace hl::bench {

namespace {

constexpr std::size_t kMaxContacts = 24;  // of a cube

std::string mujocoModelOf(const CubeScene& scene) {
  std::string xml = fmt::format(
      "<mujoco><option timestep='{}' gravity='0 -{} 0' cone='elliptic'/><size njmax='{}' nconmax='{}'/>"
      "<default><geom friction='{} 0 0' condim='3'/></default><worldbody>"
      "<geom type='plane' size='1 1 1' zaxis='0 1 0'/>",
      kBodyStep_s, kEarth_m_s2, kMaxContacts * 3 * scene.cubes.size(), kMaxContacts * scene.cubes.size(),
      scene.friction);
  for (const int side : {-1, 1}) {
    if (!(scene.walls_m > 0)) continue;
    xml += fmt::format("<geom type='plane' size='1 1 1' pos='{} 0 0' zaxis='{} 0 0'/>", -side * scene.walls_m, side);
    xml += fmt::format("<geom type='plane' size='1 1 1' pos='0 0 {}' zaxis='0 0 {}'/>", -side * scene.walls_m, side);
  }
  for (const Pose& pose : scene.cubes) {
    const Eigen::Quaterniond q(pose.rotation);
    xml += fmt::format(
        "<body pos='{:.17g} {:.17g} {:.17g}' quat='{:.17g} {:.17g} {:.17g} {:.17g}'><freejoint/>"
        "<geom type='box' size='{} {} {}' mass='{}'/></body>",
        pose.origin.x(), pose.origin.y(), pose.origin.z(), q.w(), q.x(), q.y(), q.z(), kCubeHalf_m, kCubeHalf_m,
        kCubeHalf_m, kCube_kg);
  }
  return xml + "</worldbody></mujoco>";
}

class MujocoBodies final : public BodyEngine {
 public:
  explicit MujocoBodies(const CubeScene& scene) {
    const std::string xml = mujocoModelOf(scene);
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    const int place = mj_makeEmptyFileVFS(files.get(), "cubes.xml", static_cast<int>(xml.size()));
    if (place < 0) throw Error("mujoco: no room for the scene");
    std::memcpy(files->filedata[0], xml.data(), xml.size());
    std::array<char, 1000> fault{};
    model_.reset(mj_loadXML("cubes.xml", files.get(), fault.data(), static_cast<int>(fault.size())));
    mj_deleteVFS(files.get());
    if (!model_) throw Error(std::string("mujoco: ") + fault.data());
    data_.reset(mj_makeData(model_.get()));
    mj_forward(model_.get(), data_.get());
  }

  double step(double finger_m) override {
    const double force_N = pushOf_N(finger_m, cube(0));
    data_->xfrc_applied[6] = force_N;  // of body 1; body 0 is the world
    mj_step(model_.get(), data_.get());
    return force_N;
  }
  // A free joint has seven coordinates, and six velocities, of which the spin is in the frame of the body.
  CubeState cube(std::size_t i) const override {
    const mjtNum *q = data_->qpos + 7 * i, *v = data_->qvel + 6 * i;
    CubeState state;
    state.centre = {q[0], q[1], q[2]};
    state.turned = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized().toRotationMatrix();
    state.velocity = {v[0], v[1], v[2]};
    state.spin = state.turned * Vec3(v[3], v[4], v[5]);
    return state;
  }

 private:
  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
};

}  // namespace

std::unique_ptr<BodyEngine> makeMujocoBodies(const CubeScene& scene) { return std::make_unique<MujocoBodies>(scene); }

}  // namespace hl::bench
