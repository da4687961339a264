// FalconTransport: the serial line to a Falcon, as its USB chip gives it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace hl {

/// How the line is set.
enum class FalconLine : std::uint8_t {
  kAsk,   ///< 9600 baud, the device restarted into its loader
  kLoad,  ///< 140 kbaud, for the firmware
  kRun    ///< 1.5 Mbaud, for frames
};

/// One thread at a time. Of several on one bus each transport has its own.
class FalconTransport {
 public:
  virtual ~FalconTransport() = default;
  /// Throws hl::Error with what to do when there is none.
  virtual void open() = 0;
  virtual void close() = 0;  ///< twice does no harm
  virtual bool set(FalconLine line) = 0;
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;
  /// What has come, after at most 50 ms; 0: nothing.
  virtual std::size_t read(std::span<std::uint8_t> bytes) = 0;
};

/// The Falcon that is number `index`, from 0, in the order of bus and ports. Opened once, it is looked for at its own
/// port first, and then among those that no other transport of this process has.
std::unique_ptr<FalconTransport> makeFalconUsb(std::size_t index = 0);
/// How many there are. Throws hl::Error when USB cannot be used.
std::size_t countFalcons();

}  // namespace hl
