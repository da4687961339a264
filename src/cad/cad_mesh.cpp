#include "cad/cad_mesh.h"

#include <fmt/core.h>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Poly_Triangulation.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "cad/cad_face.h"
#include "cad/cad_progress.h"

namespace hl {

namespace {

constexpr double kEstimatePart = 0.1, kMeshPart = 0.9;  // of the whole, at their ends

// Of a first, coarse mesh: a chord of it is this many times as far from its curve. The angle goes with the root of it.
constexpr double kCoarse = 64;
constexpr double kMax_s = 90;  // of the processor, for a mesh: the reading process has 120

void makeMesh(const TopoDS_Shape& shape, const CadMeshing& meshing, const Message_ProgressRange& progress) {
  IMeshTools_Parameters parameters;
  parameters.Deflection = meshing.deflection_m / kCadUnit_m;
  parameters.Angle = meshing.angle_rad;
  parameters.AngleInterior = meshing.angle_rad;
  BRepMesh_IncrementalMesh(shape, parameters, progress);
}

// How the number of its triangles grows as the deflection becomes finer: with this power of their ratio.
double growthOf(const TopoDS_Face& face) {
  const GeomAbs_SurfaceType kind = BRepAdaptor_Surface(face, false).GetType();
  const bool straight = kind == GeomAbs_Plane || kind == GeomAbs_Cylinder || kind == GeomAbs_Cone;
  return straight ? 0.5 : 1;
}

struct FaceEstimate {
  double triangles = 0;  // of the coarse mesh
  double growth = 1;
};

// What a coarse mesh shows of finer ones.
struct MeshEstimate {
  std::vector<FaceEstimate> faces;
  double coarse_s = 0;  // of the processor

  /// Of a mesh with a deflection of 1 / `ratio` of the coarse one's.
  double triangles(double ratio) const {
    double sum = 0;
    for (const FaceEstimate& face : faces) sum += face.triangles * std::pow(ratio, face.growth);
    return sum;
  }
  double time_s(double ratio) const { return coarse_s * triangles(ratio) / std::max(1.0, triangles(1)); }
  bool fits(double ratio, std::size_t most_triangles) const {
    return triangles(ratio) <= static_cast<double>(most_triangles) && time_s(ratio) <= kMax_s;
  }
};

double processorTime_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

MeshEstimate estimateMesh(const TopoDS_Shape& shape, const CadMeshing& meshing, CadProgress& progress) {
  constexpr double kWidest_rad = 1;
  const double begin_s = processorTime_s();
  makeMesh(shape, {kCoarse * meshing.deflection_m, std::min(kWidest_rad, std::sqrt(kCoarse) * meshing.angle_rad)},
           progress.begin());
  MeshEstimate estimate;
  estimate.coarse_s = processorTime_s() - begin_s;
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
    const TopoDS_Face face = TopoDS::Face(at.Current());
    TopLoc_Location place;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
    if (!mesh.IsNull()) estimate.faces.push_back({static_cast<double>(mesh->NbTriangles()), growthOf(face)});
  }
  BRepTools::Clean(shape);
  return estimate;
}

// Throws if a mesh as it is asked for would have too many triangles or take too long.
void requireFits(const MeshEstimate& estimate, const CadMeshing& meshing, std::size_t most) {
  if (estimate.fits(kCoarse, most)) return;
  double deflection_m = meshing.deflection_m;
  while (!estimate.fits(kCoarse * meshing.deflection_m / deflection_m, most) && deflection_m < kMaxDeflection_m)
    deflection_m *= 2;
  throw Error(
      fmt::format("makes about {:.2g} million triangles at a deflection of {:.2g} m, in {:.0f} s; at most {:.2g} "
                  "million in {:.0f} s "
                  "can be: --deflection {:.2g} fits",
                  1e-6 * estimate.triangles(kCoarse), meshing.deflection_m, estimate.time_s(kCoarse),
                  1e-6 * static_cast<double>(most), kMax_s, deflection_m));
}

std::size_t countOf(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  std::size_t count = 0;
  for (TopExp_Explorer at(shape, kind); at.More(); at.Next()) ++count;
  return count;
}

// Puts the triangles of faces together, and counts.
class MeshCollection {
 public:
  MeshCollection(const TopoDS_Shape& shape, const CadMeshing& meshing, const std::function<void(double)>& report)
      : meshing_(meshing), report_(report), reading_{meshing.deflection_m, meshing.angle_rad} {
    ShapeAnalysis_ShapeTolerance tolerance;
    reading_.tolerance_m = kCadUnit_m * tolerance.Tolerance(shape, 1);
    reading_.solids = countOf(shape, TopAbs_SOLID);
    reading_.faces = countOf(shape, TopAbs_FACE);
  }

  /// The faces of a shape that belong to nothing of the kind `beside`, and its edges without faces.
  void add(const TopoDS_Shape& shape, TopAbs_ShapeEnum beside = TopAbs_SHAPE) {
    for (TopExp_Explorer at(shape, TopAbs_FACE, beside); at.More(); at.Next()) {
      const std::optional<double> error_m = appendFace(TopoDS::Face(at.Current()), model_);
      if (!error_m) ++lacking_;
      reading_.error_m = std::max(reading_.error_m, error_m.value_or(0));
      report_(kMeshPart +
              (1 - kMeshPart) * std::min(1.0, static_cast<double>(++done_) / static_cast<double>(reading_.faces)));
    }
    for (TopExp_Explorer at(shape, TopAbs_EDGE, TopAbs_FACE); at.More(); at.Next())
      appendEdge(TopoDS::Edge(at.Current()), meshing_, model_);
  }

  /// What has been added since the last part is one.
  void endPart(const std::string& name, const std::optional<Rgb>& colour) {
    const auto added = [](std::size_t now, std::size_t& before) {
      return static_cast<std::uint32_t>(now - std::exchange(before, now));
    };
    ModelPart part{name, colour};
    part.vertices = added(model_.positions.size(), vertices_);
    part.triangles = added(model_.triangles.size(), triangles_);
    part.segments = added(model_.segments.size(), segments_);
    if (part.triangles + part.segments > 0) model_.parts.push_back(std::move(part));
  }

  Model take() {
    if (lacking_ > 0)
      model_.warnings.push_back(
          fmt::format("{} of {} faces cannot be meshed: nothing is there", lacking_, reading_.faces));
    model_.reading.cad = reading_;
    return std::move(model_);
  }

 private:
  const CadMeshing& meshing_;
  const std::function<void(double)>& report_;
  CadReading reading_;
  Model model_;
  std::size_t lacking_ = 0, done_ = 0, vertices_ = 0, triangles_ = 0, segments_ = 0;
};

Model collectMesh(const CadShape& cad, const CadMeshing& meshing, const std::function<void(double)>& report) {
  MeshCollection mesh(cad.shape, meshing, report);
  const bool apart = !cad.solids.empty() && cad.solids.size() < kMaxModelParts;
  if (!apart) {
    mesh.add(cad.shape);
    return mesh.take();
  }
  for (const CadSolid& solid : cad.solids) {
    mesh.add(solid.shape);
    mesh.endPart(solid.name, solid.colour);
  }
  mesh.add(cad.shape, TopAbs_SOLID);
  mesh.endPart("what is no solid", {});
  return mesh.take();
}

// Triangles may be farther from their surface than edges from their curves: then finer edges are tried, as long as that
// fits.
Model meshWithin(const CadShape& cad, const CadMeshing& meshing, const MeshEstimate& estimate, std::size_t most,
                 const std::function<void(double)>& report) {
  constexpr int kTries = 3;
  constexpr double kMargin = 0.9, kFinest = 0.25;
  double finer = 1;
  for (int i = 1;; ++i) {
    CadProgress progress(report, kEstimatePart, kMeshPart);
    BRepTools::Clean(cad.shape);
    makeMesh(cad.shape, {finer * meshing.deflection_m, meshing.angle_rad}, progress.begin());
    Model model = collectMesh(cad, meshing, report);
    const CadReading& reading = *model.reading.cad;
    if (i == kTries || reading.error_m <= meshing.deflection_m + reading.tolerance_m) return model;
    finer *= std::max(kFinest, kMargin * meshing.deflection_m / reading.error_m);
    if (!estimate.fits(kCoarse / finer, most)) return model;
  }
}

}  // namespace

Model meshCad(const CadShape& cad, const CadMeshing& meshing, const std::function<void(double)>& report,
              std::size_t most_triangles) {
  try {
    BRepTools::Clean(cad.shape);
    CadProgress progress(report, 0, kEstimatePart);
    const MeshEstimate estimate = estimateMesh(cad.shape, meshing, progress);
    requireFits(estimate, meshing, most_triangles);
    return meshWithin(cad, meshing, estimate, most_triangles, report);
  } catch (const Standard_Failure& failure) {
    throw Error(fmt::format("cannot be meshed: {}", failure.DynamicType()->Name()));
  }
}

}  // namespace hl
