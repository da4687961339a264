// Files of heights. The first byte chooses the form.
#include <array>
#include <optional>

#include "io/height_messages.h"
#include "io/read_heights.h"
#include "refusal.h"
#include "require.h"

namespace {

// Puts a field together, as the program does that asked for it; large ones are refused.
class Taker final : public hl::HeightSink {
 public:
  void header(const hl::HeightHeader& header) override { collector_.emplace(header, std::size_t{1} << 20); }
  void samples(const void* samples, std::size_t bytes) override { collector_->add(samples, bytes); }
  void warn(const std::string& line) override { hl::fuzz::require(line.find('\n') == std::string::npos); }
  void check() {
    const auto field = collector_->take();
    hl::fuzz::require(field->triangles() > 0 && !field->bounds().empty());
    hl::fuzz::require(field->bounds().min.allFinite() && field->bounds().max.allFinite());
  }

 private:
  std::optional<hl::HeightCollector> collector_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<const char*, 5> kEndings{".tif", ".hgt", ".asc", ".png", ".npy"};
  if (size == 0) return 0;
  const char* const ending = kEndings[data[0] % kEndings.size()];
  const std::string path = hl::fuzz::fileOf(std::string("N47E008") + ending, data + 1, size - 1);
  hl::fuzz::takes([&] {
    Taker taker;
    hl::readHeights({path, ending, true}, taker);
    taker.check();
  });
  return 0;
}
