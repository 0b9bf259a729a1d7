// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/export_together.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "advice/uniform_tolerance.h"
#include "files/file_units.h"
#include "files/format_writers.h"
#include "obvid/core/internal/figures.h"
#include "obvid/exchange/internal/svg/drawing.h"
#include "obvid/pipeline/internal/can_write.h"
#include "obvid/pipeline/internal/format_table.h"

namespace obvid {
namespace pipeline_detail {

/// Contours of one file, and what each of them is written with.
struct Together {
  const std::vector<TitledContour>& contours;
  std::vector<ContourExport> all;
  const ExportOptions& options;
  Watch& watch;

  [[nodiscard]] const Units& units() const { return contours.front().stored.contour.units; }
};

#define OBVID_FORMAT(enumerator, endings, contours, surfaces, curves, together, ...) \
  Result<Exported> together_as_##together(const Together& asked);
#include "obvid/pipeline/formats.inc"
#undef OBVID_FORMAT

namespace {

/// By what a contour without a layer is known.
const std::string& id_of(const TitledContour& contour) {
  return contour.id.empty() ? contour.name : contour.id;
}

const std::string& layer_named(const TitledContour& contour) {
  return contour.layer.empty() ? id_of(contour) : contour.layer;
}

std::string within(double deviation, const Units& units) {
  if (!(deviation > 0.0)) return "exact";
  return fmt::format("at most {:.3g} {} from the contours", printable(deviation), units.text());
}

/// What kernels would not keep is told once.
Result<Exported> curves_of_cad(const Together& asked, CadFormat format) {
  const bool plain = format == CadFormat::kBrep;
  Exported out;
  std::vector<CadCurve> curves;
  std::set<std::string> told;
  double deviation = 0.0;
  std::size_t splines = 0, in_pieces = 0;
  for (std::size_t i = 0; i < asked.all.size(); ++i) {
    const ContourExport& e = asked.all[i];
    OBVID_TRY(kernel_holds(e.size, e.contour.units, plain, "write .dxf"));
    auto made = cad_curve(e);
    OBVID_TRY(made);
    deviation = std::max(deviation, made->deviation);
    in_pieces += made->in_pieces.empty() ? 0 : 1;
    if (std::holds_alternative<NurbsCurve>(made->curve.geometry)) {
      ++splines;
    } else if (auto remark = below_kernels(e.contour.pieces, e.contour.units, plain)) {
      if (told.insert(*remark).second) {
        out.remarks.push_back(id_of(asked.contours[i]) + ": " + *remark);
      }
    }
    made->curve.name = id_of(asked.contours[i]);
    curves.push_back(std::move(made->curve));
  }
  CadWriteOptions write;
  write.format = format;
  write.units = asked.units().name;
  write.face_width = asked.options.face_width;
  auto text = cad_text(curves, write, {{}, [&asked] { return is_to_end(&asked.watch); }});
  OBVID_TRY(text);
  out.files.push_back({"", std::move(*text)});
  out.remarks.push_back(
      fmt::format("{}, {} of them one NURBS curve{}", counted(curves.size(), "curve", "curves"),
                  splines, in_pieces == 0 ? "" : fmt::format(", {} piece by piece", in_pieces)));
  if (deviation > 0.0) {
    out.remarks.push_back(
        fmt::format("clothoids are no NURBS curves: C2 cubics follow them within {:.3g} {}",
                    printable(deviation), asked.units().text()));
  }
  return out;
}

std::string formats_of_several() {
  std::string out;
  for (const FormatRow& row : kFormats) {
    if (!row.several) continue;
    out += fmt::format("{}{}", out.empty() ? "" : ", ", row.ending());
  }
  return out;
}

}  // namespace

/// A layer for each.
Result<Exported> together_as_dxf(const Together& asked) {
  const DxfProfile profile = asked.options.dxf;
  const bool arcs = profile == DxfProfile::kArcs || profile == DxfProfile::kArcsR12;
  std::vector<DxfCurve> curves;
  for (std::size_t i = 0; i < asked.all.size(); ++i) {
    const ContourExport& e = asked.all[i];
    curves.push_back(
        {e.contour, layer_named(asked.contours[i]), arcs ? e.arc_tolerance : e.tolerance});
  }
  auto made = dxf_text(curves, profile, &asked.watch);
  OBVID_TRY(made);
  Exported out{{{"", std::move(made->text)}}, {}, {}};
  out.remarks.push_back(fmt::format("{} as {} on {}, {}", counted(curves.size(), "curve", "curves"),
                                    counted(made->entities, "entity", "entities"),
                                    counted(made->layers, "layer", "layers"),
                                    within(made->deviation, asked.units())));
  if (made->renamed > 0) {
    out.remarks.push_back(fmt::format("{} called otherwise, for what DXF forbids in names",
                                      counted(made->renamed, "layer is", "layers are")));
  }
  return out;
}

/// A path for each.
Result<Exported> together_as_svg(const Together& asked) {
  std::vector<SvgCurve> curves;
  for (std::size_t i = 0; i < asked.all.size(); ++i) {
    const ContourExport& e = asked.all[i];
    const TitledContour& contour = asked.contours[i];
    curves.push_back({e.contour, id_of(contour), contour.layer, e.arc_tolerance});
  }
  auto made = svg_drawing(curves, {}, &asked.watch);
  OBVID_TRY(made);
  Exported out{{{"", std::move(made->text)}}, {}, {}};
  out.remarks.push_back(fmt::format("{} in true scale, a path each, {}",
                                    counted(curves.size(), "curve", "curves"),
                                    within(made->deviation, asked.units())));
  return out;
}

Result<Exported> together_as_step(const Together& asked) {
  return curves_of_cad(asked, asked.options.step);
}

Result<Exported> together_as_iges(const Together& asked) {
  return curves_of_cad(asked, CadFormat::kIges);
}

Result<Exported> together_as_brep(const Together& asked) {
  return curves_of_cad(asked, CadFormat::kBrep);
}

Result<Exported> together_as_none(const Together&) { return fail(not_held_by_format()); }

namespace {

Result<Exported> made_together(const Together& asked, FileFormat format) {
  constexpr std::array kWriters = {
#define OBVID_FORMAT(enumerator, endings, contours, surfaces, curves, together, ...) \
  &together_as_##together,
#include "obvid/pipeline/formats.inc"
#undef OBVID_FORMAT
  };
  return kWriters[static_cast<std::size_t>(format)](asked);
}

}  // namespace
}  // namespace pipeline_detail

Result<void> can_export_together(FileFormat format, const ExportOptions& options) {
  using namespace pipeline_detail;
  const auto row = std::find_if(kFormats.begin(), kFormats.end(),
                                [&](const FormatRow& one) { return one.format == format; });
  if (!row->several) {
    const std::string cut = format == FileFormat::kGcode
                                ? "; `obvid cut` makes one program of all outlines of a drawing"
                                : "";
    return error(ErrorCode::kBadOption,
                 fmt::format("several contours cannot go to one file: {} ({}) holds one",
                             row->ending(), row->contour))
        .hint(fmt::format("put {{id}} into its name, which becomes the name of each input: -o "
                          "'fair/{{id}}{}'; {} hold them all{}",
                          row->ending(), formats_of_several(), cut));
  }
  if (format == FileFormat::kPicture && (options.plots.deviations || options.plots.slope)) {
    return error(ErrorCode::kBadOption, "a drawing of several contours has no plot")
        .where("--plot")
        .hint("put {id} into the name for a picture of each: -o '{id}.svg'");
  }
  return can_write_curves(format);
}

Result<Exported> export_together(const std::vector<TitledContour>& contours, FileFormat format,
                                 const ExportOptions& options, const RunContext& run) {
  using namespace pipeline_detail;
  OBVID_TRY(may_go_on(run));
  OBVID_TRY(can_export_together(format, options));
  if (contours.empty()) return error(ErrorCode::kNothingThere, "there are no curves to write");
  Watch watch(run);
  Together all{contours, {}, options, watch};
  for (const TitledContour& one : contours) {
    const Units& units = one.stored.contour.units;
    if (units.name != all.units().name) {
      return error(
                 ErrorCode::kBadOption,
                 fmt::format("one file has one unit: {} is in {}, {} in {}",
                             contours.front().source, all.units().text(), one.source, units.text()))
          .hint("put {id} into its name, for a file of each");
    }
    all.all.push_back(contour_export(one.stored, options, &watch));
  }
  const auto notes = unit_notes(all.units(), format);
  OBVID_TRY(notes);
  auto made = made_together(all, format);
  if (watch.was_cancelled()) return fail(cancelled_error());
  OBVID_TRY(made);
  made->remarks.insert(made->remarks.end(), notes->remarks.begin(), notes->remarks.end());
  made->warnings.insert(made->warnings.end(), notes->warnings.begin(), notes->warnings.end());
  return made;
}

}  // namespace obvid
