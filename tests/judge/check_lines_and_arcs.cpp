// SPDX-License-Identifier: Apache-2.0
// The table of lines and arcs that several points lie on, against the pieces of the file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <variant>

#include "real_curve.h"
#include "sentences.h"
#include "texts.h"

namespace judge {
namespace {

constexpr std::size_t kFewestPoints = 4;
/// Roundings of a length that a few operations in doubles leave, each of the largest number met.
constexpr Real kTableRoundings = 8.0L * 0x1p-52L;

/// Curvatures of parts of one arc differ by so much of themselves at most.
constexpr Real kSameCircle = 1e-12L;

/// Pieces that are parts of one line or arc, one behind the other around the contour, and the
/// points at their ends.
struct Stretch {
  std::size_t first = 0, pieces = 0;
  std::size_t longest = 0;
  std::size_t from = 0, points = 0;
  Real length = 0.0L;
};

bool is_line_or_arc(const Piece& piece) {
  return std::holds_alternative<Line>(piece) || std::holds_alternative<Arc>(piece);
}

Real turning_rate(const Piece& piece) {
  const auto* arc = std::get_if<Arc>(&piece);
  return arc == nullptr ? 0.0L : Real{arc->kappa};
}

Real whole_length(const Piece& piece) {
  if (const auto* arc = std::get_if<Arc>(&piece)) return arc->length;
  const Line& line = std::get<Line>(piece);
  return norm(seen(line.end, line.start));
}

/// The element at the start of a piece.
const FileElement* before(const ContourFile& file, std::size_t piece) {
  return file.joint(file.closed ? piece % file.pieces.size() : piece);
}

/// Whether a piece is of the line or arc of the piece before it.
bool goes_on(const ContourFile& file, std::size_t piece) {
  const std::size_t count = file.pieces.size();
  if (count < 2 || (!file.closed && piece == 0)) return false;
  const Piece &a = file.pieces[(piece + count - 1) % count], &b = file.pieces[piece];
  if (!is_line_or_arc(a) || !is_line_or_arc(b) || a.index() != b.index()) return false;
  const FileElement* joint = before(file, piece);
  if (joint == nullptr || joint->parted()) return false;
  const Real ka = turning_rate(a), kb = turning_rate(b);
  return std::abs(ka - kb) <= kSameCircle * std::abs(ka);
}

/// The points of a stretch: its first and last piece end may lie at none.
bool find_points(const ContourFile& file, Stretch& one) {
  std::vector<std::size_t> at;
  for (std::size_t k = 0; k <= one.pieces; ++k) {
    const FileElement* joint = before(file, one.first + k);
    if (joint != nullptr && joint->source) at.push_back(*joint->source);
    if (joint != nullptr && joint->between) {  // the points on this side of a corner
      at.push_back(k == 0 ? joint->between->second : joint->between->first);
    }
  }
  if (at.size() < 2) return false;
  const std::size_t n = file.points.size();
  one.from = at.front();
  one.points = (at.back() > at.front() ? at.back() - at.front() : at.back() + n - at.front()) + 1;
  return true;
}

std::vector<Stretch> stretches(const ContourFile& file) {
  std::vector<Stretch> out;
  const std::size_t count = file.pieces.size();
  std::size_t begin = 0;
  while (begin < count && goes_on(file, begin)) ++begin;
  begin = begin == count ? 0 : begin;
  for (std::size_t done = 0; done < count;) {
    Stretch one{(begin + done) % count, 0, (begin + done) % count, 0, 0, 0.0L};
    do {
      const std::size_t k = (one.first + one.pieces) % count;
      if (!is_line_or_arc(file.pieces[k])) break;
      const Real length = whole_length(file.pieces[k]);
      one.length += length;
      if (length > whole_length(file.pieces[one.longest])) one.longest = k;
      ++one.pieces;
    } while (done + one.pieces < count && goes_on(file, (one.first + one.pieces) % count));
    done += std::max<std::size_t>(one.pieces, 1);
    if (one.pieces > 0 && find_points(file, one)) out.push_back(one);
  }
  return out;
}

/// The printed figure is within the blur of the value, or is it to its digits.
bool prints_about(const std::string& printed, Real value, Real blur) {
  const Real number = std::strtod(printed.c_str(), nullptr);
  const Real near = std::clamp(number, value - blur, value + blur);
  return prints(printed, static_cast<double>(near));
}

class Row {
 public:
  Row(const Course& course, const std::vector<std::string>& words, Sheet& sheet)
      : file_(course.file), coordinate_(course.ends.coordinate), words_(words), sheet_(sheet) {}

  /// By the longest piece, or by any that is as long but for rounding.
  void check(const Stretch& stretch) {
    const Real longest = whole_length(file_.pieces[stretch.longest]);
    const Real blur = kTableRoundings * std::max(longest, coordinate_);
    for (std::size_t k = 0; k < stretch.pieces; ++k) {
      Stretch by = stretch;
      by.longest = (stretch.first + k) % file_.pieces.size();
      if (by.longest == stretch.longest) continue;
      if (whole_length(file_.pieces[by.longest]) < longest - blur) continue;
      Sheet trial;
      Row(file_, coordinate_, words_, trial).check_by(by);
      if (trial.wrong() == 0) return sheet_.add(trial);
    }
    check_by(stretch);
  }

 private:
  Row(const ContourFile& file, Real coordinate, const std::vector<std::string>& words, Sheet& sheet)
      : file_(file), coordinate_(coordinate), words_(words), sheet_(sheet) {}

  void check_by(const Stretch& stretch) {
    const Piece& piece = file_.pieces[stretch.longest];
    const Point start = stored_start(piece);
    if (const auto* line = std::get_if<Line>(&piece)) {
      const Vec along = seen(line->end, start);
      sheet_.expect(words_[1] == "straight", kClaim + "radius", words_[1], "straight", words_[0]);
      sheet_.expect(words_[2] == "-" && words_[3] == "-", kClaim + "centre", words_[2], "-",
                    words_[0]);
      figure("heading", 4, std::atan2(along.y, along.x) / kDegree, kTableRoundings * 180.0L);
      figure("length", 5, stretch.length, blur_of(stretch));
      const Vec left = (1.0L / norm(along)) * left_of(along);
      farthest(stretch, [&](Vec p) { return std::abs(dot(p, left)); });
      return;
    }
    const Arc& arc = std::get<Arc>(piece);
    const Real radius = 1.0L / arc.kappa;
    const Vec centre = radius * left_of(unit_at(arc.theta0));
    const Real blur = kTableRoundings * std::max(coordinate_, std::abs(radius));
    figure("radius", 1, radius, 0.0L);
    // docs/scans.md: what is less than 1e-14 of the radius and the way to the centre is printed as
    // 0
    const Vec at{start.x + centre.x, start.y + centre.y};
    const Real none = 1e-14L * (std::abs(radius) + norm(at)) + blur;
    figure("centre", 2, at.x, words_[2] == "0" ? none : blur);
    figure("centre", 3, at.y, words_[3] == "0" ? none : blur);
    const Real heading = std::get<Arc>(file_.pieces[stretch.first]).theta0;
    figure("heading", 4, std::remainder(heading, 360.0L * kDegree) / kDegree,
           kTableRoundings * std::max(180.0L, std::abs(heading) / kDegree));
    figure("length", 5, stretch.length, blur_of(stretch));
    // from the squares: of a large circle, distances from its centre cancel
    farthest(stretch, [&](Vec p) {
      return std::abs(dot(p, p) - 2.0L * dot(p, centre)) / (norm(p - centre) + std::abs(radius));
    });
  }

  inline static const std::string kClaim = "text: line or arc ";

  void figure(const std::string& name, std::size_t column, Real value, Real blur) {
    sheet_.expect(prints_about(words_[column], value, blur), kClaim + name, words_[column],
                  shown(value), words_[0]);
  }

  /// Sums of lengths round; one alone is the file's.
  static Real blur_of(const Stretch& stretch) {
    return static_cast<Real>(stretch.pieces - 1) * kTableRoundings * stretch.length;
  }

  /// Points are written in decimals, whose reading and shifting round.
  template <class Distance>
  void farthest(const Stretch& stretch, const Distance& distance) {
    const Point start = stored_start(file_.pieces[stretch.longest]);
    Real most = 0.0L;
    for (std::size_t i = 0; i < stretch.points; ++i) {
      const Point& p = file_.points[(stretch.from + i) % file_.points.size()];
      most = std::max(most, distance(seen(p, start)));
    }
    figure("farthest", 6, most, kTableRoundings * coordinate_);
  }

  const ContourFile& file_;
  Real coordinate_;
  const std::vector<std::string>& words_;
  Sheet& sheet_;
};

}  // namespace

void LinesAndArcsTable::header(const std::string& line) { head_ += line + " "; }

void LinesAndArcsTable::row(const std::vector<std::string>& words) {
  const std::string claim = "text: line or arc";
  ++rows_;
  if (words[0] == "...") {
    whole_ = false;
    return;
  }
  static const std::vector<std::string> kHead =
      words_of("line or arc centre heading farthest points radius x y at start length point");
  if (words.size() != 7 || words_of(head_) != kHead) {
    return sheet_.unjudged(claim, "columns: " + head_);
  }
  const std::size_t n = course_.file.points.size();
  for (const Stretch& one : stretches(course_.file)) {
    const std::size_t to = (one.from + one.points - 1) % n;
    const bool around = one.points == n + 1;
    if (words[0] == (around ? fmt::format("all, from {}", one.from + 1)
                            : fmt::format("{}-{}", one.from + 1, to + 1))) {
      return Row(course_, words, sheet_).check(one);
    }
  }
  sheet_.fails(claim, words[0], "no piece is a line or arc between these points", "");
}

void LinesAndArcsTable::count(const Sentence& shown) {
  sheet_.expect(!shown.figures.empty() && shown.figures.back() == std::to_string(in_all()),
                "text: lines and arcs", shown.shape, std::to_string(in_all()), "");
}

void LinesAndArcsTable::end() {
  if (!whole_ || rows_ == 0) return;
  sheet_.expect(rows_ == in_all(), "text: lines and arcs", std::to_string(rows_),
                std::to_string(in_all()), "");
}

std::size_t LinesAndArcsTable::in_all() const {
  const auto all = stretches(course_.file);
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const Stretch& s) {
    return std::min(s.points, course_.file.points.size()) >= kFewestPoints;
  }));
}

}  // namespace judge
