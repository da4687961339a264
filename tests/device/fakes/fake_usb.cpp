// A libusb-1.0.so.0 for tests: the functions of libusb that HL calls, with one Falcon on the bus, or two, and a
// mouse. Their firmware is the file that HL_FALCON_FIRMWARE names. What a baud rate is for shows how the line is set.
#include <libusb.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <thread>

#include "fake_script.h"
#include "falcon_line.h"

namespace {

using hl::FalconLine;

// The Falcon at port 1, and the one at port 2 of a hub at port 3.
struct Falcon {
  hl::test::FalconBox box;
  hl::test::FakeFalconLine line{box};
  hl::test::FakeScript script;

  explicit Falcon(std::size_t number) : script(box.arm, number) {
    const char* file = std::getenv("HL_FALCON_FIRMWARE");
    std::ifstream in(file != nullptr ? file : "", std::ios::binary);
    box.firmware.assign(std::istreambuf_iterator<char>(in), {});
  }
};

Falcon& falcon(std::size_t number) {
  static std::array<std::unique_ptr<Falcon>, hl::test::kFakeDevices> all;
  if (!all[number]) all[number] = std::make_unique<Falcon>(number);
  return *all[number];
}

// What libusb's pointers point to here: a place on the bus, the mouse behind the Falcons.
std::array<char, hl::test::kFakeDevices + 1> places;
std::array<char, 1> the_context;
std::size_t placeOf(const void* device) {
  return static_cast<std::size_t>(static_cast<const char*>(device) - places.data());
}
Falcon& falconOf(libusb_device_handle* device) { return falcon(placeOf(device)); }

constexpr std::uint16_t kVendor = 0x0403, kProduct = 0xcb48;
constexpr std::uint8_t kBaudRequest = 3;
constexpr unsigned char kOut = 0x02, kIn = 0x81;
constexpr std::array<unsigned char, 2> kLineStatus{0x01, 0x60};
constexpr auto kLatency = std::chrono::milliseconds(1);

FalconLine lineAt(std::uint16_t baud) {
  constexpr std::uint16_t k9600 = 0x4138, k140k = 0x15;
  if (baud == k9600) return FalconLine::kAsk;
  return baud == k140k ? FalconLine::kLoad : FalconLine::kRun;
}

}  // namespace

#define HL_EXPORT extern "C" __attribute__((visibility("default")))

HL_EXPORT int libusb_init(libusb_context** context) {
  *context = reinterpret_cast<libusb_context*>(the_context.data());
  return LIBUSB_SUCCESS;
}
HL_EXPORT void libusb_exit(libusb_context*) {}
// In no order that says anything.
HL_EXPORT ssize_t libusb_get_device_list(libusb_context*, libusb_device*** list) {
  const std::size_t falcons = hl::test::fakeDevicesAtFirst();
  *list = new libusb_device*[falcons + 1];
  (*list)[0] = reinterpret_cast<libusb_device*>(&places[hl::test::kFakeDevices]);
  for (std::size_t i = 0; i < falcons; ++i) (*list)[falcons - i] = reinterpret_cast<libusb_device*>(&places[i]);
  return static_cast<ssize_t>(falcons + 1);
}
HL_EXPORT void libusb_free_device_list(libusb_device** list, int) { delete[] list; }
HL_EXPORT int libusb_get_device_descriptor(libusb_device* device, libusb_device_descriptor* about) {
  const bool is_falcon = placeOf(device) < hl::test::kFakeDevices;
  about->idVendor = is_falcon ? kVendor : 0x046d;
  about->idProduct = is_falcon ? kProduct : 0xc077;
  return LIBUSB_SUCCESS;
}
HL_EXPORT uint8_t libusb_get_bus_number(libusb_device*) { return 1; }
HL_EXPORT int libusb_get_port_numbers(libusb_device* device, uint8_t* ports, int) {
  const std::size_t place = placeOf(device);
  ports[0] = place == 0 ? 1 : 3;
  ports[1] = 2;
  return place == 0 ? 1 : 2;
}
HL_EXPORT int libusb_open(libusb_device* device, libusb_device_handle** handle) {
  *handle = reinterpret_cast<libusb_device_handle*>(device);
  falconOf(*handle).line.open();
  return LIBUSB_SUCCESS;
}
HL_EXPORT int libusb_claim_interface(libusb_device_handle*, int) { return LIBUSB_SUCCESS; }
HL_EXPORT void libusb_close(libusb_device_handle* handle) {
  falconOf(handle).line.close();
  falconOf(handle).script.closed();
}
HL_EXPORT int libusb_control_transfer(libusb_device_handle* handle, uint8_t, uint8_t request, uint16_t value, uint16_t,
                                      unsigned char*, uint16_t, unsigned int) {
  return request != kBaudRequest || falconOf(handle).line.set(lineAt(value)) ? LIBUSB_SUCCESS : LIBUSB_ERROR_IO;
}
HL_EXPORT int libusb_bulk_transfer(libusb_device_handle* handle, unsigned char endpoint, unsigned char* data,
                                   int length, int* done, unsigned int) {
  const auto size = static_cast<std::size_t>(length);
  if (endpoint == kOut) {
    *done = length;
    if (!falconOf(handle).line.write({data, size})) return LIBUSB_ERROR_NO_DEVICE;
    if (falconOf(handle).box.running) falconOf(handle).script.pulled();
    return LIBUSB_SUCCESS;
  }
  if (endpoint != kIn || size < kLineStatus.size()) return LIBUSB_ERROR_INVALID_PARAM;
  std::ranges::copy(kLineStatus, data);
  const std::size_t came = falconOf(handle).line.read({data + kLineStatus.size(), size - kLineStatus.size()});
  if (came == 0) std::this_thread::sleep_for(kLatency);
  *done = static_cast<int>(kLineStatus.size() + came);
  return LIBUSB_SUCCESS;
}
