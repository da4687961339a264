// States of Haply's Inverse Service, in both of its dialects.
#include "device/haply/haply_messages.h"
#include "refusal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = hl::fuzz::textOf(data, size);
  hl::HaplyState state;
  hl::fuzz::takes([&] {
    if (!hl::readHaplyMessage(text, state)) return;
    for (const hl::HaplyDialect dialect : {hl::HaplyDialect::kValues, hl::HaplyDialect::kVector})
      hl::haplyForceMessage(state.device_id, dialect, {1, 2, 3}, true);
  });
  hl::haplyDialectOf(text);
  return 0;
}
