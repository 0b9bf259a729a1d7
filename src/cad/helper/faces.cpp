// SPDX-License-Identifier: Apache-2.0
#include "faces.h"

#include <fmt/format.h>

#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Precision.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <utility>

#include "borders.h"
#include "creases.h"
#include "obvid/geom/internal/box.h"
#include "obvid/surface/internal/enclosed.h"
#include "splines.h"
#include "trimmed_faces.h"

namespace obvid::cad {
namespace {

/// Faces by creases that a CAD system can still work with.
constexpr std::size_t kMostCreasedFaces = 20000;

/// In the kernel's unit: it compares squares of lengths, which have to be numbers.
constexpr double kLargest = 1e100;

/// Room for rounding around a measured gap.
constexpr double kRoom = 1.01;
double tolerance_for(double gap) { return std::max(Precision::Confusion(), kRoom * gap); }

gp_Pnt2d corner(const NurbsSurface& surface, PatchSide side, bool end) {
  const Range u = domain_u(surface), v = domain_v(surface);
  switch (side) {
    case kVStart:
      return {end ? u.to : u.from, v.from};
    case kVEnd:
      return {end ? u.to : u.from, v.to};
    case kUStart:
      return {u.from, end ? v.to : v.from};
    default:
      return {u.to, end ? v.to : v.from};
  }
}

/// The straight line from a to b in the plane of the parameters, over the parameters of the edge.
Handle(Geom2d_Curve) line_between(const gp_Pnt2d& a, const gp_Pnt2d& b, const Range& edge) {
  const gp_Vec2d step(a, b);
  if (std::abs(step.Magnitude() - edge.length()) <= 0.0) {
    const gp_Dir2d direction(step);
    return new Geom2d_Line(a.Translated(-edge.from * gp_Vec2d(direction)), direction);
  }
  TColgp_Array1OfPnt2d poles(1, 2);
  poles(1) = a;
  poles(2) = b;
  TColStd_Array1OfReal knots(1, 2);
  knots(1) = edge.from;
  knots(2) = edge.to;
  TColStd_Array1OfInteger multiplicities(1, 2);
  multiplicities.Init(2);
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, 1);
}

/// Shape of the joints: one vertex and one edge each, shared by the faces.
class Builder {
 public:
  Builder(const std::vector<NurbsSurface>& patches, Joints joints)
      : patches_(patches), joints_(std::move(joints)) {
    std::vector<double> wide(joints_.vertices.size());
    for (std::size_t i = 0; i < wide.size(); ++i) wide[i] = joints_.vertices[i].gap;
    for (const JointEdge& edge : joints_.edges) {  // no vertex narrower than its edges
      const double gap = edge.point ? farthest_from_first(edge.curve.points) : edge.gap;
      for (const std::size_t end : {edge.from, edge.to}) wide[end] = std::max(wide[end], gap);
    }
    for (std::size_t i = 0; i < wide.size(); ++i) {
      const Vec3 p = joints_.vertices[i].point;
      TopoDS_Vertex vertex;
      builder_.MakeVertex(vertex, gp_Pnt(p.x, p.y, p.z), tolerance_for(wide[i]));
      vertices_.push_back(vertex);
    }
    for (const JointEdge& edge : joints_.edges) edges_.push_back(edge_of(edge));
  }

  [[nodiscard]] const Joints& joints() const { return joints_; }

  /// All faces, in the order of the patches.
  std::vector<TopoDS_Face> faces() {
    std::vector<TopoDS_Face> out;
    for (std::size_t i = 0; i < patches_.size(); ++i) out.push_back(face_of(i));
    return out;
  }

 private:
  TopoDS_Edge edge_of(const JointEdge& joint) {
    TopoDS_Edge edge;
    if (joint.point) {
      builder_.MakeEdge(edge);
      builder_.Degenerated(edge, true);
    } else {
      builder_.MakeEdge(edge, spline_of(joint.curve), tolerance_for(joint.gap));
      const Range range = domain(joint.curve);
      builder_.Range(edge, range.from, range.to);
    }
    builder_.Add(edge, vertices_[joint.from].Oriented(TopAbs_FORWARD));
    builder_.Add(edge, vertices_[joint.to].Oriented(TopAbs_REVERSED));
    return edge;
  }

  TopoDS_Face face_of(std::size_t patch) {
    TopoDS_Face face;
    builder_.MakeFace(face, spline_of(patches_[patch]), Precision::Confusion());
    for (const PatchSide side : kBoundary) place(face, patch, side);
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    for (const PatchSide side : kBoundary) {
      const JointUse& use = joints_.sides[patch][side];
      const bool forward = runs_with_boundary(side) == use.along;
      builder_.Add(wire, edges_[use.edge].Oriented(forward ? TopAbs_FORWARD : TopAbs_REVERSED));
    }
    wire.Closed(true);
    builder_.Add(face, wire);
    builder_.NaturalRestriction(face, true);
    if (joints_.turned[patch]) face.Reverse();
    return face;
  }

  [[nodiscard]] Handle(Geom2d_Curve) line(std::size_t patch, PatchSide side) const {
    const JointUse& use = joints_.sides[patch][side];
    return line_between(corner(patches_[patch], side, !use.along),
                        corner(patches_[patch], side, use.along),
                        domain(joints_.edges[use.edge].curve));
  }

  /// The edge learns where it lies in the face: once, or on both sides of a seam.
  void place(const TopoDS_Face& face, std::size_t patch, PatchSide side) {
    const JointUse& use = joints_.sides[patch][side];
    const JointEdge& joint = joints_.edges[use.edge];
    const TopoDS_Edge& edge = edges_[use.edge];
    const double tolerance = tolerance_for(joint.gap);
    const PatchSide across = opposite(side);
    if (joints_.sides[patch][across].edge == use.edge) {
      if (!runs_with_boundary(side)) return;  // both at once
      builder_.UpdateEdge(edge, line(patch, side), line(patch, across), face, tolerance);
      builder_.Continuity(edge, face, face, GeomAbs_C0);
    } else {
      builder_.UpdateEdge(edge, line(patch, side), face, tolerance);
    }
    const Range range = domain(joint.curve);
    builder_.Range(edge, face, range.from, range.to);
    if (!use.other_parameters) return;
    builder_.SameParameter(edge, false);  // the line in the face gets the pace of the edge
    BRepLib::SameParameter(edge, tolerance);
  }

  const std::vector<NurbsSurface>& patches_;
  Joints joints_;
  BRep_Builder builder_;
  std::vector<TopoDS_Vertex> vertices_;
  std::vector<TopoDS_Edge> edges_;
};

bool is_inside_out(const std::vector<NurbsSurface>& patches, const Joints& joints,
                   const Joined& group) {
  const Vec3 centre = patches[group.patches.front()].points.front();
  double sum = 0.0;
  for (const std::size_t i : group.patches) {
    sum += (joints.turned[i] ? -1.0 : 1.0) * volume_from(patches[i], centre).value;
  }
  return sum < 0.0;
}

/// A face alone, else a shell; with all borders shared a solid.
TopoDS_Shape shape_of(const std::vector<NurbsSurface>& patches, const Joints& joints,
                      const Joined& group, const std::vector<TopoDS_Face>& faces) {
  if (group.patches.size() == 1 && !group.closed) return faces[group.patches.front()];
  BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (const std::size_t i : group.patches) builder.Add(shell, faces[i]);
  shell.Closed(group.closed);
  if (!group.closed) return shell;
  if (is_inside_out(patches, joints, group)) shell.Reverse();
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

TopoDS_Shape together(const std::vector<TopoDS_Shape>& shapes) {
  if (shapes.size() == 1) return shapes.front();
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& shape : shapes) builder.Add(all, shape);
  return all;
}

/// Patches in the kernel's unit, cut at their creases.
struct Parts {
  std::vector<NurbsSurface> surfaces;
  std::vector<std::string> names;
};

Result<Parts> parts_of(const SurfaceModel& model, double scale) {
  Parts out;
  std::size_t by_creases = 0;
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    NurbsSurface surface = model.patches[i].surface;
    const std::string& given = model.patches[i].name;
    const std::string name = given.empty() ? fmt::format("patch {}", i + 1) : given;
    for (Vec3& p : surface.points) p = scale * p;
    if (auto fine = check(surface); !fine) {
      Error error = fine.error();
      error.where = error.where.empty() ? name : name + ", " + error.where;
      return fail(std::move(error));
    }
    auto parts = without_creases(surface, 1 + kMostCreasedFaces - by_creases);
    if (parts.empty()) {
      return error(ErrorCode::kUnsupported,
                   fmt::format("the creases cut the model into more than {} more faces",
                               kMostCreasedFaces))
          .where(name)
          .hint("write .stl, .obj or .glb, or make the surfaces of a higher degree")
          .value(static_cast<double>(kMostCreasedFaces));
    }
    const std::size_t count = parts.size();
    by_creases += count - 1;
    for (std::size_t k = 0; k < count; ++k) {
      out.names.push_back(count == 1 ? name : fmt::format("{}, part {} of {}", name, k + 1, count));
      out.surfaces.push_back(std::move(parts[k]));
    }
  }
  if (!out.surfaces.empty()) return out;
  return error(ErrorCode::kNothingThere, "the model has no surfaces")
      .where(model.name)
      .hint("make a surface first");
}

bool is_valid(const TopoDS_Shape& shape) { return BRepCheck_Analyzer(shape).IsValid(); }

Error not_valid(const std::string& name) {
  return error(ErrorCode::kInternal, "the CAD kernel finds no valid face on this surface")
      .where(name)
      .hint("look at it with `obvid surface check`");
}

Result<void> check_size(const SurfaceModel& model, double size) {
  if (size > 0.0 && size < kLargest) return {};
  return error(ErrorCode::kSizeOutOfRange, fmt::format("the size of the model is {:.3g} mm", size))
      .where(model.name)
      .hint("check the points and their unit")
      .value(size);
}

/// Of the size: what the kernel may be off where it makes curves in space of those of parameters.
constexpr double kEdges = 1e-8;

/// Faces of one patch with its trims, named.
Result<void> add_trimmed(SurfacePatch patch, double scale, double size, NamedFaces& out) {
  for (Vec3& p : patch.surface.points) p = scale * p;
  if (auto fine = check(patch); !fine) {
    Error error = fine.error();
    error.where = patch.name;
    return fail(std::move(error));
  }
  // the kernel at times does not know inside from outside of a loop whose edges are divided in an
  // unlucky way, whatever its curve; divided in another way it is the same face
  std::vector<TopoDS_Face> faces;
  for (const std::size_t edges : {1, 2, 3, 5, 7}) {
    faces = trimmed_faces(patch, std::max(Precision::Confusion(), kEdges * size), edges);
    if (std::all_of(faces.begin(), faces.end(), [](const auto& face) { return is_valid(face); })) {
      break;
    }
  }
  for (std::size_t k = 0; k < faces.size(); ++k) {
    out.faces.push_back(faces[k]);
    out.names.push_back(faces.size() == 1
                            ? patch.name
                            : fmt::format("{}, part {} of {}", patch.name, k + 1, faces.size()));
  }
  return {};
}

/// With trims: each face for itself, then edges that lie on each other made one.
Result<NamedFaces> trimmed_faces_of(const SurfaceModel& model, double scale) {
  const double size = scale * size_of(model);
  OBVID_TRY(check_size(model, size));
  NamedFaces out;
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    SurfacePatch patch = model.patches[i];
    if (patch.name.empty()) patch.name = fmt::format("patch {}", i + 1);
    if (!patch.trims.empty()) {
      OBVID_TRY(add_trimmed(std::move(patch), scale, size, out));
      continue;
    }
    SurfaceModel alone;
    alone.patches.push_back(std::move(patch));
    auto parts = parts_of(alone, scale);
    OBVID_TRY(parts);
    std::vector<const NurbsSurface*> pointers;
    for (const NurbsSurface& one : parts->surfaces) pointers.push_back(&one);
    const Topology topology = topology_of(pointers, kSameBorder * size);
    for (TopoDS_Face& face :
         Builder(parts->surfaces, joints_of(parts->surfaces, topology, JoinedWith::kItself))
             .faces()) {
      out.faces.push_back(std::move(face));
    }
    out.names.insert(out.names.end(), parts->names.begin(), parts->names.end());
  }
  for (std::size_t i = 0; i < out.faces.size(); ++i) {
    if (!is_valid(out.faces[i])) return fail(not_valid(out.names[i]));
  }
  std::vector<TopoDS_Face> joined = out.faces;
  out.shape = sewn(joined, kSameBorder * size);
  if (is_valid(out.shape)) {
    out.faces = std::move(joined);
  } else {
    out.shape = together({out.faces.begin(), out.faces.end()});
  }
  return out;
}

}  // namespace

Result<NamedFaces> faces_of(const SurfaceModel& model, double scale) {
  if (is_trimmed(model)) return trimmed_faces_of(model, scale);
  auto parts = parts_of(model, scale);
  OBVID_TRY(parts);
  const std::vector<NurbsSurface>& patches = parts->surfaces;
  std::vector<const NurbsSurface*> pointers;
  for (const NurbsSurface& patch : patches) pointers.push_back(&patch);
  const double size = size_of(pointers);
  OBVID_TRY(check_size(model, size));
  const Topology topology = topology_of(pointers, kSameBorder * size);
  Builder builder(patches, joints_of(patches, topology, JoinedWith::kAll));
  std::vector<TopoDS_Face> faces = builder.faces();
  std::vector<TopoDS_Face> apart;  // made when a shell is not valid
  std::vector<TopoDS_Shape> shapes;
  for (const Joined& group : builder.joints().groups) {
    TopoDS_Shape shape = shape_of(patches, builder.joints(), group, faces);
    if (is_valid(shape)) {
      shapes.push_back(shape);
      continue;
    }
    if (apart.empty()) {
      apart = Builder(patches, joints_of(patches, topology, JoinedWith::kItself)).faces();
    }
    for (const std::size_t i : group.patches) {
      if (!is_valid(apart[i])) return fail(not_valid(parts->names[i]));
      faces[i] = apart[i];
      shapes.push_back(apart[i]);
    }
  }
  return NamedFaces{together(shapes), std::move(faces), std::move(parts->names)};
}

}  // namespace obvid::cad
