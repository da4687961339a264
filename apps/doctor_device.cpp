#include "doctor_device.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "device/open_device.h"

namespace hl {

namespace {

constexpr double kPatience_s = 5;  // a driver with a thread of its own has begun by then; a person homes a device later

std::string indented(const std::string& advice) {
  std::string text = "                    -> ";
  for (const char letter : advice) {
    text += letter;
    if (letter == '\n') text += "                       ";
  }
  return text;
}

void print(const Finding& finding) {
  fmt::print("{:<20}{} {}\n", finding.what + ":", finding.good ? "good:" : "BAD: ", finding.text);
  if (!finding.advice.empty()) fmt::print("{}\n", indented(finding.advice));
}

void printInstruction(SelfTestPart part, bool simulated) {
  const char* what = nullptr;
  if (part == SelfTestPart::kMove) what = "move the tip to all sides: left, right, up, down, to you, away (7 s)";
  if (part == SelfTestPart::kStill) what = "hold it still (3 s)";
  if (part == SelfTestPart::kPull) what = "hold it loosely: it pulls gently, six times (9 s)";
  if (what == nullptr) return;
  fmt::print("self-test:          {}{}\n", what, simulated ? "; the simulated hand does" : "");
  std::fflush(stdout);
}

void print(const SelfTestRun& run) {
  const SelfTestReport& report = run.report;
  fmt::print("moved:              {:.0f} x {:.0f} x {:.0f} mm; at rest within {:.2f} mm\n", 1e3 * report.range_m.x(),
             1e3 * report.range_m.y(), 1e3 * report.range_m.z(), 1e3 * report.noise_m);
  for (const SelfTestPull& pull : report.pulls)
    fmt::print(
        "pull {:+.0f} {:+.0f} {:+.0f}:      {:.1f} N moved it by {:.1f} mm along and {:.1f} mm across; {}\n",
        pull.direction_D.x(), pull.direction_D.y(), pull.direction_D.z(), report.pull_N, 1e3 * pull.along_m,
        1e3 * pull.across_m,
        pull.onset_s < 0 ? std::string("no motion") : fmt::format("it began after {:.0f} ms", 1e3 * pull.onset_s));
  fmt::print("servo:              {} steps at {:g} Hz, {} missed; in the driver {:.0f} us median, {:.0f} us at most\n",
             run.steps, run.rate_Hz, run.deadlines_missed, 1e-3 * static_cast<double>(run.calls.percentile_ns(0.5)),
             1e-3 * static_cast<double>(run.calls.max_ns()));
  for (const std::string& fault : run.faults) fmt::print("BAD:                {}\n", fault);
  fmt::print("verdict:            {}\n", run.faults.empty() ? "passed" : "not passed");
}

}  // namespace

bool DeviceExamination::good() const {
  const auto counts = [this](const Finding& finding) { return !finding.good && !(opened() && finding.what == "usb"); };
  return std::ranges::none_of(findings, counts) && (!test || test->faults.empty());
}

DeviceExamination examineDevice(const std::string& spec, bool self_test) {
  DeviceExamination seen;
  seen.kind = spec.substr(0, spec.find(':'));
  seen.findings = examineSurroundings(spec, usbDevices());
  for (const Finding& finding : seen.findings) print(finding);
  const auto lacks_library = [](const Finding& finding) { return !finding.good && finding.what == "library"; };
  if (std::ranges::any_of(seen.findings, lacks_library)) return seen;
  const std::unique_ptr<Device> device = makeDevice(spec);
  const std::vector<Finding> opening = examineOpening(spec, *device, kPatience_s);
  for (const Finding& finding : opening) print(finding);
  seen.findings.insert(seen.findings.end(), opening.begin(), opening.end());
  if (!opening.front().good) return seen;
  seen.name = device->info().name;
  if (self_test && allGood(opening)) {
    const bool simulated = device->hand() != nullptr;
    seen.test = runSelfTest(*device, [&](SelfTestPart part) { printInstruction(part, simulated); });
    print(*seen.test);
  }
  device->close();
  return seen;
}

}  // namespace hl
