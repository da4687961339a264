#include "device/fakes/bench.h"

#include <dlfcn.h>

#include <cstdlib>
#include <stdexcept>

#include "device/fakes/falcon_line.h"
#include "device/fakes/haply_service.h"
#include "device/falcon/falcon_device.h"
#include "device/open_device.h"

namespace hl::test {

namespace {

// Three encoder steps of 30 um, one for each joint; one count of the motors, and of the encoders for the Jacobian.
constexpr double kPosition_m = 1e-4, kForce_N = 2e-3;
// Three encoder steps of the Falcon, 60 um each; one count of each motor, 1e-4 Nm, and the encoders for the Jacobian.
constexpr double kFalconPosition_m = 2e-4, kFalconForce_N = 1e-2;

/// A driver that opens a shared library, with the fake one in its place.
class LibraryBench final : public Bench {
 public:
  LibraryBench(const char* kind, const char* variable, const char* file) : kind_(kind) {
    setenv(variable, file, 1);
    library_ = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) throw std::runtime_error(dlerror());
    arm_ = reinterpret_cast<FakeArmOf*>(dlsym(library_, kFakeArmOf))();
  }
  ~LibraryBench() override { dlclose(library_); }
  FakeArm& arm() override { return *arm_; }
  std::unique_ptr<Device> device() override { return makeDevice(kind_); }

 private:
  const char* kind_;
  void* library_;
  FakeArm* arm_;
};

/// HL's own device, which the test can look at while a servo moves it.
class SimulatedDriver final : public Device {
 public:
  explicit SimulatedDriver(FakeArm& arm) : arm_(arm) {}
  void open() override {}
  void close() override { arm_.write(Vec3::Zero()); }
  const DeviceInfo& info() const override { return arm_.info(); }
  DeviceSample read(std::int64_t now_ns) override { return arm_.read(now_ns); }
  void write(const Vec3& force_N) override { arm_.write(force_N); }
  void stop() noexcept override { arm_.stop(); }
  SimulatedHand* hand() override { return arm_.hand(); }

 private:
  FakeArm& arm_;
};

class SimulatedBench final : public Bench {
 public:
  FakeArm& arm() override { return arm_; }
  std::unique_ptr<Device> device() override { return std::make_unique<SimulatedDriver>(arm_); }

 private:
  FakeArm arm_;
};

std::unique_ptr<Bench> makeSimulated() { return std::make_unique<SimulatedBench>(); }
std::unique_ptr<Bench> makeForceDimension() {
  return std::make_unique<LibraryBench>("dhd", "HL_DHD_LIBRARY", HL_FAKE_DHD);
}

class HaplyBench final : public Bench {
 public:
  explicit HaplyBench(const char* version) : service_(arm_, version) {}
  FakeArm& arm() override { return arm_; }
  std::unique_ptr<Device> device() override { return makeDevice("haply:" + service_.url()); }

 private:
  FakeArm arm_;
  HaplyService service_;
};

class FalconBench final : public Bench {
 public:
  FalconBench() { box_.running = true; }
  FakeArm& arm() override { return box_.arm; }
  std::unique_ptr<Device> device() override {
    return std::make_unique<FalconDevice>(std::make_unique<FakeFalconLine>(box_));
  }

 private:
  FalconBox box_;
};

std::unique_ptr<Bench> makeFalcon() { return std::make_unique<FalconBench>(); }
std::unique_ptr<Bench> makeTouchHd() { return std::make_unique<LibraryBench>("hd", "HL_HD_LIBRARY", HL_FAKE_HD); }
std::unique_ptr<Bench> makeHaply() { return std::make_unique<HaplyBench>("3.5.0"); }
std::unique_ptr<Bench> makeOldHaply() { return std::make_unique<HaplyBench>("3.1.0"); }

}  // namespace

std::vector<BenchKind> benchKinds() {
  return {{"Simulated", makeSimulated, kPosition_m, kForce_N},
          {"ForceDimension", makeForceDimension, kPosition_m, kForce_N},
          {"TouchHd", makeTouchHd, kPosition_m, kForce_N},
          {"Falcon", makeFalcon, kFalconPosition_m, kFalconForce_N},
          {"Haply", makeHaply, kPosition_m, kForce_N},
          {"OldHaply", makeOldHaply, kPosition_m, kForce_N}};
}

}  // namespace hl::test
