// A libusb-1.0.so.0 for tests: the functions of libusb that HL calls, with one Falcon on the bus. Its firmware is the
// file that HL_FALCON_FIRMWARE names. What a baud rate is for tells how the line is set.
#include <libusb.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include "fake_script.h"
#include "falcon_line.h"

namespace {

using hl::FalconLine;

struct Bus {
  hl::test::FalconBox box;
  hl::test::FakeFalconLine line{box};
  hl::test::FakeScript script{box.arm};

  Bus() {
    const char* file = std::getenv("HL_FALCON_FIRMWARE");
    std::ifstream in(file != nullptr ? file : "", std::ios::binary);
    box.firmware.assign(std::istreambuf_iterator<char>(in), {});
  }
};

Bus& bus() {
  static Bus the_bus;
  return the_bus;
}

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
  *context = reinterpret_cast<libusb_context*>(&bus());
  return LIBUSB_SUCCESS;
}
HL_EXPORT void libusb_exit(libusb_context*) {}
HL_EXPORT libusb_device_handle* libusb_open_device_with_vid_pid(libusb_context* context, uint16_t vendor,
                                                                uint16_t product) {
  if (vendor != kVendor || product != kProduct) return nullptr;
  bus().line.open();
  return reinterpret_cast<libusb_device_handle*>(context);
}
HL_EXPORT int libusb_claim_interface(libusb_device_handle*, int) { return LIBUSB_SUCCESS; }
HL_EXPORT void libusb_close(libusb_device_handle*) {
  bus().line.close();
  bus().script.closed();
}
HL_EXPORT int libusb_control_transfer(libusb_device_handle*, uint8_t, uint8_t request, uint16_t value, uint16_t,
                                      unsigned char*, uint16_t, unsigned int) {
  return request != kBaudRequest || bus().line.set(lineAt(value)) ? LIBUSB_SUCCESS : LIBUSB_ERROR_IO;
}
HL_EXPORT int libusb_bulk_transfer(libusb_device_handle*, unsigned char endpoint, unsigned char* data, int length,
                                   int* done, unsigned int) {
  const auto size = static_cast<std::size_t>(length);
  if (endpoint == kOut) {
    *done = length;
    if (!bus().line.write({data, size})) return LIBUSB_ERROR_NO_DEVICE;
    if (bus().box.running) bus().script.pulled();
    return LIBUSB_SUCCESS;
  }
  if (endpoint != kIn || size < kLineStatus.size()) return LIBUSB_ERROR_INVALID_PARAM;
  std::ranges::copy(kLineStatus, data);
  const std::size_t came = bus().line.read({data + kLineStatus.size(), size - kLineStatus.size()});
  if (came == 0) std::this_thread::sleep_for(kLatency);
  *done = static_cast<int>(kLineStatus.size() + came);
  return LIBUSB_SUCCESS;
}
