#include "device/falcon/falcon_firmware.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/plain_file.h"

namespace hl {

namespace {

constexpr std::array<std::uint8_t, 3> kQuestion{0x0a, 0x43, 0x0d};
constexpr std::array<std::uint8_t, 4> kAnswer{0x0a, 0x44, 0x2c, 0x0d};
constexpr std::array<std::uint8_t, 1> kReady{'A'};
constexpr int kMaxQuestions = 100;
constexpr std::size_t kPiece = 62;  // one packet of the USB chip without its two bytes of status
constexpr std::size_t kMaxImage = std::size_t{1} << 20;

// Reads until `expected` has come; false when the device falls silent first.
bool expect(FalconTransport& transport, std::span<const std::uint8_t> expected) {
  std::vector<std::uint8_t> heard;
  std::array<std::uint8_t, 64> bytes{};
  while (heard.size() < expected.size() + bytes.size()) {
    const std::size_t count = transport.read(bytes);
    if (count == 0) return false;
    heard.insert(heard.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
    if (std::search(heard.begin(), heard.end(), expected.begin(), expected.end()) != heard.end()) return true;
  }
  return false;
}

bool findLoader(FalconTransport& transport) {
  if (!transport.set(FalconLine::kAsk)) return false;
  for (int i = 0; i < kMaxQuestions; ++i) {
    if (!transport.write(kQuestion)) return false;
    if (expect(transport, kAnswer)) return true;
  }
  return false;
}

}  // namespace

std::vector<std::uint8_t> readFalconFirmware(const std::string& file) {
  if (file.empty())
    throw Error(
        "this Falcon needs its firmware: name the file, falcon:FILE or HL_FALCON_FIRMWARE (Novint's drivers and "
        "libnifalcon have it)");
  const std::string firmware = contentOf(file).value_or("");
  if (firmware.empty() || firmware.size() > kMaxImage)
    throw Error(file + " is no firmware of a Falcon: it cannot be read, is empty or too large");
  return {firmware.begin(), firmware.end()};
}

bool loadFalconFirmware(FalconTransport& transport, const std::vector<std::uint8_t>& firmware) {
  if (!findLoader(transport) || !transport.set(FalconLine::kLoad)) return false;
  if (!transport.write(kReady) || !expect(transport, kReady)) return false;
  for (std::size_t at = 0; at < firmware.size(); at += kPiece) {
    const auto piece = std::span(firmware).subspan(at, std::min(kPiece, firmware.size() - at));
    if (!transport.write(piece) || !expect(transport, piece)) return false;
  }
  return transport.set(FalconLine::kRun);
}

}  // namespace hl
