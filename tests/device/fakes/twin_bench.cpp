#include "device/fakes/twin_bench.h"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

#include "device/fakes/falcon_line.h"
#include "device/fakes/haply_service.h"
#include "device/falcon/falcon_device.h"
#include "device/open_device.h"

namespace hl::test {

namespace {

using Names = std::array<const char*, 2>;

class TwinLibrary final : public TwinBench {
 public:
  TwinLibrary(const char* variable, const char* file, const Names& specs) : specs_(specs) {
    setenv(variable, file, 1);
    library_ = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) throw std::runtime_error(dlerror());
    find<FakePlugIn>(kFakePlugIn)(kFakeDevices);
  }
  ~TwinLibrary() override { dlclose(library_); }
  FakeArm& arm(std::size_t number) override { return *find<FakeArmNumber>(kFakeArmNumber)(number); }
  std::unique_ptr<Device> device(std::size_t number) override { return makeDevice(specs_[number]); }

 private:
  template <typename Function>
  Function* find(const char* name) const {
    return reinterpret_cast<Function*>(dlsym(library_, name));
  }

  const Names specs_;
  void* library_;
};

class TwinFalcons final : public TwinBench {
 public:
  TwinFalcons() {
    for (FalconBox& box : boxes_) box.running = true;
  }
  FakeArm& arm(std::size_t number) override { return boxes_[number].arm; }
  std::unique_ptr<Device> device(std::size_t number) override {
    return std::make_unique<FalconDevice>(std::make_unique<FakeFalconLine>(boxes_[number]));
  }

 private:
  std::array<FalconBox, 2> boxes_;
};

class TwinHaply final : public TwinBench {
 public:
  FakeArm& arm(std::size_t number) override { return arms_[number]; }
  std::unique_ptr<Device> device(std::size_t number) override {
    return makeDevice("haply:" + service_.url() + "/" + HaplyService::kIds[number]);
  }

 private:
  std::array<FakeArm, 2> arms_;
  HaplyService service_{std::vector<FakeArm*>{&arms_[0], &arms_[1]}, "3.5.0"};
};

class TwinHaplyServices final : public TwinBench {
 public:
  FakeArm& arm(std::size_t number) override { return arms_[number]; }
  std::unique_ptr<Device> device(std::size_t number) override {
    return makeDevice("haply:" + (number == 0 ? first_ : second_).url());
  }

 private:
  std::array<FakeArm, 2> arms_;
  HaplyService first_{arms_[0], "3.5.0"}, second_{arms_[1], "3.1.0"};
};

std::unique_ptr<TwinBench> twinDhd(const Names& specs) {
  return std::make_unique<TwinLibrary>("HL_DHD_LIBRARY", HL_FAKE_DHD, specs);
}
std::unique_ptr<TwinBench> twinHd(const Names& specs) {
  return std::make_unique<TwinLibrary>("HL_HD_LIBRARY", HL_FAKE_HD, specs);
}

}  // namespace

std::vector<TwinKind> twinKinds() {
  constexpr double kPosition_m = 1e-4, kForce_N = 2e-3, kFalconPosition_m = 2e-4, kFalconForce_N = 1e-2;
  return {
      {"DhdByIndex",
       [] {
         return twinDhd({"dhd:0", "dhd:1"});
       },
       kPosition_m, kForce_N, true},
      {"DhdBySerial",
       [] {
         return twinDhd({"dhd:serial=1000", "dhd:serial=1001"});
       },
       kPosition_m, kForce_N, true},
      {"DhdFirstAndIndex",
       [] {
         return twinDhd({"dhd", "dhd:1"});
       },
       kPosition_m, kForce_N, true},
      {"HdByName",
       [] {
         return twinHd({"hd:Left Device", "hd:Right Device"});
       },
       kPosition_m, kForce_N, false},
      {"HdDefaultAndName",
       [] {
         return twinHd({"hd", "hd:Right Device"});
       },
       kPosition_m, kForce_N, false},
      {"Falcons", []() -> std::unique_ptr<TwinBench> { return std::make_unique<TwinFalcons>(); }, kFalconPosition_m,
       kFalconForce_N, false},
      {"HaplyOfOneService", []() -> std::unique_ptr<TwinBench> { return std::make_unique<TwinHaply>(); }, kPosition_m,
       kForce_N, false},
      {"HaplyServices", []() -> std::unique_ptr<TwinBench> { return std::make_unique<TwinHaplyServices>(); },
       kPosition_m, kForce_N, false},
  };
}

}  // namespace hl::test
