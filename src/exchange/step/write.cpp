// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/step/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "step/curves.h"
#include "step/faces.h"
#include "step/file.h"

namespace obvid {
namespace {

using exchange::step_list;
using exchange::step_string;
using exchange::step_value;
using exchange::StepChain;
using exchange::StepCurves;
using exchange::StepFile;
using exchange::StepId;

/// Points nearer than this are one for CAD kernels.
constexpr double kSamePoint = 1e-7;  // mm

/// How a unit is told: SI with a prefix, or by its length in millimetres.
struct StepUnit {
  std::string_view name;
  const char* prefix;     ///< of METRE; nullptr: converted
  const char* converted;  ///< name of a CONVERSION_BASED_UNIT
};
constexpr StepUnit kStepUnits[] = {
    {"um", ".MICRO.", nullptr}, {"mm", ".MILLI.", nullptr}, {"cm", ".CENTI.", nullptr},
    {"m", "$", nullptr},        {"km", ".KILO.", nullptr},  {"mil", nullptr, "MIL"},
    {"in", nullptr, "INCH"},    {"ft", nullptr, "FOOT"},    {"mi", nullptr, "MILE"}};
static_assert(std::equal(std::begin(kStepUnits), std::end(kStepUnits), std::begin(kCadUnits),
                         std::end(kCadUnits),
                         [](const StepUnit& a, std::string_view b) { return a.name == b; }));

struct SchemaText {
  const char* schema;    ///< of the header
  const char* protocol;  ///< short name, year
  const char* context;
};
SchemaText schema_text(StepSchema schema) {
  if (schema == StepSchema::kAp242) {
    return {"AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF {1 0 10303 442 1 1 4 }",
            "'ap242_managed_model_based_3d_engineering',2013",
            "Managed model based 3d engineering"};
  }
  return {"AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }", "'automotive_design',2000",
          "core data for automotive mechanical design processes"};
}

class StepDocument {
 public:
  StepDocument(std::string name, const StepOptions& options, const StepUnit& unit, double mm,
               Watch* watch)
      : name_(std::move(name)),
        options_(options),
        unit_(unit),
        mm_(mm),
        file_(watch),
        curves_(file_) {}

  std::string run(const std::vector<StepChain>& chains, const std::vector<SpaceCurve>& spatial,
                  double width) {
    context();
    const StepId wires = wireframe(chains, spatial);
    const StepId product = product_shape();
    if (width > 0.0) {
      const StepId both = add("SHAPE_REPRESENTATION('',({}),{})", curves_.origin(), context_);
      add("SHAPE_DEFINITION_REPRESENTATION({},{})", product, both);
      add("SHAPE_REPRESENTATION_RELATIONSHIP('','',{},{})", both, wires);
      add("SHAPE_REPRESENTATION_RELATIONSHIP('','',{},{})", both, faces(chains, width));
    } else {
      add("SHAPE_DEFINITION_REPRESENTATION({},{})", product, wires);
    }
    return file_.text(name_, schema_text(options_.schema).schema);
  }

 private:
  template <class>
  using AsText = std::string;

  /// A record with values and other instances in its places.
  template <class... Part>
  StepId add(fmt::format_string<AsText<Part>...> form, const Part&... parts) {
    return file_.add(fmt::format(form, as_text(parts)...));
  }
  static std::string as_text(StepId id) { return step_value(id); }
  static std::string as_text(double value) { return step_value(value); }
  static std::string as_text(const std::string& text) { return text; }
  static std::string as_text(const char* text) { return text; }

  StepId length_unit() {
    const char* form = "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({},.METRE.))";
    if (unit_.prefix != nullptr) return file_.add(fmt::format(fmt::runtime(form), unit_.prefix));
    const StepId millimetre = file_.add(fmt::format(fmt::runtime(form), ".MILLI."));
    const StepId size = add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
    const StepId measure = add("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),{})", mm_, millimetre);
    return add("(CONVERSION_BASED_UNIT('{}',{})LENGTH_UNIT()NAMED_UNIT({}))", unit_.converted,
               measure, size);
  }

  void context() {
    const StepId length = length_unit();
    const StepId angle = add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    const StepId solid = add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    const StepId accuracy =
        add("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),{},'distance_accuracy_value',"
            "'points that are one')",
            kSamePoint / mm_, length);
    context_ =
        add("(GEOMETRIC_REPRESENTATION_CONTEXT(3)"
            "GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({}))"
            "GLOBAL_UNIT_ASSIGNED_CONTEXT(({},{},{}))REPRESENTATION_CONTEXT('',''))",
            accuracy, length, angle, solid);
  }

  StepId wireframe(const std::vector<StepChain>& chains, const std::vector<SpaceCurve>& spatial) {
    std::vector<StepId> all;
    for (const StepChain& chain : chains) all.push_back(curves_.whole(chain));
    for (const SpaceCurve& curve : spatial) all.push_back(curves_.spline(curve));
    const StepId set = add("GEOMETRIC_CURVE_SET('',{})", step_list<StepId>(all));
    return add("GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',({},{}),{})",
               curves_.origin(), set, context_);
  }

  StepId faces(const std::vector<StepChain>& chains, double width) {
    std::vector<StepId> shells;
    for (const StepChain& chain : chains) {
      shells.push_back(step_shell(chain, width, file_, curves_));
    }
    const StepId model = add("SHELL_BASED_SURFACE_MODEL('',{})", step_list<StepId>(shells));
    return add("MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',({},{}),{})", curves_.origin(), model,
               context_);
  }

  StepId product_shape() {
    const SchemaText text = schema_text(options_.schema);
    const std::string name = step_string(name_);
    const StepId application = add("APPLICATION_CONTEXT('{}')", text.context);
    add("APPLICATION_PROTOCOL_DEFINITION('international standard',{},{})", text.protocol,
        application);
    const StepId mechanical = add("PRODUCT_CONTEXT('',{},'mechanical')", application);
    const StepId product = add("PRODUCT({},{},'',({}))", name, name, mechanical);
    add("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({}))", product);
    const StepId formation = add("PRODUCT_DEFINITION_FORMATION('','',{})", product);
    const StepId design =
        add("PRODUCT_DEFINITION_CONTEXT('part definition',{},'design')", application);
    const StepId definition = add("PRODUCT_DEFINITION('design','',{},{})", formation, design);
    return add("PRODUCT_DEFINITION_SHAPE('','',{})", definition);
  }

  std::string name_;
  const StepOptions& options_;
  const StepUnit& unit_;
  double mm_;  ///< in the unit of the file
  StepFile file_;
  StepCurves curves_;
  StepId context_;
};

}  // namespace

Result<std::string> step_text(const std::vector<CadCurve>& curves, const StepOptions& options,
                              Watch* watch) {
  const std::string_view written = cad_unit(options.units);
  const auto known = unit_ratio(Units(options.units), "mm", "STEP files");
  OBVID_TRY(known);
  if (curves.empty()) {
    return error(ErrorCode::kNothingThere, "there are no curves to write");
  }
  const auto* unit = std::find_if(std::begin(kStepUnits), std::end(kStepUnits),
                                  [&](const StepUnit& one) { return one.name == written; });
  const double scale = written == options.units ? 1.0 : *unit_ratio(options.units, written);
  const double mm = *unit_ratio(written, "mm");
  std::vector<StepChain> chains;
  std::vector<SpaceCurve> spatial;
  for (const CadCurve& curve : curves) {
    if (const auto* one = std::get_if<SpaceCurve>(&curve.geometry)) {
      OBVID_TRY(check(*one));
      if (options.face_width > 0.0) {
        return error(ErrorCode::kUnsupported, "faces are made of plane curves only")
            .hint("leave --face out");
      }
      spatial.push_back(*one);
      for (Vec3& point : spatial.back().points) point = scale * point;
      continue;
    }
    auto chain = exchange::step_chain(curve, scale, kSamePoint / mm);
    OBVID_TRY(chain);
    chains.push_back(std::move(*chain));
  }
  const std::string& name = curves.front().name;
  std::string text = StepDocument(name.empty() ? "contour" : name, options, *unit, mm, watch)
                         .run(chains, spatial, scale * options.face_width);
  if (is_to_end(watch)) return fail(cancelled_error());
  return text;
}

}  // namespace obvid
