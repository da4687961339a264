#include "doctor_report.h"

#include <sys/utsname.h>

#include <boost/json/serialize.hpp>
#include <boost/json/value.hpp>
#include <cstdlib>
#include <fstream>
#include <regex>

#include "device/open_device.h"

namespace hl {

namespace {

namespace json = boost::json;

json::array arrayOf(const Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

std::string distributionName() {
  std::ifstream in("/etc/os-release");
  const std::string head = "PRETTY_NAME=";
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(head, 0) != 0) continue;
    std::erase(line, '"');
    return line.substr(head.size());
  }
  return "";
}

json::object systemOf() {
  utsname system{};
  uname(&system);
  return {{"distribution", distributionName()}, {"kernel", system.release}, {"processor", system.machine}};
}

json::object objectOf(const MachineExamination& machine) {
  json::array timers;
  for (const TimerResult& timer : machine.timers)
    timers.push_back(json::object{{"rate_Hz", timer.rate_Hz},
                                  {"late_median_ns", timer.late_median_ns},
                                  {"late_p999_ns", timer.late_p999_ns},
                                  {"late_max_ns", timer.late_max_ns},
                                  {"steps", timer.steps},
                                  {"deadlines_missed", timer.deadlines_missed}});
  return {{"cores", machine.cores},
          {"fifo", machine.grant.fifo},
          {"memory_locked", machine.grant.memory_locked},
          {"servo_rate_Hz", machine.servoRate_Hz()},
          {"timers", timers}};
}

json::array arrayOf(const std::vector<Finding>& findings) {
  json::array all;
  for (const Finding& finding : findings)
    all.push_back(json::object{
        {"what", finding.what}, {"good", finding.good}, {"text", finding.text}, {"advice", finding.advice}});
  return all;
}

json::object objectOf(const SelfTestRun& run) {
  json::array pulls, faults;
  for (const SelfTestPull& pull : run.report.pulls)
    pulls.push_back(json::object{{"direction", arrayOf(pull.direction_D)},
                                 {"along_m", pull.along_m},
                                 {"across_m", pull.across_m},
                                 {"onset_s", pull.onset_s}});
  for (const std::string& fault : run.faults) faults.push_back(json::string(fault));
  return {{"passed", run.faults.empty()},
          {"faults", faults},
          {"range_m", arrayOf(run.report.range_m)},
          {"noise_m", run.report.noise_m},
          {"pull_N", run.report.pull_N},
          {"pulls", pulls},
          {"age_max_s", run.report.age_max_s},
          {"rate_Hz", run.rate_Hz},
          {"steps", run.steps},
          {"deadlines_missed", run.deadlines_missed},
          {"driver_median_ns", run.calls.percentile_ns(0.5)},
          {"driver_max_ns", run.calls.max_ns()}};
}

json::array presentDevices() {
  json::array all;
  for (const DevicePresence& device : findDevices())
    all.push_back(json::object{{"kind", device.kind}, {"text", device.text}});
  return all;
}

}  // namespace

std::string withoutNames(std::string text) {
  if (const char* home = std::getenv("HOME"); home != nullptr && std::string(home).size() > 1)
    for (std::size_t at = 0; (at = text.find(home, at)) != std::string::npos;)
      text.replace(at, std::string(home).size(), "~");
  text = std::regex_replace(text, std::regex("/home/[^/\\s\"]+"), "~");
  return std::regex_replace(text, std::regex("(wss?://)(?!localhost|127\\.0\\.0\\.1)[^/:\\s\"]+"), "$1HOST");
}

std::string reportOf(const MachineExamination& machine, const std::optional<DeviceExamination>& device) {
  json::object report{
      {"hl_doctor", 1}, {"version", HL_VERSION}, {"system", systemOf()}, {"machine", objectOf(machine)}};
  if (!device) {
    report["devices"] = presentDevices();
  } else {
    json::object seen{{"kind", device->kind}, {"name", device->name}, {"findings", arrayOf(device->findings)}};
    if (device->test) seen["self_test"] = objectOf(*device->test);
    report["device"] = seen;
  }
  return withoutNames(json::serialize(report)) + "\n";
}

}  // namespace hl
