// Binary messages of HL clients.
#include <cstddef>
#include <cstdint>

#include "read_frame.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hl::fuzz::readMessage(hl::MessageForm::kBinary, {reinterpret_cast<const char*>(data), size});
  return 0;
}
