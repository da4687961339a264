// CloudSink: takes what a reader of clouds finds, so that no reader holds a whole cloud.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "surfaces/cloud_points.h"

namespace hl {

/// All of a cloud but its points.
struct CloudHeader {
  std::optional<CloudLattice> lattice{};  ///< then points are steps of it, else positions
  Mat3 turn = Mat3::Identity();           ///< from the file's axes to those of the scene
};

/// Some points: their steps or positions (m), and a packed normal and a colour for each, or none for all of the cloud.
struct CloudPiece {
  std::span<const std::array<std::int32_t, 3>> steps{};
  std::span<const Vec3> positions{};
  std::span<const std::uint32_t> normals{};
  std::span<const Rgb> colours{};
};

/// Called in this order: a header, and all points. Each may throw.
class CloudSink {
 public:
  virtual ~CloudSink() = default;
  virtual void header(const CloudHeader& header) = 0;
  virtual void points(const CloudPiece& piece) = 0;
  /// What a user should know, at any time.
  virtual void warn(const std::string& line) = 0;
};

}  // namespace hl
