// SPDX-License-Identifier: Apache-2.0
#include "alignment/profile_table.h"

#include <fmt/format.h>

namespace obvid {

std::string profile_csv(const VerticalProfile& profile) {
  std::string out =
      "kind,station,length,height,grade_start_percent,grade_end_percent,radius,pvi_station,"
      "pvi_height\n";
  for (const ProfileElement& e : profile.elements) {
    out += fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}", to_string(e.kind), e.station,
                       e.length, e.height, 100.0 * e.grade0, 100.0 * e.grade1);
    if (e.kind == ProfileKind::kGrade) {
      out += ",,,\n";
      continue;
    }
    const Vec2 meeting = grades_meet(e, profile.curves);
    out += fmt::format(",{:.17g},{:.17g},{:.17g}\n", e.radius, meeting.x, meeting.y);
  }
  return out;
}

namespace pipeline_detail {

void add_profile(JsonText& json, const ProfileReport& report) {
  const VerticalProfile& profile = report.profile;
  json.begin_object();
  json.pair("curves", name_of(profile.curves));
  json.pair("tolerance", report.tolerance).pair("largest_share", profile.largest_share);
  json.pair("rms", profile.rms);
  add_profile_elements(json, profile);
  json.key("deviations").begin_array();
  for (std::size_t i = 0; i < report.heights.size(); ++i) {
    json.begin_object().pair("station", report.heights[i].x).pair("height", report.heights[i].y);
    json.pair("offset", profile.offsets[i]).end_object();
  }
  json.end_array().end_object();
}

}  // namespace pipeline_detail
}  // namespace obvid
