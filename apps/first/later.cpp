// SPDX-License-Identifier: Apache-2.0
// What the launcher's first program does not hold: it goes on in the whole one, which is built when
// it is first needed. cmake/ObvidFirst.cmake says which sources it is made of.
#include "audit_report.h"
#include "commands.h"
#include "files/format_writers.h"
#include "fit/aligned_lines.h"
#include "obvid/alignment/profile.h"
#include "obvid/alignment/transition.h"
#include "obvid/cad/internal/cad.h"
#include "obvid/exchange/internal/dxf/read.h"
#include "obvid/exchange/internal/gcode/dialect.h"
#include "obvid/exchange/internal/gcode/path.h"
#include "obvid/exchange/internal/geo/geojson.h"
#include "obvid/exchange/internal/geo/gpx.h"
#include "obvid/exchange/internal/points/airfoil.h"
#include "obvid/exchange/internal/points/solidworks.h"
#include "obvid/exchange/internal/road/landxml.h"
#include "obvid/exchange/internal/road/opendrive.h"
#include "obvid/exchange/internal/svg/drawing.h"
#include "obvid/exchange/internal/svg/read.h"
#include "obvid/exchange/internal/whole_arcs.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/internal/private_copy.h"
#include "obvid/io/read_sections.h"
#include "obvid/pipeline/alignment_job.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/construction_fit.h"
#include "obvid/pipeline/internal/export_together.h"
#include "obvid/pipeline/internal/mesh_sections.h"
#include "obvid/pipeline/internal/page_text.h"
#include "obvid/pipeline/space_fit.h"
#include "obvid/pipeline/trade_off.h"
#include "space_fit.h"
#include "start.h"
#include "suggest.h"
#include "verify/false_claim.h"

// NOLINTBEGIN(misc-unused-parameters)
#define OBVID_LATER(...) \
  __VA_ARGS__ { go_on_in_the_whole_program(); }

namespace obvid {

// ---- commands ---------------------------------------------------------------------------------
OBVID_LATER(Result<Command> parse_alignment(int, const char* const*))
OBVID_LATER(Result<Command> parse_surface(int, const char* const*))
OBVID_LATER(Result<Command> parse_spline(int, const char* const*))
OBVID_LATER(Result<Command> parse_nurbs(int, const char* const*))
OBVID_LATER(Result<Command> parse_toolpath(int, const char* const*))
OBVID_LATER(Result<Command> parse_cut(int, const char* const*))
OBVID_LATER(int run(const AlignmentCommand&))
OBVID_LATER(int run(const RegionOptions&))
OBVID_LATER(int run(const CompareOptions&))
OBVID_LATER(int run(const ConvertOptions&))
OBVID_LATER(int run(const VerifyOptions&))
OBVID_LATER(int run(const SurfaceOptions&))
OBVID_LATER(int run(const SurfaceCheckOptions&))
OBVID_LATER(int run(const SurfaceCutOptions&))
OBVID_LATER(int run(const SplineOptions&))
OBVID_LATER(int run(const NurbsOptions&))
OBVID_LATER(int run(const ToolpathCommand&))
OBVID_LATER(int run(const CutCommand&))

// ---- tables of tolerances, drawings as they are, pages ----------------------------------------
OBVID_LATER(int suggest(const FitOptions&))
OBVID_LATER(std::string trade_off_rule(const TradeOff&))
OBVID_LATER(Result<AnalysedDrawing> analysed_drawing(const AnalyseOptions&))
OBVID_LATER(int audit_drawing(const AnalyseOptions&))
OBVID_LATER(Result<CurveAudit> audit(const DrawnCurve&, const Units&, const RunContext&))
OBVID_LATER(const char* to_string(AuditPlace::Kind))
OBVID_LATER(std::string as_drawn(const CurveAudit&))
OBVID_LATER(std::string page_text(const ReportPage&))
OBVID_LATER(std::string table_of_page(std::string_view, std::string_view, const DataTable&))
namespace pipeline_detail {
OBVID_LATER(Result<Exported> contour_as_report(const ContourExport&))
OBVID_LATER(void add_false_claim(JsonText&, const Error*))
OBVID_LATER(std::vector<MeantPiece> aligned_lines(const MeasuredSeries&, std::optional<double>,
                                                  Watch&))
}  // namespace pipeline_detail

// ---- constructions, points in space -----------------------------------------------------------
OBVID_LATER(Result<Fit> fit_construction(const PointSeries&, const RegionJob&, const RunContext&))

std::optional<int> run_in_space(const FitOptions& options) {
  if (options.flat) return std::nullopt;
  const auto series = options.text
                          ? parse_space_series(*options.text, options.name(),
                                               options.along.has_value(), options.import)
                          : space_series(options.input, options.along.has_value(), options.import);
  if (options.along || (series && *series)) go_on_in_the_whole_program();
  return std::nullopt;
}

// ---- files of others --------------------------------------------------------------------------
OBVID_LATER(Result<StoredContour> contour_from_json(std::string_view, std::string_view, Watch*))
OBVID_LATER(Result<ParsedSections> parse_sections(std::string_view, std::string_view,
                                                  const SectionOptions&, const RunContext&))
OBVID_LATER(Result<PrivateCopy> PrivateCopy::of(std::string_view, const std::string&))
PrivateCopy::~PrivateCopy() = default;  // of none
OBVID_LATER(Result<PlaneRow> plane_row_named(const std::string&))
namespace pipeline_detail {
OBVID_LATER(Result<Drawing> sections_of_mesh(std::string_view, const std::string&,
                                             const std::vector<PlaneRow>&, const RunContext&))
}  // namespace pipeline_detail
OBVID_LATER(Result<Drawing> parse_dxf(std::string_view, std::string_view))
OBVID_LATER(Result<Drawing> parse_svg(std::string_view, std::string_view))
OBVID_LATER(Result<Drawing> parse_gpx(std::string_view, std::string_view))
OBVID_LATER(Result<Drawing> parse_geojson(std::string_view, std::string_view))
OBVID_LATER(Result<Drawing> parse_landxml(std::string_view, std::string_view))
OBVID_LATER(Result<Drawing> parse_opendrive(std::string_view, std::string_view))
OBVID_LATER(Result<Drawing> read_cad(const std::string&, const CadRun&))
OBVID_LATER(Result<void> check_cad())
OBVID_LATER(Result<std::string> cad_text(const std::vector<CadCurve>&, const CadWriteOptions&,
                                         const CadRun&))
namespace exchange {
OBVID_LATER(Result<void> check_gcode_decimals(std::optional<int>))
}  // namespace exchange
OBVID_LATER(std::string dxf_unit(const Units&))
OBVID_LATER(Result<DxfText> dxf_text(const Contour&, const DxfOptions&, Watch*))
OBVID_LATER(Result<void> can_export_together(FileFormat, const ExportOptions&))
OBVID_LATER(Result<Exported> export_together(const std::vector<TitledContour>&, FileFormat,
                                             const ExportOptions&, const RunContext&))
OBVID_LATER(Result<GcodeText> gcode_text(const Contour&, const GcodeOptions&, Watch*))
OBVID_LATER(std::vector<Piece> exchange::whole_arcs(const std::vector<Piece>&))
OBVID_LATER(const char* exchange::machine_unit(const Units&))
OBVID_LATER(std::size_t elements_in(std::size_t, const std::vector<PlacedTransition>&))
OBVID_LATER(DataTable profile_rows(const VerticalProfile&))
OBVID_LATER(std::string_view landxml_unit(std::string_view))
OBVID_LATER(Result<std::string> landxml_text(const Contour&, const LandXmlOptions&))
OBVID_LATER(Result<std::string> opendrive_text(const Contour&, const OpenDriveOptions&))
OBVID_LATER(Result<SvgDrawing> svg_drawing(const Contour&, const SvgDrawingOptions&, Watch*))
OBVID_LATER(Result<std::string> samples_csv(const Contour&, const SampleOptions&, Watch*))
OBVID_LATER(Result<AirfoilText> airfoil_text(const Contour&, const AirfoilOptions&))
OBVID_LATER(Vec2 grades_meet(const ProfileElement&, ProfileCurves))
OBVID_LATER(std::optional<AirfoilPointFigures> airfoil_point_figures(std::span<const Vec2>,
                                                                     const AirfoilFigures&))
OBVID_LATER(Result<std::string> obj_text(const Contour&, const SampleOptions&, Watch*))
OBVID_LATER(Result<std::string> ply_text(const Contour&, const SampleOptions&, Watch*))
OBVID_LATER(Result<std::vector<SldcrvFile>> sldcrv_files(const Contour&, const SampleOptions&,
                                                         Watch*))
OBVID_LATER(Result<std::string> solidworks_macro(const Contour&, const SampleOptions&, Watch*))

}  // namespace obvid
// NOLINTEND(misc-unused-parameters)
