// Finger paths, P.csv.
#include "io/csv_path.h"
#include "refusal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hl::fuzz::takes([&] {
    double before = 0;
    bool first = true;
    for (const hl::PathSample& sample : hl::readPath(hl::fuzz::fileOf("p.csv", data, size))) {
      hl::fuzz::require(sample.position.allFinite() && (first || sample.t > before));
      before = sample.t;
      first = false;
    }
  });
  return 0;
}
