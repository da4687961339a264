#include "io/gltf_pose.h"

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "io/check_gltf.h"
#include "io/gltf_item.h"
#include "io/gltf_lists.h"
#include "io/gltf_nodes.h"

namespace hl {

namespace json = boost::json;

namespace {

using Matrices = std::vector<Eigen::Matrix4d>;
using VertexColumns = Eigen::Matrix3Xd;  // one for each vertex

constexpr const char* kLeftOut = "its skin and morph targets are left out: it stands as it was modelled";

// Positions and normals of a primitive; there may be no normals.
struct ModelledShape {
  VertexColumns positions, normals;
};

// What bends the mesh of a node.
struct Bending {
  std::vector<double> weights;       // of morph targets
  const Matrices* joints = nullptr;  // to the scene, of what is modelled; nullptr: no skin
  Eigen::Matrix4d from_scene;
};

// One set of JOINTS_n and WEIGHTS_n: four joints of each vertex.
struct Influences {
  std::vector<float> joints, weights;
};

std::vector<double> weightsOf(const GltfItem& item) {
  std::vector<double> weights;
  const json::value* const list = item.object().if_contains("weights");
  if (list == nullptr || !list->is_array()) return weights;
  for (const json::value& weight : list->as_array())
    weights.push_back(weight.is_number() ? weight.to_number<double>() : 0);
  return weights;
}

bool anyNot0(const std::vector<double>& weights) {
  return std::any_of(weights.begin(), weights.end(), [](double weight) { return weight != 0; });
}

std::vector<float> floatsIn(const VertexColumns& columns) {
  const Eigen::Matrix3Xf floats = columns.cast<float>();
  return {floats.data(), floats.data() + floats.size()};
}

bool isOfSkinOrMorph(std::string_view attribute) {
  return attribute.starts_with("JOINTS_") || attribute.starts_with("WEIGHTS_");
}

// The weighted matrix of a vertex. Weights count by their part of the sum; without any the first joint has all.
Eigen::Matrix4d blended(const Matrices& joints, const std::vector<Influences>& sets, std::size_t vertex) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  double weights = 0;
  for (const Influences& set : sets) {
    for (std::size_t i = 4 * vertex; i < 4 * vertex + 4; ++i) {
      const auto weight = static_cast<double>(set.weights[i]);
      if (weight == 0) continue;
      sum += weight * joints[static_cast<std::size_t>(set.joints[i])];
      weights += weight;
    }
  }
  if (weights == 0) return joints[static_cast<std::size_t>(sets.front().joints[4 * vertex])];
  return sum / weights;
}

// To the scene by the joints, and from there back into the node, which takes it to the scene as it does other meshes.
void bend(const Bending& by, const std::vector<Influences>& sets, ModelledShape& shape) {
  for (Eigen::Index i = 0; i < shape.positions.cols(); ++i) {
    const Eigen::Matrix4d bent = by.from_scene * blended(*by.joints, sets, static_cast<std::size_t>(i));
    shape.positions.col(i) = (bent * shape.positions.col(i).homogeneous()).head<3>();
    if (shape.normals.cols() == 0) continue;
    const Eigen::Matrix3d linear = bent.topLeftCorner<3, 3>();
    const Eigen::Vector3d normal = linear.inverse().transpose() * shape.normals.col(i);
    shape.normals.col(i) = normal.allFinite() ? normal.normalized() : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }
}

class Poser {
 public:
  Poser(json::value& file, const GltfAccessors& accessors, GltfAdditions& additions, std::vector<std::string>& warnings)
      : file_(file), accessors_(accessors), additions_(additions), warnings_(warnings) {}

  bool pose() {
    const GltfItem root(file_, "");
    const std::vector<GltfItem> nodes = root.list("nodes"), meshes = root.list("meshes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::optional<std::size_t> mesh = nodes[i].reference("mesh", "meshes", meshes.size());
      if (mesh) poseNode(i, nodes[i], *mesh, meshes[*mesh]);
    }
    const std::size_t first = meshes.size();
    for (const auto& [node, posed] : posed_nodes_)
      file_.as_object()["nodes"].as_array()[node].as_object()["mesh"] = first + posed;
    for (json::object& posed : posed_) file_.as_object()["meshes"].as_array().push_back(std::move(posed));
    return leaveOut();
  }

 private:
  // Nodes without a skin share a mesh of the same weights.
  void poseNode(std::size_t number, const GltfItem& node, std::size_t mesh_number, const GltfItem& mesh) {
    Bending by{weightsOf(node), nullptr, {}};
    if (by.weights.empty()) by.weights = weightsOf(mesh);
    const std::optional<std::size_t> skin = node.whole("skin");
    if (!skin && !anyNot0(by.weights)) return;
    if (skin) {
      if (matrices_.empty()) matrices_ = gltfNodeMatrices(file_);
      by.joints = &jointsOf(*skin);
      by.from_scene = matrices_[number].inverse();
      if (!by.from_scene.allFinite()) {
        warnings_.push_back(fmt::format("{}: its transform has no inverse, and {}", node.place(), kLeftOut));
        return;
      }
    }
    const auto known = morphed_.find({mesh_number, by.weights});
    if (!skin && known != morphed_.end()) {
      posed_nodes_[number] = known->second;
      return;
    }
    json::object posed = mesh.object();
    const std::vector<GltfItem> primitives = mesh.list("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i)
      posePrimitive(by, primitives[i], posed["primitives"].as_array()[i].as_object());
    posed_nodes_[number] = posed_.size();
    if (!skin) morphed_[{mesh_number, by.weights}] = posed_.size();
    posed_.push_back(std::move(posed));
  }

  // A skin without matrices has those of 1 (3.7.3.1).
  const Matrices& jointsOf(std::size_t skin) {
    if (const auto known = joints_.find(skin); known != joints_.end()) return known->second;
    const GltfItem item = GltfItem(file_, "").list("skins")[skin];
    const std::vector<std::size_t> joints = item.references("joints", "nodes", matrices_.size());
    if (joints.empty()) item.refuse("has no joints");
    const std::optional<std::vector<float>> inverse = inverseBindMatrices(item, joints.size());
    Matrices& matrices = joints_[skin];
    for (std::size_t i = 0; i < joints.size(); ++i) {
      matrices.push_back(matrices_[joints[i]]);
      if (inverse) matrices.back() *= Eigen::Map<const Eigen::Matrix4f>(&(*inverse)[16 * i]).cast<double>();
    }
    return matrices;
  }

  std::optional<std::vector<float>> inverseBindMatrices(const GltfItem& skin, std::size_t joints) const {
    const auto number = skin.reference("inverseBindMatrices", "accessors", accessors_.size());
    if (!number) return {};
    if (!accessors_[*number].isFloats("MAT4"))
      skin.refuse("the accessor of its inverseBindMatrices is no MAT4 of floats");
    if (accessors_[*number].count < joints)
      skin.refuse(fmt::format("has {} joints and {} inverseBindMatrices", joints, accessors_[*number].count));
    return accessors_.floatsOf(*number);
  }

  void posePrimitive(const Bending& by, const GltfItem& primitive, json::object& posed) {
    std::optional<ModelledShape> shape = shapeOf(primitive);
    if (!shape) return;
    morph(by.weights, primitive, *shape);
    if (by.joints != nullptr) {
      const std::vector<Influences> sets = influencesOf(primitive, *shape, by.joints->size());
      if (!sets.empty()) bend(by, sets, *shape);
    }
    json::object& attributes = posed["attributes"].as_object();
    attributes["POSITION"] = additions_.add(floatsIn(shape->positions), "VEC3", 3);
    if (shape->normals.cols() > 0) attributes["NORMAL"] = additions_.add(floatsIn(shape->normals), "VEC3", 3);
  }

  // Nothing where its numbers are packed, in a file that is not there, or no positions.
  std::optional<ModelledShape> shapeOf(const GltfItem& primitive) {
    if (!attributesOf(primitive).has("POSITION")) return {};
    const std::optional<VertexColumns> positions = columnsOf(attributesOf(primitive), "POSITION", {});
    if (!positions) {
      if (said_.insert(primitive.place()).second)
        warnings_.push_back(fmt::format("{}: its numbers cannot be had, and {}", primitive.place(), kLeftOut));
      return {};
    }
    const std::optional<VertexColumns> normals = columnsOf(attributesOf(primitive), "NORMAL", {});
    const bool fits = normals && normals->cols() == positions->cols();
    return ModelledShape{*positions, fits ? *normals : VertexColumns()};
  }

  static GltfItem attributesOf(const GltfItem& primitive) { return *primitive.child("attributes"); }

  /// `vertices`: how many there have to be.
  std::optional<VertexColumns> columnsOf(const GltfItem& attributes, std::string_view name,
                                         std::optional<Eigen::Index> vertices) const {
    const auto number = attributes.reference(name, "accessors", accessors_.size());
    if (!number || (!accessors_[*number].run && !accessors_[*number].sparse)) return {};
    const GltfAccessor& accessor = accessors_[*number];
    if (accessor.type != "VEC3") attributes.refuse(fmt::format("the accessor of its {} is no VEC3", name));
    if (vertices && static_cast<Eigen::Index>(accessor.count) != *vertices)
      attributes.refuse(fmt::format("its {} has {} elements for {} vertices", name, accessor.count, *vertices));
    const std::optional<std::vector<float>> floats = accessors_.floatsOf(*number);
    if (!floats) return {};
    return Eigen::Map<const Eigen::Matrix3Xf>(floats->data(), 3, static_cast<Eigen::Index>(accessor.count))
        .cast<double>();
  }

  void morph(const std::vector<double>& weights, const GltfItem& primitive, ModelledShape& shape) const {
    const std::vector<GltfItem> targets = primitive.list("targets");
    for (std::size_t i = 0; i < std::min(weights.size(), targets.size()); ++i) {
      if (weights[i] == 0) continue;
      const Eigen::Index vertices = shape.positions.cols();
      if (const auto moved = columnsOf(targets[i], "POSITION", vertices)) shape.positions += weights[i] * *moved;
      const auto turned = columnsOf(targets[i], "NORMAL", vertices);
      if (turned && shape.normals.cols() > 0) shape.normals += weights[i] * *turned;
    }
  }

  std::vector<Influences> influencesOf(const GltfItem& primitive, const ModelledShape& shape,
                                       std::size_t joints) const {
    const GltfItem attributes = attributesOf(primitive);
    std::vector<Influences> sets;
    for (int number = 0;; ++number) {
      const std::string names[] = {fmt::format("JOINTS_{}", number), fmt::format("WEIGHTS_{}", number)};
      if (!attributes.has(names[0]) || !attributes.has(names[1])) return sets;
      std::optional<std::vector<float>> numbers[2];
      for (const int i : {0, 1}) {
        const std::size_t accessor = *attributes.reference(names[i], "accessors", accessors_.size());
        if (accessors_[accessor].type != "VEC4" ||
            accessors_[accessor].count != static_cast<std::size_t>(shape.positions.cols()))
          attributes.refuse(fmt::format("its {} is no VEC4 for {} vertices", names[i], shape.positions.cols()));
        numbers[i] = accessors_.floatsOf(accessor);
        if (!numbers[i]) return {};
      }
      for (const float joint : *numbers[0]) {
        if (!(joint >= 0 && joint < static_cast<float>(joints)))
          attributes.refuse(fmt::format("its {} names joint {}, and its skin has {}", names[0], joint, joints));
      }
      sets.push_back({std::move(*numbers[0]), std::move(*numbers[1])});
    }
  }

  // What has been applied. Animations may name it.
  bool leaveOut() {
    json::object& root = file_.as_object();
    bool changed = root.erase("skins") > 0;
    for (json::value& node : gltfList(root, "nodes")) changed = node.as_object().erase("skin") > 0 || changed;
    forEachGltfPrimitive(root, [&](json::object& primitive) { changed = leaveOut(primitive) || changed; });
    if (changed) root.erase("animations");
    return changed;
  }

  static bool leaveOut(json::object& primitive) {
    if (isPackedGltf(primitive)) return false;
    bool changed = primitive.erase("targets") > 0;
    json::object& attributes = primitive["attributes"].as_object();
    for (auto at = attributes.begin(); at != attributes.end();) {
      const bool erased = isOfSkinOrMorph(at->key());
      at = erased ? attributes.erase(at) : at + 1;
      changed = changed || erased;
    }
    return changed;
  }

  json::value& file_;
  const GltfAccessors& accessors_;
  GltfAdditions& additions_;
  std::vector<std::string>& warnings_;
  Matrices matrices_;                                                           // of nodes; empty until a skin asks
  std::map<std::size_t, Matrices> joints_;                                      // of skins
  std::vector<json::object> posed_;                                             // meshes
  std::map<std::size_t, std::size_t> posed_nodes_;                              // nodes, with the posed mesh of each
  std::map<std::pair<std::size_t, std::vector<double>>, std::size_t> morphed_;  // posed meshes, by mesh and weights
  std::set<std::string> said_;                                                  // primitives
};

}  // namespace

bool poseGltf(json::value& file, const GltfAccessors& accessors, GltfAdditions& additions,
              std::vector<std::string>& warnings) {
  return Poser(file, accessors, additions, warnings).pose();
}

}  // namespace hl
