// Recordings: run again, and played as a device. An even first byte: the rest is the file. Else the rest is blocks,
// each after its length in two bytes, and the file is made of them with sound checksums.
#include <cstring>

#include "record/recording_file.h"
#include "record/replay.h"
#include "record/replay_device.h"
#include "refusal.h"

namespace {

std::string fileOfBlocks(const std::uint8_t* data, std::size_t size) {
  const std::string path = hl::test::tempFile("a.hlr");
  hl::RecordingWriter writer(path);
  hl::proto::RecordingBlock block;
  for (std::uint16_t length = 0; size >= sizeof length;) {
    std::memcpy(&length, data, sizeof length);
    data += sizeof length;
    size -= sizeof length;
    const std::size_t taken = std::min<std::size_t>(length, size);
    if (!block.ParseFromArray(data, static_cast<int>(taken)) || block.ByteSizeLong() == 0) break;
    writer.write(block);
    data += taken;
    size -= taken;
  }
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string path =
      data[0] % 2 == 0 ? hl::fuzz::fileOf("a.hlr", data + 1, size - 1) : fileOfBlocks(data + 1, size - 1);
  hl::fuzz::takes([&] { hl::replay(path); });
  hl::fuzz::takes([&] {
    const auto device = hl::openAnyDevice("replay:" + path);
    for (std::int64_t now_ns : {0LL, 1'000'000LL, 1'000'000'000'000LL})
      hl::fuzz::require(device->read(now_ns).position.allFinite());
  });
  return 0;
}
