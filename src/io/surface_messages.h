// Surfaces that are no meshes in messages, for recordings and for the process that reads foreign files. What several of
// them share, a volume or the points of a cloud, is written once.
#pragma once

#include <recording.pb.h>

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "io/cloud_messages.h"
#include "io/height_messages.h"
#include "io/volume_messages.h"

namespace hl {

/// Factors of the texture coordinates u and v; none are ones. Throws hl::Error for what makes no sense.
Vec2 repeatIn(const google::protobuf::RepeatedField<double>& factors);
void writeRepeat(const Vec2& repeat, google::protobuf::RepeatedField<double>& factors);

/// Takes the parts of surfaces. It may take their content away.
class SurfaceParts {
 public:
  virtual ~SurfaceParts() = default;
  virtual void take(proto::RecordedHeights& part) = 0;
  virtual void take(proto::RecordedVolume& part) = 0;
  virtual void take(proto::RecordedCloud& part) = 0;
  virtual void take(proto::RecordedImplicit& part) = 0;
};

/// One thread.
class SurfaceWriter {
 public:
  /// `id`: its own number, above 0. Throws hl::Error for a kind that is not known.
  void write(const PrimitiveSource& source, std::uint64_t id, SurfaceParts& out);

 private:
  template <typename Shared>
  struct First {
    std::shared_ptr<const Shared> kept;  // its address stays its own
    std::uint64_t id;                    // of the first surface that has it
  };
  std::map<const Volume*, First<Volume>> volumes_;
  std::map<const CloudPoints*, First<CloudPoints>> clouds_;
};

/// One thread. Parts of one surface follow each other. Everything throws hl::Error when a part makes no sense.
class SurfaceReader {
 public:
  using Source = std::shared_ptr<const PrimitiveSource>;

  /// `most_bytes`: memory that the samples and points of all surfaces may take together; of each one no more than the
  /// machine has.
  explicit SurfaceReader(std::size_t most_bytes = std::numeric_limits<std::size_t>::max()) : left_(most_bytes) {}

  /// The surface, when the part is its last one; null: more follow.
  Source add(const proto::RecordedHeights& part);
  Source add(const proto::RecordedVolume& part);
  Source add(const proto::RecordedCloud& part);
  Source add(const proto::RecordedImplicit& part);
  /// Whether parts of a surface are still to come.
  bool begun() const { return begun_.has_value(); }

 private:
  bool begin(std::uint64_t id);
  Source finish(Source source, bool shares);
  std::size_t mostBytes() const;

  std::size_t left_;                    // bytes
  std::optional<std::uint64_t> begun_;  // the surface of which more parts follow
  std::optional<HeightCollector> heights_;
  std::optional<VolumeCollector> volume_;
  std::optional<CloudCollector> cloud_;
  std::pair<GridFrame, CloudLook> cloud_look_;                                          // of the cloud that has begun
  std::tuple<GridFrame, IsoValue, std::shared_ptr<const MatterTable>> volume_surface_;  // of the volume that has begun
  std::map<std::uint64_t, std::shared_ptr<const Volume>> volumes_;                      // by the surface
  std::map<std::uint64_t, std::shared_ptr<const CloudPoints>> clouds_;                  // the same
};

}  // namespace hl
