// A scene on its way through a pipe, in the messages of proto/reading.proto. The sender is not trusted: what comes is
// bounded before memory is taken for it, and checked as a recording is.
#pragma once

#include <reading.pb.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "io/model_messages.h"
#include "io/surface_messages.h"
#include "scene/scene_model.h"

namespace hl {

/// The longest message: an image of 64 million texels, which are 4 bytes each, and what goes with it.
inline constexpr std::uint32_t kMaxPartBytes = (std::uint32_t{64} << 22) + 65'536;

/// Writes messages to a descriptor. What can not be written is lost: then nobody reads.
class PartSender final : public HeightSink, public VolumeSink, public CloudSink, private SurfaceParts {
 public:
  explicit PartSender(int descriptor) : descriptor_(descriptor) {}
  void progress(double fraction);
  void failure(const std::string& why);
  /// The whole scene, then nothing else.
  void scene(const SceneModel& scene);
  void header(const HeightHeader& header) override;
  void header(const VolumeHeader& header) override;
  void header(const CloudHeader& header) override;
  void points(const CloudPiece& piece) override;
  void samples(const void* samples, std::size_t bytes) override;
  void warn(const std::string& line) override;

 private:
  void parts(const std::vector<ModelPart>& parts);
  std::string& waiting();
  void sendSamples();
  void surfaces(const std::vector<SceneSurface>& surfaces);
  void look(const std::vector<Texture>& textures, const std::vector<Material>& materials);
  void take(proto::RecordedHeights& part) override;
  void take(proto::RecordedVolume& part) override;
  void take(proto::RecordedCloud& part) override;
  void take(proto::RecordedImplicit& part) override;
  void model(const Model& model);
  void places(const SnapList& snaps, const FieldList& fields);
  void send(const proto::ReadingPart& part);

  int descriptor_;
  std::string bytes_;
  proto::ReadingPart samples_;  // that wait to be sent
};

/// Puts a scene together from messages.
class PartCollector {
 public:
  enum class State { kMore, kWhole, kFailed };

  /// `most_bytes`: of the messages together, and of the meshes. `samples_bytes`: of the samples of heights or a
  /// volume, or the points of a cloud.
  explicit PartCollector(std::size_t most_bytes, std::size_t samples_bytes = 0)
      : mesh_(most_bytes), left_(most_bytes), samples_bytes_(samples_bytes), sources_(samples_bytes) {
    rest_.materials.clear();
  }
  /// Throws hl::Error for a message that makes no sense, or one too many. `bytes` is its length.
  State add(const proto::ReadingPart& part, std::size_t bytes, const std::function<void(double)>& progress);
  const std::string& failure() const { return failure_; }
  /// When it is whole, once. Throws hl::Error for a body that cannot be made.
  SceneModel take();

 private:
  bool addSamples(const proto::ReadingPart& part);
  void addSurface(const proto::ReadSurface& surface);
  void addSource(const std::shared_ptr<const PrimitiveSource>& source);
  void addHeights(const proto::RecordedHeights& part);
  void addVolume(const proto::RecordedVolume& part);
  void takeVolume();
  void addCloud(const proto::RecordedCloud& part);
  void takeCloud();
  State addMesh(const proto::RecordedShape& part);
  Model takeModel();
  void addToScene(const proto::ReadingPart& part);
  void addBody(const proto::RecordedBody& body);
  void addParts(const proto::ModelParts& parts);
  void addSnap(const proto::RecordedSnap& snap);
  void addField(const proto::RecordedField& field);
  void addTexture(const proto::RecordedTexture& texture);
  void addMaterial(const proto::Values& material);
  void addWarning(const std::string& warning);

  Model rest_;  // all but the mesh
  SceneModel scene_;
  std::size_t moving_bodies_ = 0;
  bool in_body_ = false;     // what comes now is of the last body
  bool in_surface_ = false;  // of the last surface
  MeshReader mesh_;
  std::size_t left_, samples_bytes_;
  SurfaceReader sources_;
  std::optional<HeightCollector> heights_;
  std::optional<VolumeCollector> volume_;
  std::optional<CloudCollector> cloud_;
  Mat3 cloud_turn_ = Mat3::Identity();
  std::string failure_;
};

}  // namespace hl
