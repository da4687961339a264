// The Falcon's USB chip (FTDI 0403:cb48) through libusb: its requests are vendor's control transfers, its data two bulk
// endpoints; the first two bytes of each packet that comes in are the line's status.
#include <libusb.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "device/falcon/falcon_transport.h"

namespace hl {

namespace {

constexpr std::uint16_t kVendor = 0x0403, kProduct = 0xcb48;
constexpr unsigned char kOut = 0x02, kIn = 0x81;
constexpr std::uint8_t kRequestType = 0x40;
constexpr std::uint8_t kReset = 0, kModem = 1, kFlow = 2, kBaud = 3, kData = 4, kLatency = 9;
constexpr std::uint16_t kPurgeIn = 1, kPurgeOut = 2;
constexpr std::uint16_t kRtsLow = 0x200, kDtrLow = 0x100, kDtrHigh = 0x101, k8Bits = 8;
constexpr std::uint16_t kBaud9600 = 0x4138, kBaud140k = 0x15, kBaud1500k = 0x2;
constexpr std::size_t kStatusBytes = 2, kPacket = 64;
constexpr unsigned int kPatience_ms = 1000, kReadPatience_ms = 50;
constexpr int kEmptyPackets = 50;  // the chip sends its status alone when nothing has come, once in its latency

class FalconUsb final : public FalconTransport {
 public:
  ~FalconUsb() override { end(); }

  void open() override {
    end();
    if (libusb_init(&context_) != 0) throw Error("libusb cannot be used on this machine");
    device_ = libusb_open_device_with_vid_pid(context_, kVendor, kProduct);
    if (device_ == nullptr || libusb_claim_interface(device_, 0) != 0) {
      end();
      throw Error("no Falcon answers: check its power and USB cable, and that you may use USB device 0403:cb48 (udev)");
    }
  }

  void close() override { end(); }

  bool set(FalconLine line) override {
    switch (line) {
      case FalconLine::kAsk:
        return purge() && request(kLatency, 16) && request(kBaud, kBaud9600) && request(kData, k8Bits) &&
               request(kFlow, 0) && request(kModem, kRtsLow) && request(kModem, kDtrLow) && request(kModem, kDtrHigh);
      case FalconLine::kLoad:
        return request(kModem, kDtrLow) && request(kBaud, kBaud140k);
      case FalconLine::kRun:
        return request(kLatency, 1) && request(kBaud, kBaud1500k) && purge();
    }
    return false;
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    int sent = 0;
    auto* data = const_cast<std::uint8_t*>(bytes.data());  // libusb only reads it
    const int size = static_cast<int>(bytes.size());
    return device_ != nullptr && libusb_bulk_transfer(device_, kOut, data, size, &sent, kPatience_ms) == 0 &&
           sent == size;
  }

  std::size_t read(std::span<std::uint8_t> bytes) override {
    for (int i = 0; i < kEmptyPackets && device_ != nullptr; ++i) {
      std::array<std::uint8_t, kPacket> packet{};
      int came = 0;
      if (libusb_bulk_transfer(device_, kIn, packet.data(), kPacket, &came, kReadPatience_ms) != 0) return 0;
      if (static_cast<std::size_t>(came) <= kStatusBytes) continue;
      const std::size_t count = std::min(static_cast<std::size_t>(came) - kStatusBytes, bytes.size());
      std::copy_n(packet.begin() + kStatusBytes, count, bytes.begin());
      return count;
    }
    return 0;
  }

 private:
  bool request(std::uint8_t what, std::uint16_t value) {
    return device_ != nullptr &&
           libusb_control_transfer(device_, kRequestType, what, value, 0, nullptr, 0, kPatience_ms) == 0;
  }
  bool purge() { return request(kReset, kPurgeIn) && request(kReset, kPurgeOut); }
  void end() {
    if (device_ != nullptr) libusb_close(device_);  // releases the interface too
    device_ = nullptr;
    if (context_ != nullptr) libusb_exit(context_);
    context_ = nullptr;
  }

  libusb_context* context_ = nullptr;
  libusb_device_handle* device_ = nullptr;
};

}  // namespace

std::unique_ptr<FalconTransport> makeFalconUsb() { return std::make_unique<FalconUsb>(); }

}  // namespace hl
