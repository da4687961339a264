#include "device/examine_device.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <clocale>
#include <span>
#include <thread>

#include "base/clock.h"
#include "base/error.h"
#include "device/force_dimension/force_dimension_device.h"
#include "device/open_device.h"
#include "device/touch_hd/touch_hd_device.h"
#include "device/vendor_library.h"

namespace hl {

namespace {

// Ids as users' rules and reports have them: Force Dimension's products differ by model; 3D Systems' Touch comes as
// 2988:0302 and 2988:0304, an older one with both numbers exchanged.
constexpr std::array kForceDimensionUsb{UsbId{0x1451, {}}};
constexpr std::array kFalconUsb{UsbId{0x0403, 0xcb48}};
constexpr std::array kTouchUsb{UsbId{0x2988, {}}, UsbId{0x0301, 0x2988}};

struct Needs {
  const char* kind;
  std::span<const UsbId> usb;        ///< empty: the device is not on USB for HL
  const VendorLibraryName* library;  ///< null: none
  const char* calibrate;             ///< what to do when it is not ready
};

constexpr std::array kNeeds{
    Needs{"sim", {}, nullptr, ""},
    Needs{"dhd", kForceDimensionUsb, &ForceDimensionDevice::kLibrary,
          "calibrate it: move the handle through its whole space, or run the vendor's program for that; if its force "
          "button or dead-man switch is off, switch it on"},
    Needs{"falcon", kFalconUsb, nullptr, "home it: pull the tip fully out, then push it fully in, until it is ready"},
    Needs{"hd", kTouchUsb, &HdLibrary::kName,
          "calibrate it: put the stylus into its well, and if that does not do, run the vendor's program"},
    Needs{"haply", {}, nullptr, "calibrate it as the Inverse Service or the vendor's program tells"},
};

const Needs& needsOf(const std::string& spec) {
  makeDevice(spec);  // refuses what is none
  const std::string kind = spec.substr(0, spec.find(':'));
  static constexpr Needs kNothing{"", {}, nullptr, "calibrate it as its vendor tells"};
  const auto* const found = std::ranges::find_if(kNeeds, [&](const Needs& needs) { return kind == needs.kind; });
  return found == kNeeds.end() ? kNothing : *found;
}

std::string listOf(const std::vector<UsbDevice>& devices) {
  std::string list;
  for (const UsbDevice& one : devices) {
    list += (list.empty() ? "" : ", ") + textOf({one.vendor, one.product});
    if (!one.name.empty()) list += " " + one.name;
  }
  return list.empty() ? "nothing" : list;
}

std::string listOf(std::span<const UsbId> ids) {
  std::string list;
  for (const UsbId& id : ids) list += (list.empty() ? "" : " or ") + textOf(id);
  return list;
}

Finding examineUsb(std::span<const UsbId> wanted, const std::vector<UsbDevice>& usb) {
  std::vector<UsbDevice> seen;
  for (const UsbDevice& one : usb)
    if (std::ranges::any_of(wanted, [&](const UsbId& id) { return matches(id, one); })) seen.push_back(one);
  if (seen.empty()) {
    return {
        "usb", false, "expected " + listOf(wanted) + ", seen: " + listOf(usb),
        "check its power and its USB cable, try another port without a hub; a model with another id, or on Ethernet "
        "or FireWire, may work all the same"};
  }
  const auto barred = std::ranges::find_if(seen, [](const UsbDevice& one) { return !one.may_be_used; });
  if (barred == seen.end()) return {"usb", true, listOf(seen) + ", and this user may use it", ""};
  return {"usb", false, listOf(seen) + ", but this user may not use it",
          "as root write this line to /etc/udev/rules.d/70-hl.rules:\n  " +
              udevRuleFor({barred->vendor, barred->product}) +
              "\nthen run: udevadm control --reload && udevadm trigger, and plug the device in again"};
}

Finding examineLibrary(const VendorLibraryName& name) {
  try {
    return {"library", true, VendorLibrary(name).description(), ""};
  } catch (const Error& error) {
    const std::string text = error.what();
    const std::size_t end = text.find("; ");
    return {"library", false, text.substr(0, end), end == std::string::npos ? "" : text.substr(end + 2)};
  }
}

// Vendors' libraries that read numbers by the locale take a decimal point for the end of one where it has a comma.
Finding examineLocale() {
  const char* point = std::localeconv()->decimal_point;
  if (std::string(point) == ".") return {"locale", true, "numbers have a decimal point", ""};
  return {"locale", false, std::string("numbers have a '") + point + "' for a decimal point", "run it with LC_ALL=C"};
}

DeviceStatus statusWithin(Device& device, double patience_s) {
  const std::int64_t begin_ns = monotonicNow_ns();
  for (;;) {
    const std::int64_t now_ns = monotonicNow_ns();
    const DeviceStatus status = device.read(now_ns).status;
    if (status == DeviceStatus::kOk || seconds(now_ns - begin_ns) >= patience_s) return status;
    device.write(Vec3::Zero());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

Finding examineStatus(const Needs& needs, DeviceStatus status) {
  if (status == DeviceStatus::kOk) return {"ready", true, "calibrated, and tells where it is", ""};
  if (status == DeviceStatus::kNotReady) return {"ready", false, "it answers, but is not ready", needs.calibrate};
  return {"ready", false, "it has opened, but does not answer",
          "check its power and its cable; end every other program that uses it"};
}

}  // namespace

std::vector<Finding> examineSurroundings(const std::string& spec, const std::vector<UsbDevice>& usb) {
  const Needs& needs = needsOf(spec);
  std::vector<Finding> findings;
  if (!needs.usb.empty()) findings.push_back(examineUsb(needs.usb, usb));
  if (needs.library != nullptr) findings.push_back(examineLibrary(*needs.library));
  findings.push_back(examineLocale());
  return findings;
}

std::vector<Finding> examineOpening(const std::string& spec, Device& device, double patience_s) {
  try {
    device.open();
  } catch (const Error& error) {
    return {{"opening", false, error.what(), "see above; end every other program that uses it"}};
  }
  return {{"opening", true, device.info().name, ""}, examineStatus(needsOf(spec), statusWithin(device, patience_s))};
}

bool allGood(const std::vector<Finding>& findings) {
  return std::ranges::all_of(findings, [](const Finding& finding) { return finding.good; });
}

}  // namespace hl
