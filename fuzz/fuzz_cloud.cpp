// Files of points. The first byte chooses LAS, PCD, PLY or text.
#include "io/read_clouds.h"
#include "refusal.h"

namespace {

// What the program does that takes them: a header, then points on its lattice or positions, with normals and
// colours for all or none.
class CheckingSink final : public hl::CloudSink {
 public:
  void header(const hl::CloudHeader& header) override {
    hl::fuzz::require(!announced_);
    announced_ = true;
    lattice_ = header.lattice.has_value();
    hl::fuzz::require(header.turn.allFinite());
    if (lattice_) hl::fuzz::require(header.lattice->step.minCoeff() > 0 && header.lattice->origin.allFinite());
  }
  void points(const hl::CloudPiece& piece) override {
    const std::size_t count = piece.steps.size() + piece.positions.size();
    hl::fuzz::require(announced_ && count > 0 && (lattice_ ? piece.positions.empty() : piece.steps.empty()));
    hl::fuzz::require(piece.normals.empty() || piece.normals.size() == count);
    hl::fuzz::require(piece.colours.empty() || piece.colours.size() == count);
    for (const hl::Vec3& p : piece.positions) hl::fuzz::require(p.allFinite());
  }
  void warn(const std::string& line) override {
    hl::fuzz::require(!line.empty() && line.find('\n') == std::string::npos);
  }
  bool announced() const { return announced_; }

 private:
  bool announced_ = false, lattice_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kEndings[] = {".las", ".pcd", ".ply", ".xyz"};
  if (size == 0) return 0;
  const std::string ending = kEndings[data[0] % 4];
  const std::string path = hl::fuzz::fileOf("a" + ending, data + 1, size - 1);
  if (ending == ".ply" && !hl::isPlyOfPoints(path)) return 0;
  CheckingSink sink;
  const bool taken = hl::fuzz::takes([&] { hl::readCloud({path, ending, true}, sink); });
  hl::fuzz::require(!taken || sink.announced());
  return 0;
}
