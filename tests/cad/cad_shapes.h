// Shapes whose sizes have closed forms. Millimetres, as OpenCASCADE has them.
#pragma once

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Ax2.hxx>

namespace hl::test {

/// Of two corners.
inline TopoDS_Shape boxOf(const gp_Pnt& low, const gp_Pnt& high) { return BRepPrimAPI_MakeBox(low, high).Shape(); }

/// A box of 20 x 20 x `height`, from z = 0 up, with a bore along z through its middle, the origin.
inline TopoDS_Shape bored(double radius, double height) {
  const gp_Ax2 axis(gp_Pnt(0, 0, -1), gp_Dir(0, 0, 1));
  const TopoDS_Shape bore = BRepPrimAPI_MakeCylinder(axis, radius, height + 2).Shape();
  return BRepAlgoAPI_Cut(boxOf({-10, -10, 0}, {10, 10, height}), bore).Shape();
}

/// A cube of 20 from the origin, all of whose edges are rounded.
inline TopoDS_Shape rounded(double radius) {
  const TopoDS_Shape cube = boxOf({0, 0, 0}, {20, 20, 20});
  BRepFilletAPI_MakeFillet fillet(cube);
  for (TopExp_Explorer edge(cube, TopAbs_EDGE); edge.More(); edge.Next())
    fillet.Add(radius, TopoDS::Edge(edge.Current()));
  return fillet.Shape();
}

}  // namespace hl::test
