// SPDX-License-Identifier: Apache-2.0
#include "read.h"

#include <fmt/format.h>

#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <ShapeAnalysis_FreeBounds.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_HSequenceOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <filesystem>

#include "flatten.h"
#include "load.h"

namespace obvid::cad {
namespace {

/// Curves that are looked at; a solid with more is no contour.
constexpr std::size_t kMostCurves = 10000;

class Collector {
 public:
  explicit Collector(Drawing& drawing) : drawing_(drawing) {}

  void collect(const TopoDS_Shape& shape) {
    for (TopExp_Explorer e(shape, TopAbs_WIRE, TopAbs_FACE); e.More(); e.Next()) wire(e, "wire");
    free_edges(shape);
    for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
      for (TopExp_Explorer w(e.Current(), TopAbs_WIRE); w.More(); w.Next()) {
        wire(w, "boundary of a face, wire");
      }
    }
    drawing_.left_out += left_out_;
    if (left_out_ > 0) {
      drawing_.warnings.push_back(
          fmt::format("{} curves beyond the first {} were not looked at", left_out_, kMostCurves));
    }
  }

 private:
  bool full() {
    if (count_ < kMostCurves) return false;
    ++left_out_;
    return true;
  }

  void wire(const TopExp_Explorer& at, const char* kind) { wire(TopoDS::Wire(at.Current()), kind); }

  void wire(const TopoDS_Wire& one, const char* kind) {
    EdgeChain chain;
    TopTools_MapOfShape in_order;
    bool new_one = false;
    for (BRepTools_WireExplorer e(one); e.More(); e.Next()) {
      if (BRep_Tool::Degenerated(e.Current())) continue;
      in_order.Add(e.Current());
      chain.edges.push_back(e.Current());
      new_one = seen_.Add(e.Current()) || new_one;
    }
    if (new_one && !full()) {  // neighbouring faces share their boundaries
      chain.label = fmt::format("{} {}", kind, ++count_);
      chain.closed = BRep_Tool::IsClosed(one);
      add_flat(chain, drawing_);
    }
    // edges that do not meet the others
    for (TopExp_Explorer e(one, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(e.Current());
      if (BRep_Tool::Degenerated(edge) || in_order.Contains(edge)) continue;
      if (!seen_.Add(edge) || full()) continue;
      add_flat({fmt::format("{} {}, an edge apart", kind, ++count_), {edge}, false}, drawing_);
    }
  }

  /// Edges that stand alone in the file, joined where their ends meet: STEP and IGES keep no wires.
  void free_edges(const TopoDS_Shape& shape) {
    constexpr double kMeet = 1e-6;  // mm
    const Handle(TopTools_HSequenceOfShape) edges = new TopTools_HSequenceOfShape;
    for (TopExp_Explorer e(shape, TopAbs_EDGE, TopAbs_WIRE); e.More(); e.Next()) {
      if (!BRep_Tool::Degenerated(TopoDS::Edge(e.Current()))) edges->Append(e.Current());
    }
    if (edges->IsEmpty()) return;
    Handle(TopTools_HSequenceOfShape) sequence = edges, wires = new TopTools_HSequenceOfShape;
    ShapeAnalysis_FreeBounds::ConnectEdgesToWires(sequence, kMeet, false, wires);
    for (int i = 1; i <= wires->Length(); ++i) wire(TopoDS::Wire(wires->Value(i)), "curve");
  }

  Drawing& drawing_;
  TopTools_MapOfShape seen_;
  std::size_t count_ = 0, left_out_ = 0;
};

}  // namespace

Result<Drawing> read_file(const std::string& path) {
  const auto loaded = load(path);
  OBVID_TRY(loaded);
  Drawing drawing;
  drawing.name = std::filesystem::path(path).filename().string();
  drawing.units = loaded->units;
  if (!loaded->shape.IsNull()) Collector(drawing).collect(loaded->shape);
  if (drawing.curves.empty()) {
    std::string what = "the file holds no plane curves";
    if (!drawing.warnings.empty()) what += ": " + drawing.warnings.front();
    return error(ErrorCode::kNothingThere, what).where(path).hint("export a sketch or section");
  }
  return drawing;
}

}  // namespace obvid::cad
