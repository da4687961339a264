#include "cad/cad_face.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_TangentialDeflection.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Geom_Surface.hxx>
#include <Poly_Triangulation.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "cad/cad_shape.h"

namespace hl {

namespace {

Vec3 metres(const gp_Pnt& point) { return kCadUnit_m * Vec3(point.X(), point.Y(), point.Z()); }

// One face on its way into a model.
class FaceMesh {
 public:
  FaceMesh(const TopoDS_Face& face, const Handle(Poly_Triangulation) & mesh, const TopLoc_Location& place)
      : mesh_(*mesh),
        surface_(BRep_Tool::Surface(face)),
        place_(place.Transformation()),
        reversed_((face.Orientation() == TopAbs_REVERSED) != place_.IsNegative()) {}

  double append(Model& model) {
    addVertices(model);
    addTriangles(model);
    addNormals(model);
    return error_m_;
  }

 private:
  void addVertices(Model& model) {
    base_ = model.positions.size();
    for (int i = 1; i <= mesh_.NbNodes(); ++i) model.positions.push_back(metres(mesh_.Node(i).Transformed(place_)));
    facing_.assign(static_cast<std::size_t>(mesh_.NbNodes()), Vec3::Zero());
  }

  void addTriangles(Model& model) {
    for (int i = 1; i <= mesh_.NbTriangles(); ++i) {
      std::array<int, 3> node{};
      mesh_.Triangle(i).Get(node[0], node[1], node[2]);
      if (reversed_) std::swap(node[1], node[2]);
      std::array<Vec3, 3> corner;
      std::array<std::uint32_t, 3> vertex{};
      for (std::size_t k = 0; k < 3; ++k) {
        vertex[k] = static_cast<std::uint32_t>(base_ + static_cast<std::size_t>(node[k] - 1));
        corner[k] = model.positions[vertex[k]];
      }
      // A side of no length, as in the pole of a sphere.
      if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
      const Vec3 area = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
      for (const int one : node) facing_[static_cast<std::size_t>(one - 1)] += area;
      model.triangles.push_back(vertex);
      if (area.norm() > 0) measure(node, corner[0], area.normalized());
    }
  }

  // In the middle of the triangle and of its sides, as far as the surface's coordinates there are known.
  void measure(const std::array<int, 3>& node, const Vec3& corner, const Vec3& normal) {
    if (!mesh_.HasUVNodes()) return;
    const gp_XY a = mesh_.UVNode(node[0]).XY(), b = mesh_.UVNode(node[1]).XY(), c = mesh_.UVNode(node[2]).XY();
    for (const gp_XY& uv : {(a + b + c) / 3, (a + b) / 2, (b + c) / 2, (c + a) / 2})
      error_m_ = std::max(error_m_, std::abs(normal.dot(metres(surface_->Value(uv.X(), uv.Y())) - corner)));
  }

  // The surface's own, toward the side that the triangles face; where it has none, as in the tip of a cone, theirs.
  void addNormals(Model& model) {
    constexpr double kResolution = 1e-9;
    GeomLProp_SLProps at(surface_, 2, kResolution);
    for (std::size_t i = 0; i < facing_.size(); ++i) {
      Vec3 normal = facing_[i].norm() > 0 ? Vec3(facing_[i].normalized()) : Vec3(Vec3::Zero());
      if (mesh_.HasUVNodes()) {
        const gp_Pnt2d uv = mesh_.UVNode(static_cast<int>(i) + 1);
        at.SetParameters(uv.X(), uv.Y());
        if (at.IsNormalDefined()) {
          const Vec3 own(at.Normal().X(), at.Normal().Y(), at.Normal().Z());
          normal = own.dot(normal) < 0 ? Vec3(-own) : own;
        }
      }
      model.normals.push_back(normal);
    }
  }

  const Poly_Triangulation& mesh_;
  const Handle(Geom_Surface) surface_;
  const gp_Trsf place_;
  const bool reversed_;
  std::size_t base_ = 0;
  std::vector<Vec3> facing_;  // of each vertex: the sum of its triangles' normals, twice their areas long
  double error_m_ = 0;
};

}  // namespace

std::optional<double> appendFace(const TopoDS_Face& face, Model& model) {
  TopLoc_Location place;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
  if (mesh.IsNull() || BRep_Tool::Surface(face).IsNull()) return {};
  return FaceMesh(face, mesh, place).append(model);
}

void appendEdge(const TopoDS_Edge& edge, const CadMeshing& meshing, Model& model) {
  if (BRep_Tool::Degenerated(edge) || !BRep_Tool::IsGeometric(edge)) return;
  const BRepAdaptor_Curve curve(edge);
  const GCPnts_TangentialDeflection points(curve, meshing.angle_rad, meshing.deflection_m / kCadUnit_m);
  for (int i = 1; i <= points.NbPoints(); ++i) {
    const auto vertex = static_cast<std::uint32_t>(model.positions.size());
    model.positions.push_back(metres(points.Value(i)));
    model.normals.push_back(Vec3::Zero());
    if (i > 1) model.segments.push_back({vertex - 1, vertex});
  }
}

}  // namespace hl
