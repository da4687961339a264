// Binary messages of HL clients.
#include <cstddef>
#include <cstdint>

#include "read_frame.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hl::proto::ClientMessage message;
  if (message.ParseFromArray(data, static_cast<int>(size))) hl::fuzz::readFrame(message);
  return 0;
}
