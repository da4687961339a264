// CGAL: closest_point of an AABB_tree of triangles, in double, the last answer given as a hint for the next.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>

#include "tick/peers/peers.h"

namespace hl::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>;

Kernel::Point_3 toCgal(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

class Cgal final : public Peer {
 public:
  explicit Cgal(const Mesh& mesh) : triangles_(trianglesOf(mesh)), tree_(triangles_.begin(), triangles_.end()) {
    tree_.do_not_accelerate_distance_queries();  // the hint does
    tree_.build();
    hint_ = triangles_.front().vertex(0);
  }

  std::span<const Question> questions() const override {
    static constexpr std::array kAsked{Question::kNearest, Question::kFinger};
    return kAsked;
  }

  double ask(Question question, const Probe& probe) override {
    const Kernel::Point_3 at = toCgal(question == Question::kFinger ? probe.finger : probe.centre);
    hint_ = tree_.closest_point(at, hint_);
    return std::sqrt(CGAL::squared_distance(at, hint_));
  }

 private:
  static Triangles trianglesOf(const Mesh& mesh) {
    Triangles triangles;
    triangles.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
      triangles.emplace_back(toCgal(mesh.positions[t[0]]), toCgal(mesh.positions[t[1]]), toCgal(mesh.positions[t[2]]));
    }
    return triangles;
  }

  Triangles triangles_;
  CGAL::AABB_tree<Traits> tree_;
  Kernel::Point_3 hint_;
};

}  // namespace

std::unique_ptr<Peer> makeCgal(const Mesh& mesh) { return std::make_unique<Cgal>(mesh); }

}  // namespace hl::bench
