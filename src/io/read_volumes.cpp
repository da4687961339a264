#include "io/read_volumes.h"

#include <array>
#include <string_view>
#include <utility>

namespace hl {

namespace {

using ReadVolume = void (*)(const ModelFile&, VolumeSink&);
constexpr std::array<std::pair<std::string_view, ReadVolume>, 7> kVolumeReaders{{{".nii", readNifti},
                                                                                 {".nii.gz", readNifti},
                                                                                 {".nrrd", readNrrd},
                                                                                 {".nhdr", readNrrd},
                                                                                 {".dcm", readDicom},
                                                                                 {".dicom", readDicom},
                                                                                 {".ima", readDicom}}};

ReadVolume volumeReaderOf(const std::string& ending) {
  for (const auto& [of, read] : kVolumeReaders) {
    if (of == ending) return read;
  }
  return nullptr;
}

}  // namespace

bool readsVolumes(const std::string& ending) { return volumeReaderOf(ending) != nullptr; }

void readVolume(const ModelFile& file, VolumeSink& sink) {
  const ReadVolume read = volumeReaderOf(file.ending);
  (read == nullptr ? readDicom : read)(file, sink);
}

}  // namespace hl
