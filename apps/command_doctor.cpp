// hl doctor: what this machine grants, and which devices are present; or one device, looked at closely.
#include <fmt/core.h>

#include <filesystem>
#include <optional>
#include <string>

#include "commands.h"
#include "device/open_device.h"
#include "doctor_device.h"
#include "doctor_machine.h"
#include "doctor_report.h"
#include "io/output_file.h"
#include "ros_options.h"
#include "serving.h"
#include "share_options.h"

namespace hl {

namespace {

constexpr int kFoundFaults = 1;  // exit code

struct DoctorOptions {
  std::string device;  ///< empty: none in particular
  bool self_test = false;
  std::string report;  ///< file; empty: none
};

// How many there are, and the newest: their names begin with the time.
void printBlackBoxes() {
  const std::string folder = defaultBlackBoxFolder();
  std::string newest;
  std::size_t count = 0;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (entry.path().extension() != ".hlr") continue;
    ++count;
    newest = std::max(newest, entry.path().string());
  }
  fmt::print("faults:             ");
  if (count == 0)
    fmt::print("no black box in {}\n", folder);
  else
    fmt::print("{} black boxes; hl replay {}\n", count, newest);
}

void printPresentDevices() {
  for (const char* head = "devices:"; const DevicePresence& device : findDevices()) {
    fmt::print("{:<20}{:<7}{}\n", head, device.kind, device.text);
    head = "";
  }
  fmt::print("{:<20}one of them closely: hl doctor DEVICE\n", "");
}

void printAdvice(const RealtimeGrant& grant) {
  if (grant.fifo && grant.memory_locked) return;
  fmt::print(
      "advice:             let your user have real time: in /etc/security/limits.conf add\n"
      "                      @audio - rtprio 95\n"
      "                      @audio - memlock unlimited\n"
      "                    put the user into the group audio, and log in again. HL works without, less evenly.\n");
}

MachineExamination examineAndPrintMachine() {
  const MachineExamination machine = examineMachine();
  print(machine);
  return machine;
}

void examineAll(OutputFile* report) {
  const MachineExamination machine = examineAndPrintMachine();
  printPresentDevices();
  fmt::print("{:<20}{}\n", "ROS 2:", rosPresence());
  fmt::print("{:<20}{}\n", "shared worlds:", sharePresence());
  printBlackBoxes();
  printAdvice(machine.grant);
  if (report != nullptr) report->write(reportOf(machine, {}));
}

/// Whether all is good.
bool examineOne(const DoctorOptions& options, OutputFile* report) {
  const DeviceExamination device = examineDevice(options.device, options.self_test);
  if (report != nullptr) {
    const MachineExamination machine = examineAndPrintMachine();
    printAdvice(machine.grant);
    report->write(reportOf(machine, device));
  }
  return device.good();
}

void runDoctor(const DoctorOptions& options) {
  if (options.self_test && options.device.empty())
    throw CLI::ValidationError("--self-test needs a device", "for example hl doctor sim --self-test");
  if (!options.device.empty()) makeDevice(options.device);  // refuses what is none, before a file is begun
  std::optional<OutputFile> report;
  if (!options.report.empty()) report.emplace(options.report);
  OutputFile* const out = report ? &*report : nullptr;
  bool good = true;
  if (options.device.empty())
    examineAll(out);
  else
    good = examineOne(options, out);
  if (report) {
    report->close();
    fmt::print("report:             {}; read it before you send it\n", options.report);
  }
  if (!good) throw CLI::RuntimeError(kFoundFaults);
}

}  // namespace

void addDoctorCommand(CLI::App& app) {
  auto options = std::make_shared<DoctorOptions>();
  auto* command = app.add_subcommand(
      "doctor", "what this machine grants and which devices are present; or one device, looked at closely");
  command->add_option("device", options->device, "a device to look at closely: " + deviceSpecs());
  command->add_flag("--self-test", options->self_test,
                    "test the device for 20 s: does it move, do forces pull the right way, how late; the hand that "
                    "holds it must do what is asked");
  command->add_option("--report", options->report,
                      "write what was found to this file, as JSON, without names of users: to be sent in");
  command->callback([options] { runDoctor(*options); });
}

}  // namespace hl
