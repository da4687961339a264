// FCL: distance of a sphere from a BVHModel of rectangle swept spheres, its fastest for distances.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include "tick/peers/peers.h"

namespace hl::bench {

namespace {

// Of the proxy's radius. Half of it stays clear of what the proxy touches, so the distance is one of separate things.
constexpr double kShrunk = 0.5;

class Fcl final : public Peer {
 public:
  explicit Fcl(const Mesh& mesh) {
    std::vector<fcl::Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    const std::vector<Vec3> positions(mesh.positions.begin(), mesh.positions.end());
    model_.beginModel(static_cast<int>(triangles.size()), static_cast<int>(positions.size()));
    model_.addSubModel(positions, triangles);
    model_.endModel();
  }

  std::span<const Question> questions() const override {
    static constexpr std::array kAsked{Question::kNearest};
    return kAsked;
  }

  double ask(Question, const Probe& probe) override {
    const fcl::Sphered sphere(kShrunk * probe.radius_m);
    fcl::Transform3d place = fcl::Transform3d::Identity();
    place.translation() = probe.centre;
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    fcl::distance<double>(&sphere, place, &model_, fcl::Transform3d::Identity(), request, result);
    return result.min_distance + sphere.radius;
  }

 private:
  fcl::BVHModel<fcl::RSSd> model_;
};

}  // namespace

std::unique_ptr<Peer> makeFcl(const Mesh& mesh) { return std::make_unique<Fcl>(mesh); }

}  // namespace hl::bench
