// Decode: the parts that scene files and frames of clients share, from messages of proto/hl.proto to the scene's own
// types. Every number is checked; an error is reported with the path of its value, "objects[2].material.stiffness".
#pragma once

#include <hl.pb.h>

#include <functional>
#include <string>
#include <vector>

#include "scene/body_spec.h"
#include "scene/field_spec.h"
#include "scene/joint_spec.h"
#include "scene/model.h"
#include "scene/shape.h"
#include "scene/snap_spec.h"
#include "scene/surface_change.h"

namespace hl {

class SceneDecoder {
 public:
  /// Says what is wrong with the value at the path `where`, by throwing hl::Error.
  using Fail = std::function<void(const std::string& where, const std::string& message)>;
  explicit SceneDecoder(Fail fail) : fail_(std::move(fail)) {}

  /// Vertices, lists, polygons and patches; polygons become fans. Names, materials and textures are left at their
  /// defaults.
  Model model(const proto::Primitives& in, const std::string& where) const;
  /// What is absent stays unset. Textures are not looked up.
  SurfaceChange surface(const proto::Material& in, const std::string& where) const;
  /// Procedural textures and texels of at most `most_texels`; a file is refused.
  Texture texture(const proto::TextureImage& in, std::size_t most_texels, const std::string& where) const;
  BodySpec body(const proto::Body& in, const std::string& where) const;
  SnapList snaps(const google::protobuf::RepeatedPtrField<proto::Snap>& in, const std::string& where) const;
  FieldList fields(const google::protobuf::RepeatedPtrField<proto::Field>& in, const std::string& where) const;
  /// Without its bodies, whose names are the caller's.
  JointSpec joint(const proto::Joint& in, const std::string& where) const;
  /// As coloursIn().
  std::vector<Rgb> colours(const google::protobuf::RepeatedField<std::uint32_t>& in, const std::string& where) const;
  /// Sets how a texture is read, as the message says.
  void setReading(const proto::TextureImage& in, Texture& texture, const std::string& where) const;

  [[noreturn]] void fail(const std::string& where, const std::string& message) const;
  /// `value`, when it is in least..most; NaN never is.
  double checked(double value, double least, double most, const std::string& where) const;
  /// The same for each coordinate.
  Vec3 checked(const proto::Vec3& value, double most, const std::string& where) const;

 private:
  JointForces jointForces(const proto::Joint& in, const std::string& where) const;
  ForceTable forceTable(const proto::ForceTable& in, const std::string& where) const;
  SnapSpec snap(const proto::Snap& in, const std::string& where) const;
  FieldSpec field(const proto::Field& in, const std::string& where) const;
  Vec3 unit(const proto::Vec3& in, const std::string& where) const;
  std::optional<Vec3> planeNormal(bool given, const proto::Vec3& in, std::size_t points,
                                  const std::string& where) const;
  std::vector<Vec3> corners(const google::protobuf::RepeatedField<double>& in, const std::string& where) const;
  NamedTextureUse textureUse(const proto::MaterialTexture& in, const std::string& where) const;
  void addVertices(Model& model, const proto::Primitives& in, const std::string& where) const;
  void addElements(Model& model, const proto::Primitives& in, const std::string& where) const;
  void addPatches(Model& model, const proto::Primitives& in, const std::string& where) const;
  void addPolygons(Model& model, const proto::Primitives& in, const std::string& where) const;
  std::uint32_t vertex(const Model& model, std::uint32_t index, const std::string& where) const;

  Fail fail_;
};

/// Upper bounds of the sizes of what SceneDecoder::model() makes of these. Throws hl::Error for patches that it
/// refuses.
ModelCounts countsOf(const proto::Primitives& in);

/// What a texture modulates; the message has names of its own for it.
Quantity quantityOf(proto::Quantity quantity);

/// Factors of the texture coordinates of what has this material: 1 where there is none, or no finite one.
Vec2 repeatOf(const proto::Material& in);

/// "list[3]".
std::string pathOf(const std::string& list, int index);

}  // namespace hl
