// SPDX-License-Identifier: Apache-2.0
#include "alignment/profile_table.h"

namespace obvid {

DataTable profile_rows(const VerticalProfile& profile) {
  constexpr double kPercent = 100.0;
  DataTable out{
      heads_of("kind,station,length,height,grade_start_percent,grade_end_percent,radius,"
               "pvi_station,pvi_height")};
  for (const ProfileElement& e : profile.elements) {
    out.rows.push_back({to_string(e.kind), e.station, e.length, e.height, kPercent * e.grade0,
                        kPercent * e.grade1});
    if (e.kind == ProfileKind::kGrade) continue;
    const Vec2 meeting = grades_meet(e, profile.curves);
    for (const double figure : {e.radius, meeting.x, meeting.y}) {
      out.rows.back().emplace_back(figure);
    }
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
