// The Falcon's USB chip (FTDI 0403:cb48) through libusb: its requests are vendor's control transfers, its data two bulk
// endpoints; the first two bytes of each packet that comes in are the line's status.
#include <libusb.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "device/device_claim.h"
#include "device/falcon/falcon_transport.h"

namespace hl {

namespace {

constexpr std::uint16_t kVendor = 0x0403, kProduct = 0xcb48;
constexpr unsigned char kOut = 0x02, kIn = 0x81;
constexpr std::uint8_t kRequestType = 0x40;
constexpr std::uint8_t kResetLine = 0, kModem = 1, kFlow = 2, kBaud = 3, kData = 4, kLatency = 9;
constexpr std::uint16_t kPurgeIn = 1, kPurgeOut = 2;
constexpr std::uint16_t kRtsLow = 0x200, kDtrLow = 0x100, kDtrHigh = 0x101, k8Bits = 8;
constexpr std::uint16_t kBaud9600 = 0x4138, kBaud140k = 0x15, kBaud1500k = 0x2;
constexpr std::size_t kStatusBytes = 2, kPacket = 64;
constexpr unsigned int kPatience_ms = 1000, kReadPatience_ms = 50;
constexpr const char* kNotThere =
    " answers: check its power and USB cable, and that you may use USB device 0403:cb48 (udev)";
constexpr int kEmptyPackets = 50;  // the chip sends its status alone when nothing has come, once in its latency

// libusb for one transport: each has a context of its own, so that none waits for another.
class UsbContext {
 public:
  UsbContext() {
    if (libusb_init(&context_) != 0) throw Error("libusb cannot be used on this machine");
  }
  ~UsbContext() { libusb_exit(context_); }
  UsbContext(const UsbContext&) = delete;
  UsbContext& operator=(const UsbContext&) = delete;
  libusb_context* get() const { return context_; }

 private:
  libusb_context* context_ = nullptr;
};

// The Falcons on the bus while this lives, in the order of bus and ports.
class FalconsOnBus {
 public:
  explicit FalconsOnBus(libusb_context* context) {
    const ssize_t count = libusb_get_device_list(context, &all_);
    for (ssize_t i = 0; i < count; ++i) {
      libusb_device_descriptor about{};
      if (libusb_get_device_descriptor(all_[i], &about) != 0) continue;
      if (about.idVendor == kVendor && about.idProduct == kProduct) found_.emplace_back(portOf(all_[i]), all_[i]);
    }
    std::ranges::sort(found_, {}, &Falcon::first);
  }
  ~FalconsOnBus() {
    if (all_ != nullptr) libusb_free_device_list(all_, 1);
  }
  FalconsOnBus(const FalconsOnBus&) = delete;
  FalconsOnBus& operator=(const FalconsOnBus&) = delete;

  using Falcon = std::pair<std::string, libusb_device*>;  // where it is plugged in
  const std::vector<Falcon>& found() const { return found_; }

 private:
  // Two digits for each: as text it is in the order of the numbers.
  static std::string portOf(libusb_device* device) {
    constexpr std::size_t kDeepest = 7;  // hubs behind one another, as USB 3 allows
    std::array<std::uint8_t, kDeepest> ports{};
    const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
    const auto two_digits = [](unsigned number) { return (number < 10 ? "0" : "") + std::to_string(number); };
    std::string port = two_digits(libusb_get_bus_number(device));
    for (int i = 0; i < depth; ++i) port += (i == 0 ? "-" : ".") + two_digits(ports[static_cast<std::size_t>(i)]);
    return port;
  }

  libusb_device** all_ = nullptr;
  std::vector<Falcon> found_;
};

class FalconUsb final : public FalconTransport {
 public:
  explicit FalconUsb(std::size_t index) : index_(index) {}
  ~FalconUsb() override { end(); }

  void open() override {
    end();
    context_ = std::make_unique<UsbContext>();
    const FalconsOnBus bus(context_->get());
    const FalconsOnBus::Falcon& chosen = choose(bus.found());
    const std::string key = "falcon at USB port " + chosen.first;
    if (claim_.key() != key) claim_ = DeviceClaim(key);
    if (libusb_open(chosen.second, &device_) != 0 || libusb_claim_interface(device_, 0) != 0) {
      end();
      throw Error("no Falcon at USB port " + chosen.first + kNotThere);
    }
    port_ = chosen.first;
  }

  // Its port stays its own: it comes back there.
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
  const FalconsOnBus::Falcon& choose(const std::vector<FalconsOnBus::Falcon>& found) const {
    if (found.empty()) throw Error(std::string("no Falcon") + kNotThere);
    if (port_.empty()) {
      if (index_ < found.size()) return found[index_];
      throw Error("there is no falcon:" + std::to_string(index_) + ": of Falcons there are " +
                  std::to_string(found.size()) + " on USB, counted from 0");
    }
    const auto here = std::ranges::find(found, port_, &FalconsOnBus::Falcon::first);
    if (here != found.end()) return *here;
    const auto is_free = [](const auto& one) { return !DeviceClaim::isTaken("falcon at USB port " + one.first); };
    const auto free = std::ranges::find_if(found, is_free);
    if (free == found.end()) throw Error("no Falcon at USB port " + port_ + kNotThere);
    return *free;
  }

  bool request(std::uint8_t what, std::uint16_t value) {
    return device_ != nullptr &&
           libusb_control_transfer(device_, kRequestType, what, value, 0, nullptr, 0, kPatience_ms) == 0;
  }
  bool purge() { return request(kResetLine, kPurgeIn) && request(kResetLine, kPurgeOut); }
  void end() {
    if (device_ != nullptr) libusb_close(device_);  // releases the interface too
    device_ = nullptr;
    context_.reset();
  }

  const std::size_t index_;
  std::string port_;   // where it was opened; empty: never yet
  DeviceClaim claim_;  // from the first opening to the end of this transport
  std::unique_ptr<UsbContext> context_;
  libusb_device_handle* device_ = nullptr;
};

}  // namespace

std::unique_ptr<FalconTransport> makeFalconUsb(std::size_t index) { return std::make_unique<FalconUsb>(index); }

std::size_t countFalcons() {
  const UsbContext context;
  return FalconsOnBus(context.get()).found().size();
}

}  // namespace hl
