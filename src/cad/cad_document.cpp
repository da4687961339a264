#include "cad/cad_document.h"

#include <BRep_Builder.hxx>
#include <Quantity_Color.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XCAFPrs_DocumentExplorer.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace hl {

namespace {

constexpr const char* kUnnamed = "solid";

Rgb screenColour(const Quantity_Color& colour) {
  Standard_Real red = 0, green = 0, blue = 0;
  colour.Values(red, green, blue, Quantity_TOC_sRGB);
  return {colourByte(red), colourByte(green), colourByte(blue)};
}

// UTF-8.
std::string nameOf(const TDF_Label& label) {
  Handle(TDataStd_Name) attribute;
  if (label.IsNull() || !label.FindAttribute(TDataStd_Name::GetID(), attribute)) return {};
  const TCollection_ExtendedString& wide = attribute->Get();
  std::string name(static_cast<std::size_t>(wide.LengthOfCString()) + 1, '\0');
  Standard_PCharacter room = name.data();
  wide.ToUTF8CString(room);
  name.pop_back();
  return name;
}

// Solids of one name are distinguished by numbers.
class SolidList {
 public:
  void add(const TopoDS_Shape& shape, std::string name, std::optional<Rgb> colour) {
    if (name.empty()) name = kUnnamed;
    const std::size_t number = ++named_[name];
    if (number > 1) name += " " + std::to_string(number);
    solids_.push_back({shape, std::move(name), colour});
  }
  std::vector<CadSolid> take() { return std::move(solids_); }

 private:
  std::map<std::string, std::size_t> named_;
  std::vector<CadSolid> solids_;
};

class PartReader {
 public:
  explicit PartReader(const Handle(TDocStd_Document) & document)
      : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
        colours_(XCAFDoc_DocumentTool::ColorTool(document->Main())) {}

  void add(const XCAFPrs_DocumentNode& node, SolidList& solids) const {
    const TopoDS_Shape part = shapes_->GetShape(node.RefLabel);
    if (part.IsNull()) return;
    std::optional<Rgb> of_node;
    if (node.Style.IsSetColorSurf()) of_node = screenColour(node.Style.GetColorSurf());
    for (TopExp_Explorer at(part, TopAbs_SOLID); at.More(); at.Next()) {
      const TopoDS_Shape& solid = at.Current();
      const std::optional<Rgb> own = solid.IsSame(part) ? std::nullopt : ownColour(solid);  // the node knows the part's
      TDF_Label label;
      const bool named = shapes_->FindSubShape(node.RefLabel, solid, label) && !nameOf(label).empty();
      solids.add(solid.Moved(node.Location), nameOf(named ? label : node.RefLabel),
                 own       ? own
                 : of_node ? of_node
                           : colourOfFaces(solid));
    }
  }

 private:
  std::optional<Rgb> ownColour(const TopoDS_Shape& shape) const {
    Quantity_Color colour;
    for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen}) {
      if (colours_->GetColor(shape, type, colour)) return screenColour(colour);
    }
    return {};
  }

  // That of most of them, the highest of several; none: most have none.
  std::optional<Rgb> colourOfFaces(const TopoDS_Shape& solid) const {
    std::map<std::optional<Rgb>, int> faces;
    for (TopExp_Explorer at(solid, TopAbs_FACE); at.More(); at.Next()) ++faces[ownColour(at.Current())];
    const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
    const auto most = std::max_element(faces.begin(), faces.end(), fewer);
    return most == faces.end() ? std::nullopt : most->first;
  }

  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colours_;
};

}  // namespace

Handle(TDocStd_Document) newCadDocument() {
  XCAFDoc_ShapeTool::SetAutoNaming(Standard_False);
  Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
  XCAFDoc_DocumentTool::Set(document->Main(), Standard_False);
  return document;
}

TopoDS_Shape wholeShape(const Handle(TDocStd_Document) & document) {
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  TDF_LabelSequence roots;
  shapes->GetFreeShapes(roots);
  if (roots.IsEmpty()) return {};
  TopoDS_Compound whole;
  const BRep_Builder builder;
  builder.MakeCompound(whole);
  for (const TDF_Label& root : roots) builder.Add(whole, XCAFDoc_ShapeTool::GetShape(root));
  return whole;
}

std::vector<CadSolid> solidsIn(const Handle(TDocStd_Document) & document) {
  SolidList solids;
  const PartReader parts(document);
  for (XCAFPrs_DocumentExplorer at(document, XCAFPrs_DocumentExplorerFlags_OnlyLeafNodes); at.More(); at.Next())
    parts.add(at.Current(), solids);
  return solids.take();
}

std::vector<CadSolid> solidsIn(const TopoDS_Shape& shape) {
  SolidList solids;
  for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More(); at.Next()) solids.add(at.Current(), {}, {});
  return solids.take();
}

}  // namespace hl
