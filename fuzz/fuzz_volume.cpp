// Files of volumes. The first byte chooses NIfTI or NRRD; both may be packed.
#include "io/read_volumes.h"
#include "refusal.h"

namespace {

// What the program does that takes them: refuses what is too large, and takes no more than was announced.
class CountingSink final : public hl::VolumeSink {
 public:
  void header(const hl::VolumeHeader& header) override {
    hl::fuzz::require(left_ == 0 && !announced_);
    announced_ = true;
    for (const std::uint32_t side : header.side) hl::fuzz::require(side >= 2);
    left_ = hl::sizeOf(header.kind) * header.side[0] * header.side[1] * header.side[2];
    hl::fuzz::require(header.frame.axes.allFinite() && header.frame.origin.allFinite());
    constexpr std::size_t kMax = 1 << 24;
    if (left_ > kMax) throw hl::Error("is too large");
  }
  void samples(const void* samples, std::size_t bytes) override {
    hl::fuzz::require(announced_ && samples != nullptr && bytes <= left_);
    left_ -= bytes;
  }
  void warn(const std::string& line) override {
    hl::fuzz::require(!line.empty() && line.find('\n') == std::string::npos);
  }
  bool whole() const { return announced_ && left_ == 0; }

 private:
  bool announced_ = false;
  std::size_t left_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string ending = data[0] % 2 == 0 ? ".nii" : ".nrrd";
  const std::string path = hl::fuzz::fileOf("a" + ending, data + 1, size - 1);
  CountingSink sink;
  const bool taken = hl::fuzz::takes([&] { hl::readVolume({path, ending, true}, sink); });
  hl::fuzz::require(!taken || sink.whole());
  return 0;
}
