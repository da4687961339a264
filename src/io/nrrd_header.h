// The header of a NRRD file, https://teem.sourceforge.net/nrrd/format.html: lines of "field: value".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "io/byte_file.h"
#include "io/volume_numbers.h"

namespace hl {

/// Fields as they are in the file; texts in lower case but for names. What a file must have is there.
struct NrrdHeader {
  NumberType type = NumberType::kInt16;
  std::string encoding;
  std::optional<bool> big_endian;
  std::vector<double> sizes;       ///< of every axis, the fastest first
  std::vector<std::string> kinds;  ///< of every axis, or empty
  std::string space;               ///< empty: the file names none
  std::vector<std::optional<Vec3>>
      directions;                            ///< of every axis, in units of the file, or empty; none: no axis of space
  std::vector<double> spacings;              ///< of every axis, in units of the file, or empty; not a number: not known
  std::vector<double> axis_mins, axis_maxs;  ///< as spacings
  std::vector<std::string> centerings;       ///< of every axis, or empty
  std::string unit;                          ///< of the first axis; empty: the file names none
  std::string data_file;                     ///< empty: the samples follow the header
  double line_skip = 0, byte_skip = 0;
};

/// Reads up to the end of the header. Throws hl::Error.
NrrdHeader readNrrdHeader(ByteFile& in);

}  // namespace hl
