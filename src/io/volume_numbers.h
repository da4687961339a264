// The types of numbers that files of volumes have, and what they are kept as.
#pragma once

#include <cstddef>
#include <cstdint>

#include "io/byte_file.h"
#include "io/volume_sink.h"

namespace hl {

enum class NumberType : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// How numbers lie in a file.
struct NumberForm {
  NumberType type = NumberType::kInt16;
  bool swap = false;  ///< the bytes of each are in the other order than here
};

std::size_t sizeOf(NumberType type);
/// Whether a number of this type may be that: integers of their range, or anything.
bool canBe(NumberType type, double value);
/// No number of 16 bits or of float32 changes by it.
SampleKind keptAs(NumberType type);

/// The next `count` numbers of the file as samples of keptAs(). Warns where that rounds some.
void copyNumbers(ByteFile& in, const NumberForm& form, std::uint64_t count, VolumeSink& sink);

}  // namespace hl
