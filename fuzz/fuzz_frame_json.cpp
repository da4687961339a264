// Text messages of HL clients: the JSON form.
#include <cstddef>
#include <cstdint>

#include "read_frame.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hl::fuzz::readMessage(hl::MessageForm::kJson, {reinterpret_cast<const char*>(data), size});
  return 0;
}
