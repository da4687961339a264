// Samples: a list of numbers of one kind, as a file or a sensor gives them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>

namespace hl {

enum class SampleKind : std::uint8_t { kInt16, kUint16, kFloat32 };

/// "int16", "uint16" or "float32".
const char* nameOf(SampleKind kind);
/// Bytes of a sample.
std::size_t sizeOf(SampleKind kind);

/// Immutable; read by any thread.
class Samples {
 public:
  /// `data` has sizeOf(kind) bytes a sample, aligned as its kind; it is shared, not copied. `missing`: the value that
  /// stands for "no sample"; what is not finite always does.
  Samples(SampleKind kind, std::shared_ptr<const void> data, std::optional<double> missing = {});

  SampleKind kind() const { return kind_; }
  std::optional<double> missing() const { return missing_; }
  const void* data() const { return data_.get(); }
  /// Calls use(samples) with all of them as they are stored: a pointer to numbers of their kind. RT-safe.
  template <typename Use>
  auto as(const Use& use) const {
    switch (kind_) {
      case SampleKind::kInt16:
        return use(static_cast<const std::int16_t*>(data_.get()));
      case SampleKind::kUint16:
        return use(static_cast<const std::uint16_t*>(data_.get()));
      case SampleKind::kFloat32:
        break;
    }
    return use(static_cast<const float*>(data_.get()));
  }
  /// Not a number where it is missing. RT-safe.
  double operator[](std::size_t place) const {
    return as([&](const auto* samples) { return number(samples[place]); });
  }
  /// Of a sample as it is stored. RT-safe.
  template <typename Sample>
  double number(Sample sample) const {
    const double value = sample;
    const bool missing = value == missing_value_ || (std::is_floating_point_v<Sample> && std::isinf(value));
    return missing ? std::numeric_limits<double>::quiet_NaN() : value;
  }

 private:
  SampleKind kind_;
  std::shared_ptr<const void> data_;
  std::optional<double> missing_;
  double missing_value_;  // equal to no sample if none stands for "missing"
};

}  // namespace hl
