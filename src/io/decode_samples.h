// Samples of grids in messages of proto/hl.proto: Heights and Volume name them alike.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "surfaces/grid_frame.h"
#include "surfaces/sample_room.h"
#include "surfaces/samples.h"

namespace hl {

/// Bytes that the message has, whatever it says of its size.
template <typename Message>
std::uint64_t bytesOfSamples(const Message& in) {
  std::uint64_t bytes = sizeof(float) * static_cast<std::uint64_t>(in.values_size());
  for (const std::string& piece : in.samples()) bytes += piece.size();
  return bytes;
}

/// Throws hl::Error for another name.
template <typename Message>
SampleKind kindOf(const Message& in) {
  if (in.kind().empty()) return SampleKind::kFloat32;
  for (const SampleKind kind : {SampleKind::kInt16, SampleKind::kUint16, SampleKind::kFloat32}) {
    if (in.kind() == nameOf(kind)) return kind;
  }
  throw Error("kind must be int16, uint16 or float32");
}

/// Throws hl::Error for infinity.
template <typename Message>
std::optional<double> missingOf(const Message& in) {
  if (!in.has_missing()) return {};
  if (std::isinf(in.missing())) throw Error("missing must be a finite number");
  return in.missing();
}

/// Exactly `bytes` of them, else throws hl::Error; before it takes memory for more than the message has.
template <typename Message>
std::shared_ptr<const void> samplesOf(const Message& in, std::uint64_t bytes) {
  if (bytes > bytesOfSamples(in)) throw Error("it has fewer samples than it says");
  if (in.values_size() > 0 && (in.samples_size() > 0 || !in.kind().empty()))
    throw Error("it has values or samples of a kind, not both");
  SampleRoom samples(bytes);
  if (in.values_size() > 0) samples.add(in.values().data(), sizeof(float) * static_cast<std::size_t>(in.values_size()));
  for (const std::string& piece : in.samples()) samples.add(piece.data(), piece.size());
  return samples.take();
}

/// A length or a factor that is given, or what stands for one that is left out, which reads as 0. Throws hl::Error.
inline double lengthOf(double given, double otherwise, const char* name) {
  if (given == 0) return otherwise;
  if (!(given >= kMinGridStep && given <= kMaxGridStep)) throw Error(std::string(name) + " must be from 1e-12 to 1e9");
  return given;
}

}  // namespace hl
