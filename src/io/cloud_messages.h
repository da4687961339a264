// Clouds in messages, for recordings and for the process that reads foreign files. Points come in parts.
#pragma once

#include <recording.pb.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/cloud_sink.h"
#include "surfaces/cloud_maker.h"
#include "surfaces/point_cloud.h"

namespace hl {

void toProto(const CloudHeader& header, proto::RecordedCloud& out);
void toProto(const CloudPiece& piece, proto::RecordedCloud& out);

/// Throw hl::Error for what makes no sense.
GridFrame frameOf(const proto::RecordedCloud& in);
CloudLook lookOf(const proto::RecordedCloud& in);
/// Of a file that is read: from its axes to those of the scene.
Mat3 turnOf(const proto::RecordedCloud& in);

/// Calls `take` with each part. `like`: the number of a cloud of the same points that was written before; 0: there is
/// none.
void writeCloud(const PointCloud& cloud, std::uint64_t like,
                const std::function<void(proto::RecordedCloud& part)>& take);

/// Puts the points of a cloud together.
class CloudCollector {
 public:
  /// Points that were in a cloud before come back to the bit. Throws hl::Error for a lattice that makes no sense.
  CloudCollector(const proto::RecordedCloud& header, std::size_t most_bytes, bool made_before);
  /// Throws hl::Error for points that make no sense, or take more memory than may be.
  void add(const proto::RecordedCloud& part);
  /// Once. Throws hl::Error if there are none.
  std::shared_ptr<const CloudPoints> take();

 private:
  void takeRoom(std::size_t points, bool coloured);

  CloudInput input_;
  bool on_lattice_;
  std::vector<Vec3> positions_;
  std::vector<std::uint32_t> normals_;  // of the positions
  std::vector<Rgb> colours_;            // of the positions
  std::size_t left_bytes_;
};

/// A cloud as it comes from a file: with the middle at the origin if it lies far from there. Then `note` says where it
/// was.
std::shared_ptr<const PointCloud> cloudOfFile(const std::shared_ptr<const CloudPoints>& points, const Mat3& turn,
                                              std::string& note);

}  // namespace hl
