#include "io/read_volumes.h"
namespace hl {
bool readsVolumes(const std::string&) { return false; }
void readVolume(const ModelFile&, VolumeSink&) {}
}  // namespace hl
