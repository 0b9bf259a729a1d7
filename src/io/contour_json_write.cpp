// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "contour_json_names.h"
#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/core/internal/format_into.h"
#include "obvid/core/internal/questions.h"
#include "obvid/io/contour_json.h"
#include "text_lines.h"

namespace obvid {
namespace {

/// Writes the file front to back into one buffer: one point, element, piece or segment a line, so
/// that people can read and compare files.
class Writer {
 public:
  explicit Writer(Watch* watch = nullptr) : watch_(watch), questions_(watch) {}

  std::string write(const StoredContour& stored);
  std::string write(const FitReport& value);
  std::string write(const Certificate& value);

 private:
  void raw(std::string_view text) { buffer_.append(text); }
  void number(double value);
  void text(std::string_view value);
  void point(Vec2 p);
  void flag(bool value) { raw(value ? "true" : "false"); }
  void figure(std::string_view name, double value);
  void optional_figure(std::string_view name, const std::optional<double>& value);
  void count(std::string_view name, long long value);
  void claim(std::string_view name, bool value);
  void figures(std::string_view name, const std::vector<double>& values);

  template <class List, class Write>
  void inline_list(const List& list, Write write);
  template <class List, class Write>
  void line_list(std::string_view name, const List& list, std::string_view indent, Write write);

  void element(const Joint& joint);
  void piece(const LinePiece& line);
  void piece(const ArcPiece& arc);
  void piece(const ClothoidPiece& clothoid);
  void piece(const RationalBezier& bezier);
  void given(const GivenDatum& one);
  void range(std::string_view name, const ValueRange& range);
  void given(const GivenReport& report);
  void segment(const SegmentReport& row);
  void proof(std::size_t index, const PieceProof& proof);
  void alignment(const StoredAlignment& alignment);
  void profile(const VerticalProfile& profile);
  void one_nurbs(const NurbsCurve& curve);
  void report(const FitReport& report);
  void certificate(const Certificate& certificate);

  std::string buffer_;
  Watch* watch_;
  Questions questions_;
  std::size_t points_ = 0;  ///< of the contour
};

void Writer::number(double value) {
  if (!std::isfinite(value)) return raw("null");
  // "-0" would be read as the integer 0.
  if (value == 0.0) return raw(std::signbit(value) ? "-0.0" : "0");
  format_into(buffer_, "{}", value);
}

void Writer::text(std::string_view value) {
  buffer_.push_back('"');
  for (const char c : text::to_utf8(value)) {
    if (c == '"' || c == '\\') buffer_.push_back('\\');
    buffer_.push_back(c);
  }
  buffer_.push_back('"');
}

void Writer::point(Vec2 p) {
  buffer_.push_back('[');
  number(p.x);
  raw(", ");
  number(p.y);
  buffer_.push_back(']');
}

void Writer::figure(std::string_view name, double value) {
  format_into(buffer_, "\"{}\": ", name);
  number(value);
}

void Writer::optional_figure(std::string_view name, const std::optional<double>& value) {
  figure(name, value.value_or(std::numeric_limits<double>::quiet_NaN()));
}

void Writer::count(std::string_view name, long long value) {
  format_into(buffer_, "\"{}\": {}", name, value);
}

void Writer::claim(std::string_view name, bool value) {
  format_into(buffer_, "\"{}\": {}", name, value);
}

void Writer::figures(std::string_view name, const std::vector<double>& values) {
  format_into(buffer_, "\"{}\": ", name);
  inline_list(values, [&](double value) { number(value); });
}

template <class List, class Write>
void Writer::inline_list(const List& list, Write write) {
  buffer_.push_back('[');
  bool first = true;
  for (const auto& item : list) {
    if (questions_.end()) return;
    if (!first) raw(", ");
    first = false;
    write(item);
  }
  buffer_.push_back(']');
}

template <class List, class Write>
void Writer::line_list(std::string_view name, const List& list, std::string_view indent,
                       Write write) {
  format_into(buffer_, "{}\"{}\": [", indent, name);
  bool first = true;
  for (const auto& item : list) {
    if (questions_.end()) return;
    format_into(buffer_, "{}\n{}  ", first ? "" : ",", indent);
    first = false;
    write(item);
  }
  if (!first) format_into(buffer_, "\n{}", indent);
  buffer_.push_back(']');
}

void Writer::element(const Joint& joint) {
  raw("{\"point\": ");
  point(joint.element.point);
  raw(", ");
  figure("heading", joint.element.theta);
  raw(", ");
  figure("kappa", joint.element.kappa);
  raw(", \"source\": ");
  if (joint.source) {
    format_into(buffer_, "{}", *joint.source);
  } else {
    raw("null");
  }
  if (joint.leaving) {
    raw(is_corner(joint) ? ", \"corner\": true, " : ", \"curvature_step\": true, ");
    figure("heading_out", joint.leaving->theta);
    raw(", ");
    figure("kappa_out", joint.leaving->kappa);
  }
  if (joint.slope_step) raw(", \"slope_step\": true");
  if (joint.after) {
    const std::size_t next = *joint.after + 1 == points_ ? 0 : *joint.after + 1;
    format_into(buffer_, ", \"between\": [{}, {}]", *joint.after, next);
  }
  raw("}");
}

void Writer::piece(const LinePiece& line) {
  raw("{\"type\": \"line\", \"start\": ");
  point(line.start);
  raw(", \"end\": ");
  point(line.end);
  raw("}");
}

void Writer::piece(const ArcPiece& arc) {
  raw("{\"type\": \"arc\", \"start\": ");
  point(arc.start);
  raw(", \"end\": ");
  point(arc.end);
  raw(", ");
  figure("theta0", arc.theta0);
  raw(", ");
  figure("kappa", arc.kappa);
  raw(", ");
  figure("length", arc.length);
  raw("}");
}

void Writer::piece(const ClothoidPiece& clothoid) {
  raw("{\"type\": \"clothoid\", \"start\": ");
  point(clothoid.start);
  raw(", \"end\": ");
  point(clothoid.end);
  raw(", ");
  figure("theta0", clothoid.theta0);
  raw(", ");
  figure("kappa0", clothoid.kappa0);
  raw(", ");
  figure("kappa1", clothoid.kappa1);
  raw(", ");
  figure("length", clothoid.length);
  raw("}");
}

void Writer::piece(const RationalBezier& bezier) {
  const auto size = static_cast<std::size_t>(bezier.degree) + 1;
  const std::span<const Vec2> offsets(bezier.offset.data(), size);
  const std::span<const double> weights(bezier.weight.data(), size);
  const bool absolute = bezier.origin == Vec2{};
  raw("{\"type\": \"bezier\", \"points\": ");
  inline_list(offsets, [&](Vec2 offset) { point(absolute ? offset : bezier.origin + offset); });
  if (std::any_of(weights.begin(), weights.end(), [](double w) { return w != 1.0; })) {
    raw(", \"weights\": ");
    inline_list(weights, [&](double weight) { number(weight); });
  }
  if (!absolute) {
    raw(", \"exact\": {\"origin\": ");
    point(bezier.origin);
    raw(", \"offsets\": ");
    inline_list(offsets, [&](Vec2 offset) { point(offset); });
    raw("}");
  }
  raw("}");
}

void Writer::segment(const SegmentReport& row) {
  raw("{");
  if (row.from && row.to) {
    fmt::format_to(std::back_inserter(buffer_), "\"points\": [{}, {}], ", *row.from, *row.to);
  }
  figure("chord", row.chord);
  raw(", ");
  figure("points_only_error", row.points_only_error);
  raw(", ");
  figure("width", row.width);
  raw(", ");
  if (!std::isnan(row.width_unrefined)) {  // a file read without it claims nothing
    figure("width_unrefined", row.width_unrefined);
    raw(", ");
  }
  figure("deviation", row.deviation);
  if (!std::isnan(row.deviation_at.x)) {
    raw(", \"deviation_at\": ");
    point(row.deviation_at);
  }
  raw(", ");
  count("inserted", static_cast<long long>(row.inserted));
  raw("}");
}

void Writer::given(const GivenDatum& one) {
  raw("{");
  count("point", static_cast<long long>(one.point));
  if (one.theta) {
    raw(", ");
    figure("heading", *one.theta);
  }
  if (one.kappa) {
    raw(", ");
    figure("kappa", *one.kappa);
  }
  if (one.thetas) range("heading_range", *one.thetas);
  if (one.kappas) range("kappa_range", *one.kappas);
  if (one.corner) raw(", \"corner\": true");
  raw("}");
}

/// Ends that are none are null.
void Writer::range(std::string_view name, const ValueRange& range) {
  raw(", \"");
  raw(name);
  raw("\": [");
  number(range.low);
  raw(", ");
  number(range.high);
  raw("]");
}

void Writer::given(const GivenReport& report) {
  raw("\"given\": {");
  count("headings", static_cast<long long>(report.headings));
  raw(", ");
  count("curvatures", static_cast<long long>(report.curvatures));
  raw(", ");
  count("corners", static_cast<long long>(report.corners));
  raw(", ");
  figure("heading_miss", report.heading_miss);
  raw(", ");
  figure("curvature_miss", report.curvature_miss);
  if (report.heading_ranges + report.curvature_ranges > 0) {
    raw(", ");
    count("heading_ranges", static_cast<long long>(report.heading_ranges));
    raw(", ");
    count("curvature_ranges", static_cast<long long>(report.curvature_ranges));
    raw(", \"active\": [");
    for (std::size_t k = 0; k < report.active.size(); ++k) {
      const ActiveRange& one = report.active[k];
      raw(k > 0 ? ", {" : "{");
      count("point", static_cast<long long>(one.point));
      raw(one.heading ? ", \"datum\": \"heading\"" : ", \"datum\": \"curvature\"");
      raw(one.high ? ", \"end\": \"greatest\"}" : ", \"end\": \"least\"}");
    }
    raw("]");
  }
  raw("}");
}

void Writer::report(const FitReport& report) {
  raw("{\n");
  line_list("segments", report.segments, "    ", [&](const SegmentReport& row) { segment(row); });
  raw(",\n    ");
  figure("tolerance", report.tolerance);
  raw(",\n    ");
  figure("largest_width", report.largest_width);
  raw(",\n    ");
  figure("largest_deviation", report.largest_deviation);
  raw(",\n    ");
  figure("largest_move", report.largest_move);
  raw(",\n    ");
  if (!report.moves.empty()) {
    figures("moves", report.moves);
    raw(",\n    ");
  }
  count("vertices", report.vertices);
  raw(",\n    ");
  count("vertices_lower_bound", report.vertices_lower_bound);
  raw(",\n    ");
  count("inflections", report.inflections);
  raw(",\n    ");
  count("inserted_points", static_cast<long long>(report.inserted_points));
  raw(",\n    ");
  optional_figure("waviness", report.waviness);
  raw(",\n    ");
  given(report.given);
  raw(",\n    ");
  optional_figure("carrier_deviation", report.carrier_deviation);
  raw(",\n    ");
  optional_figure("outside_spirals_region", report.outside_spirals_region);
  raw(",\n    ");
  figure("seconds", report.seconds);
  raw(",\n    \"chain\": {");
  count("newton_steps", report.chain.newton_steps);
  raw(", ");
  figure("smallest_margin", report.chain.smallest_margin);
  raw(", ");
  count("free_elements", static_cast<long long>(report.chain.free_elements));
  if (report.chain.slope_step_g2) {
    raw(", ");
    figure("slope_step_g2", *report.chain.slope_step_g2);
    raw(", ");
    optional_figure("waviness_g2", report.chain.waviness_g2);
  }
  raw("}\n  }");
}

void Writer::proof(std::size_t index, const PieceProof& proof) {
  raw("{");
  count("piece", static_cast<long long>(index));
  format_into(buffer_, ", \"verdict\": \"{}\"", to_string(proof.verdict));
  if (proof.exact_arithmetic) raw(", \"exact_arithmetic\": true");
  if (proof.t0 != 0.0 || proof.t1 != 1.0) {
    raw(", ");
    figure("t0", proof.t0);
    raw(", ");
    figure("t1", proof.t1);
  }
  raw("}");
}

void Writer::certificate(const Certificate& certificate) {
  raw("{\n");
  std::size_t index = 0;
  line_list("monotone", certificate.pieces, "    ",
            [&](const PieceProof& one) { proof(index++, one); });
  raw(",\n    \"joint_gaps\": {");
  figure("position", certificate.gaps.position);
  raw(", ");
  figure("heading", certificate.gaps.heading);
  raw(", ");
  figure("curvature", certificate.gaps.curvature);
  if (certificate.gaps.slope) {
    raw(", ");
    figure("slope", *certificate.gaps.slope);
  }
  raw("},\n    ");
  claim("gaps_within_bounds", certificate.gaps_within_bounds);
  raw(",\n    ");
  claim("inside_region", certificate.inside_region);
  raw(",\n    ");
  claim("through_points", certificate.through_points);
  raw(",\n    ");
  figure("largest_move", certificate.largest_move);
  raw(",\n    ");
  count("corners", certificate.corners);
  raw(",\n    ");
  count("curvature_steps", certificate.curvature_steps);
  raw(",\n    ");
  if (certificate.gaps.slope) {
    count("slope_steps", certificate.slope_steps);
    raw(",\n    ");
  }
  count("vertices", certificate.vertices);
  raw(",\n    ");
  count("inflections", certificate.inflections);
  raw(",\n    ");
  count("self_intersections", certificate.self_intersections);
  raw(",\n    ");
  claim("proved", certificate.proved);
  raw(",\n    \"reason\": ");
  text(certificate.reason);
  raw("\n  }");
}

void Writer::alignment(const StoredAlignment& alignment) {
  raw("{");
  figure("first_station", alignment.first_station);
  if (!alignment.transitions.empty()) {
    raw(",\n");
    line_list("transitions", alignment.transitions, "    ", [&](const PlacedTransition& one) {
      format_into(buffer_, "{{\"first_piece\": {}, \"pieces\": {}, \"kind\": \"{}\", ",
                  one.first_piece, one.pieces, name_of(one.kind));
      figure("kappa_start", one.kappa0);
      raw(", ");
      figure("kappa_end", one.kappa1);
      raw(", ");
      figure("length", one.length);
      raw("}");
    });
  }
  if (alignment.profile) {
    raw(",\n    \"profile\": ");
    profile(*alignment.profile);
  }
  raw("}");
}

void Writer::profile(const VerticalProfile& profile) {
  format_into(buffer_, "{{\"curves\": \"{}\", ", name_of(profile.curves));
  figure("end_station", profile.end_station);
  raw(", ");
  figure("end_height", profile.end_height);
  raw(",\n");
  line_list("elements", profile.elements, "    ", [&](const ProfileElement& one) {
    format_into(buffer_, "{{\"kind\": \"{}\"", name_of(one.kind));
    for (const auto& [key, value] : {std::pair{"station", one.station},
                                     {"length", one.length},
                                     {"height", one.height},
                                     {"grade_start", one.grade0},
                                     {"grade_end", one.grade1},
                                     {"radius", one.radius}}) {
      raw(", ");
      figure(key, value);
    }
    raw("}");
  });
  raw("}");
}

void Writer::one_nurbs(const NurbsCurve& curve) {
  raw(",\n  \"bspline\": {\"degree\": ");
  number(curve.degree);
  raw(",\n    \"knots\": ");
  inline_list(curve.knots, [&](double knot) { number(knot); });
  raw(",\n    \"points\": ");
  inline_list(curve.points, [&](Vec2 p) { point(p); });
  raw(",\n    \"weights\": ");
  inline_list(curve.weights, [&](double weight) { number(weight); });
  raw("}");
}

std::string Writer::write(const StoredContour& stored) {
  const Contour& contour = stored.contour;
  format_into(buffer_, "{{\n  \"format\": \"{}\",\n  \"version\": {},\n", contour_json::kFormat,
              contour_json::kVersion);
  raw("  \"units\": ");
  text(contour.units.name);
  raw(", \"units_source\": ");
  text(to_string(contour.units.source));
  raw(",\n  \"closed\": ");
  flag(contour.closed);
  format_into(buffer_, ",\n  \"carrier\": \"{}\",\n", to_string(contour.carrier));
  if (contour.continuity != Continuity::kG2) {
    format_into(buffer_, "  \"continuity\": \"{}\",\n", to_string(contour.continuity));
  }
  line_list("points", contour.points, "  ", [&](Vec2 p) { point(p); });
  raw(",\n");
  if (!contour.point_tolerance.empty()) {
    raw("  ");
    figures("point_tolerance", contour.point_tolerance);
    raw(",\n");
  }
  if (!contour.given.empty()) {
    line_list("given", contour.given, "  ", [&](const GivenDatum& one) { given(one); });
    raw(",\n");
  }
  points_ = contour.points.size();
  line_list("elements", contour.joints, "  ", [&](const Joint& joint) { element(joint); });
  raw(",\n");
  line_list("pieces", contour.pieces, "  ",
            [&](const Piece& one) { std::visit([&](const auto& kind) { piece(kind); }, one); });
  if (const auto made = nurbs_of(contour, {false}, watch_)) one_nurbs(made->curve);
  raw(",\n");
  line_list("runs", contour.runs, "  ", [&](const Run& run) {
    format_into(buffer_, "{{\"first_piece\": {}, \"last_piece\": {}, \"direction\": {}}}",
                run.first_piece, run.last_piece, run.direction);
  });
  if (!contour.kept.empty()) {
    raw(",\n  \"kept\": ");
    inline_list(contour.kept,
                [&](std::size_t i) { fmt::format_to(std::back_inserter(buffer_), "{}", i); });
  }
  if (!stored.name.empty()) {
    raw(",\n  \"name\": ");
    text(stored.name);
  }
  if (stored.alignment) {
    raw(",\n  \"alignment\": ");
    alignment(*stored.alignment);
  }
  if (stored.report) {
    raw(",\n  \"report\": ");
    report(*stored.report);
  }
  if (stored.certificate) {
    raw(",\n  \"certificate\": ");
    certificate(*stored.certificate);
  }
  raw("\n}\n");
  return std::move(buffer_);
}

std::string Writer::write(const FitReport& value) {
  report(value);
  return std::move(buffer_);
}

std::string Writer::write(const Certificate& value) {
  certificate(value);
  return std::move(buffer_);
}

}  // namespace

std::string report_to_json(const FitReport& report, Watch* watch) {
  return Writer(watch).write(report);
}

std::string certificate_to_json(const Certificate& certificate, Watch* watch) {
  return Writer(watch).write(certificate);
}

std::string contour_to_json(const StoredContour& stored, Watch* watch) {
  return Writer(watch).write(stored);
}

}  // namespace obvid
