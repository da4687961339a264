#include "device/falcon/falcon_protocol.h"

namespace hl {

namespace {

constexpr std::uint8_t kBegin = '<', kEnd = '>', kZero = 0x41;
constexpr std::size_t kState = 13;  // of the byte with lamps and homing, or buttons and homing

std::int16_t number(const std::uint8_t* nibbles) {
  unsigned value = 0;
  for (unsigned i = 0; i < 4; ++i) value |= ((nibbles[i] - kZero) & 0xFU) << (4 * i);
  return static_cast<std::int16_t>(value);
}

}  // namespace

FalconFrame encode(const FalconCommand& command) {
  FalconFrame frame;
  frame.fill(kZero);
  frame.front() = kBegin;
  frame.back() = kEnd;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const auto value = static_cast<std::uint16_t>(command.motors[leg]);
    for (unsigned i = 0; i < 4; ++i)
      frame[1 + 4 * leg + i] = static_cast<std::uint8_t>(kZero + (value >> (4 * i) & 0xFU));
  }
  if (command.home) frame[kState] = kZero + 1;  // its other bits are lamps
  return frame;
}

bool decode(std::span<const std::uint8_t> bytes, FalconReply& reply) {
  constexpr std::size_t kSize = std::tuple_size_v<FalconFrame>;
  for (std::size_t end = bytes.size(); end >= kSize; --end) {
    const std::uint8_t* frame = bytes.data() + end - kSize;
    if (frame[0] != kBegin || frame[kSize - 1] != kEnd) continue;
    for (std::size_t leg = 0; leg < 3; ++leg) reply.encoders[leg] = number(frame + 1 + 4 * leg);
    const auto state = static_cast<std::uint8_t>(frame[kState] - kZero);
    reply.buttons = state & 0xFU;
    reply.homed = state >> 4 & kFalconAllHomed;
    return true;
  }
  return false;
}

}  // namespace hl
