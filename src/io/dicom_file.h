// DicomFile: what a DICOM file (NEMA PS3.3) says of the slices in it, and their samples, through GDCM.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/dicom_stack.h"

namespace hl {

struct DicomFile {
  std::string path;
  std::string series;       ///< SeriesInstanceUID; empty: it is no image
  std::string description;  ///< of the series, from the file as it is
  std::uint32_t columns = 0, rows = 0;
  std::size_t frames = 1;
  unsigned bits = 16, bytes = 2;  ///< of a sample; more bits than these mean something else
  bool is_signed = false;
  bool is_grey = false;            ///< one number a sample
  bool low_is_bright = false;      ///< MONOCHROME1
  std::vector<DicomSlice> slices;  ///< one for each frame; empty: it does not say where they lie
};

/// Whether it begins as DICOM files do, or has an ending of theirs.
bool looksLikeDicom(const std::string& path);

/// Everything but the samples. Throws hl::Error for a file that is no sound DICOM.
DicomFile readDicomHeader(const std::string& path);

/// The samples of all its frames, unpacked, in the byte order of this machine. Throws hl::Error.
std::vector<std::byte> readDicomSamples(const DicomFile& file);

}  // namespace hl
