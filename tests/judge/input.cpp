// SPDX-License-Identifier: Apache-2.0
#include "input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>

namespace judge {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

double curvature_of(const std::string& radius) {
  return radius == "inf" ? 0.0 : 1.0 / std::strtod(radius.c_str(), nullptr);
}

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

/// Curvatures of radii from one end to the other, either of which may be missing.
std::optional<Ends> bends_of(const std::string& least, const std::string& greatest) {
  const auto radius = [](const std::string& text) {
    return text.find("inf") != std::string::npos ? kNoEnd : std::strtod(text.c_str(), nullptr);
  };
  if (least.empty() && greatest.empty()) return std::nullopt;
  // a missing end is as far as the sign of the other one goes
  const bool left = !least.empty() ? radius(least) >= 0.0 && least[0] != '-' : radius(greatest) > 0;
  const auto bend = [&](const std::string& text, double missing) {
    if (text.empty()) return missing;
    const double r = radius(text);
    return std::isinf(r) ? 0.0 : r == 0.0 ? (left ? kNoEnd : -kNoEnd) : 1.0 / r;
  };
  if (left) return Ends{bend(greatest, 0.0), bend(least, kNoEnd)};
  return Ends{bend(greatest, -kNoEnd), bend(least, 0.0)};
}

/// "LOW..HIGH", either of which may be missing.
std::optional<std::pair<std::string, std::string>> ends_of(const std::string& text) {
  const std::size_t at = text.find("..");
  if (at == std::string::npos) return std::nullopt;
  return std::pair(text.substr(0, at), text.substr(at + 2));
}

std::optional<Ends> headings_of(const std::string& text) {
  const auto ends = ends_of(text);
  if (!ends) return std::nullopt;
  return Ends{radians(std::strtod(ends->first.c_str(), nullptr)),
              radians(std::strtod(ends->second.c_str(), nullptr))};
}

std::optional<Ends> kappas_of(const std::string& text) {
  const auto ends = ends_of(text);
  if (!ends) return std::nullopt;
  return Ends{ends->first.empty() ? -kNoEnd : std::strtod(ends->first.c_str(), nullptr),
              ends->second.empty() ? kNoEnd : std::strtod(ends->second.c_str(), nullptr)};
}

/// A heading, or the headings between two.
void give_heading(GivenPoint& p, const std::string& text) {
  narrow(p.headings, headings_of(text));
  if (!headings_of(text)) p.heading = radians(std::strtod(text.c_str(), nullptr));
}

void give_radius(GivenPoint& p, const std::string& text) {
  const auto ends = ends_of(text);
  if (ends) {
    narrow(p.kappas, bends_of(ends->first, ends->second));
  } else {
    p.kappa = curvature_of(text);
  }
}

std::vector<std::string> cells_of(std::string line) {
  const std::size_t comment = line.find('#');
  if (comment != std::string::npos) line.resize(comment);
  std::vector<std::string> out;
  const bool separated = line.find_first_of(",;") != std::string::npos;
  std::string cell;
  for (const char c : line) {
    const bool blank = c == ' ' || c == '\t' || c == '\r';
    if (c == ',' || c == ';' || (blank && !separated)) {
      if (separated || !cell.empty()) out.push_back(cell);
      cell.clear();
    } else if (!blank) {
      cell += c;
    }
  }
  if (separated || !cell.empty()) out.push_back(cell);
  return out;
}

bool is_number(const std::string& cell) {
  char* end = nullptr;
  std::strtod(cell.c_str(), &end);
  return !cell.empty() && *end == '\0';
}

class Reader {
 public:
  void line(const std::string& text) {
    const std::vector<std::string> cells = cells_of(text);
    if (cells.empty()) return;
    if (!is_number(cells[0])) {
      for (std::size_t i = 0; i < cells.size(); ++i) name(cells[i], i);
      return;
    }
    GivenPoint p;
    p.point = {number(cells, "x", 0).value_or(0.0), number(cells, "y", 1).value_or(0.0)};
    if (const auto heading = number(cells, "heading_deg")) p.heading = radians(*heading);
    if (const std::string* radius = cell(cells, "radius")) p.kappa = curvature_of(*radius);
    if (const auto kappa = number(cells, "kappa")) p.kappa = kappa;
    const auto words = [&](const char* name) {
      const std::string* found = cell(cells, name);
      return found == nullptr ? std::string() : *found;
    };
    const auto least = number(cells, "heading_min"), greatest = number(cells, "heading_max");
    if (least && greatest) p.headings = Ends{radians(*least), radians(*greatest)};
    p.kappas = bends_of(words("radius_min"), words("radius_max"));
    const auto low = number(cells, "kappa_min"), high = number(cells, "kappa_max");
    if (low || high) p.kappas = Ends{low.value_or(-kNoEnd), high.value_or(kNoEnd)};
    p.tolerance = number(cells, "tol");
    if (const std::string* corner = cell(cells, "corner")) p.corner = *corner == "1";
    merge(p);
  }
  std::vector<GivenPoint> points;
  std::string unit;  ///< behind the names of x and y; empty: none

 private:
  /// "x", "x_mm" or "x [mm]" (blanks are gone by now).
  void name(const std::string& text, std::size_t column) {
    column_[text] = column;
    if (text.size() < 3 || (text[0] != 'x' && text[0] != 'y')) return;
    const bool brackets = text[1] == '[' && text.back() == ']';
    if (text[1] != '_' && !brackets) return;
    unit = text.substr(2, brackets ? text.size() - 3 : std::string::npos);
    column_[text.substr(0, 1)] = column;
  }
  const std::string* cell(const std::vector<std::string>& cells, const std::string& name,
                          int otherwise = -1) const {
    const auto found = column_.find(name);
    const int i = found != column_.end() ? static_cast<int>(found->second)
                                         : (column_.contains("x") ? -1 : otherwise);
    if (i < 0 || static_cast<std::size_t>(i) >= cells.size()) return nullptr;
    const std::string& text = cells[static_cast<std::size_t>(i)];
    return text.empty() ? nullptr : &text;
  }
  std::optional<double> number(const std::vector<std::string>& cells, const std::string& name,
                               int otherwise = -1) const {
    const std::string* text = cell(cells, name, otherwise);
    if (text == nullptr) return std::nullopt;
    return std::strtod(text->c_str(), nullptr);
  }
  void merge(const GivenPoint& p) {
    if (points.empty() || !(points.back().point == p.point)) return points.push_back(p);
    GivenPoint& before = points.back();
    if (!before.heading) before.heading = p.heading;
    if (!before.kappa) before.kappa = p.kappa;
    narrow(before.headings, p.headings);
    narrow(before.kappas, p.kappas);
    if (p.tolerance)
      before.tolerance = std::min(before.tolerance.value_or(*p.tolerance), *p.tolerance);
    before.corner = before.corner || p.corner;
  }
  std::map<std::string, std::size_t> column_;
};

/// `--mirror`, then `--scale`, `--rotate` and `--move`; in the order in which they act.
struct Placement {
  char mirror = ' ';
  double scale = 1.0, degrees = 0.0;
  Point move;

  void read(const std::string& name, const std::string& value) {
    const double number = std::strtod(value.c_str(), nullptr);
    if (name == "--mirror") mirror = value.empty() ? ' ' : value[0];
    if (name == "--scale") scale = number;
    if (name == "--rotate") degrees = number;
    const std::size_t comma = value.find(',');
    if (name != "--move" || comma == std::string::npos) return;
    move = {number, std::strtod(value.c_str() + comma + 1, nullptr)};
  }

  [[nodiscard]] bool is_none() const {
    return mirror == ' ' && scale == 1.0 && degrees == 0.0 && move == Point{};
  }

  void place(GivenPoint& p) const {
    const Real angle = Real{degrees} * std::numbers::pi_v<Real> / 180.0L;
    const Vec u = unit_at(angle);
    const Real sx = mirror == 'y' ? -scale : scale, sy = mirror == 'x' ? -scale : scale;
    const Vec q{sx * Real{p.point.x}, sy * Real{p.point.y}};
    p.point = {static_cast<double>(u.x * q.x - u.y * q.y + Real{move.x}),
               static_cast<double>(u.y * q.x + u.x * q.y + Real{move.y})};
    const bool turned = mirror != ' ';
    if (p.tolerance) *p.tolerance *= scale;
    if (p.kappa) *p.kappa *= (turned ? -1.0 : 1.0) / scale;
    if (p.kappas) p.kappas = of_range(*p.kappas, turned ? -1.0 / scale : 1.0 / scale, 0.0);
    const double back = mirror == 'y' ? std::numbers::pi : 0.0, on = radians(degrees) + back;
    if (p.heading) *p.heading = (turned ? -*p.heading : *p.heading) + on;
    if (p.headings) p.headings = of_range(*p.headings, turned ? -1.0 : 1.0, on);
  }

 private:
  static Ends of_range(const Ends& ends, double factor, double more) {
    const double a = ends.least * factor + more, b = ends.greatest * factor + more;
    return {std::min(a, b), std::max(a, b)};
  }
};

bool places(const std::string& option) {
  const std::string name = option.substr(0, option.find('='));
  return name == "--mirror" || name == "--scale" || name == "--rotate" || name == "--move";
}

class Options {
 public:
  explicit Options(Input& input) : input_(input) {}

  /// Data in options are of the placed points.
  void read(const std::vector<std::string>& words) {
    each(words, [this](const std::string& name, const std::string& value) {
      placement_.read(name, value);
    });
    input_.placed = !placement_.is_none();
    for (GivenPoint& p : input_.points) {
      if (input_.placed) placement_.place(p);
    }
    each(words, [this](const std::string& name, const std::string& value) { set(name, value); });
  }

 private:
  static void each(const std::vector<std::string>& words,
                   const std::function<void(const std::string&, const std::string&)>& use) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      std::string name = words[i], value;
      const std::size_t equals = name.find('=');
      const bool takes = name != "--closed" && name != "--open" && name != "--convex" &&
                         name != "--primitives" && name != "--no-corners";
      if (name.starts_with("--") && equals != std::string::npos) {
        value = name.substr(equals + 1);
        name.resize(equals);
      } else if (takes && i + 1 < words.size()) {
        value = words[++i];
      }
      use(name, value);
    }
  }

  void set(const std::string& name, const std::string& value) {
    const double number = std::strtod(value.c_str(), nullptr);
    if (name == "--carrier") input_.carrier = value;
    if (name == "--construction") {
      input_.construction = value;
      input_.carrier = value == "ellipses"    ? "conics"
                       : value == "spline"    ? "baseline"
                       : value == "parabolas" ? "beziers"
                                              : value;
    }
    if (name == "--units") {
      input_.units = value;
      input_.units_given = true;
    }
    if (name == "--tolerance") input_.tolerance = number;
    if (name == "--continuity") input_.continuity = value;
    if (name == "--corner-angle") input_.corner_angle = number;
    if (name == "--no-corners") input_.searches_corners = false;
    if (name == "--noise") noise(value);
    if (name == "--closed") input_.closed = true;
    if (name == "--open") input_.open = true;
    if (name == "--convex") input_.convex = true;
    if (name == "--primitives") input_.primitives = true;
    if (input_.points.empty()) return;
    GivenPoint &first = input_.points.front(), &last = input_.points.back();
    if (name == "--start-heading" && value != "natural") give_heading(first, value);
    if (name == "--end-heading" && value != "natural") give_heading(last, value);
    if (name == "--start-radius") give_radius(first, value);
    if (name == "--end-radius") give_radius(last, value);
    at_point(name, value);
  }
  void noise(const std::string& value) {
    input_.rounding = value == "rounding";
    input_.automatic = value == "auto";
    if (input_.rounding) return;
    input_.noise = std::strtod(value.c_str(), nullptr);
    if (!input_.automatic || input_.points.empty()) return;
    std::vector<Vec> points;
    for (const GivenPoint& p : input_.points)
      points.push_back(seen(p.point, input_.points[0].point));
    const auto reach = reach_of_scatter(points, rounding_of_places(input_));
    input_.noise = reach ? reach->greatest : 0.0;
  }
  void at_point(const std::string& name, const std::string& value) {
    const std::size_t equals = value.find('=');
    const std::size_t i = std::strtoul(value.c_str(), nullptr, 10);
    if (i < 1 || i > input_.points.size()) return;
    GivenPoint& p = input_.points[i - 1];
    if (name == "--corner-at") p.corner = true;
    if (equals == std::string::npos) return;
    const std::string what = value.substr(equals + 1);
    if (name == "--heading-at") give_heading(p, what);
    if (name == "--radius-at") give_radius(p, what);
    if (name == "--kappa-at") {
      narrow(p.kappas, kappas_of(what));
      if (!kappas_of(what)) p.kappa = std::strtod(what.c_str(), nullptr);
    }
  }
  Input& input_;
  Placement placement_;
};

/// Of the middle one of five points from the cubic through the others over their chord, in standard
/// deviations of one point; none where they do not advance.
std::optional<Real> residual_of(const std::array<Vec, 5>& p) {
  const Vec chord = p[4] - p[0];
  const Real length = norm(chord);
  if (!(length > 0.0L)) return std::nullopt;
  std::array<Real, 5> along{}, across{};
  for (std::size_t k = 0; k < p.size(); ++k) {
    along[k] = dot(p[k] - p[0], chord) / length;
    across[k] = cross(chord, p[k] - p[0]) / length;
    if (k > 0 && !(along[k] > along[k - 1])) return std::nullopt;
  }
  constexpr std::size_t kMiddle = 2;
  Real off = across[kMiddle], squares = 1.0L;
  for (std::size_t k = 0; k < p.size(); ++k) {
    if (k == kMiddle) continue;
    Real weight = 1.0L;
    for (std::size_t m = 0; m < p.size(); ++m) {
      if (m == k || m == kMiddle) continue;
      weight *= (along[kMiddle] - along[m]) / (along[k] - along[m]);
    }
    off -= weight * across[k];
    squares += weight * weight;
  }
  return std::abs(off) / std::sqrt(squares);
}

/// Deviation by both medians of the residuals of every point with neighbours so far apart.
std::optional<Ends> deviations_of(const std::vector<Vec>& points, std::size_t apart) {
  std::vector<double> found;
  for (std::size_t i = 2 * apart; i + 2 * apart < points.size(); ++i) {
    const auto one = residual_of({points[i - 2 * apart], points[i - apart], points[i],
                                  points[i + apart], points[i + 2 * apart]});
    if (one) found.push_back(static_cast<double>(*one));
  }
  if (found.empty()) return std::nullopt;
  constexpr double kMedianOfNormal = 0.6744897501960817;  // of sizes of errors, in deviations
  std::sort(found.begin(), found.end());
  return Ends{found[(found.size() - 1) / 2] / kMedianOfNormal,
              found[found.size() / 2] / kMedianOfNormal};
}

}  // namespace

double rounding_of_places(const Input& input) {
  constexpr double kRoundings = 16.0 * 0x1p-53;
  double most = 0.0;
  for (const GivenPoint& p : input.points) {
    most = std::max({most, std::abs(p.point.x), std::abs(p.point.y)});
  }
  return input.placed ? kRoundings * most : 0.0;
}

std::optional<Ends> reach_of_scatter(const std::vector<Vec>& points, double rounding) {
  const auto near = deviations_of(points, 1), far = deviations_of(points, 2);
  if (!near || !far) return std::nullopt;
  constexpr double kPower = 256.0, kAmiss = 0.05;
  const auto deviation = [](double one, double two) {
    return std::sqrt(std::max(0.0, kPower * one * one - two * two) / (kPower - 1.0));
  };
  const double factor = std::sqrt(2.0 * std::log(static_cast<double>(points.size()) / kAmiss));
  return Ends{factor * (deviation(near->least, far->greatest) - rounding),
              factor * (deviation(near->greatest, far->least) + rounding)};
}

std::vector<std::string> without_placement(const std::vector<std::string>& options) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (!places(options[i])) {
      out.push_back(options[i]);
    } else if (options[i].find('=') == std::string::npos) {
      ++i;
    }
  }
  return out;
}

void narrow(std::optional<Ends>& range, const std::optional<Ends>& more) {
  if (!more) return;
  range = range
              ? Ends{std::max(range->least, more->least), std::min(range->greatest, more->greatest)}
              : *more;
}

Input read_input(const std::string& text, const std::vector<std::string>& options) {
  Input out;
  Reader reader;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) reader.line(line);
  out.points = std::move(reader.points);
  if (!reader.unit.empty()) {
    out.units = reader.unit;
    out.units_in_file = true;
  }
  Options(out).read(options);
  return out;
}

void share_closing_point(Input& input) {
  if (!input.closed || input.points.size() < 3) return;
  GivenPoint &first = input.points.front(), &last = input.points.back();
  if (!(first.point == last.point)) return;
  if (!first.heading) first.heading = last.heading;
  if (!first.kappa) first.kappa = last.kappa;
  narrow(first.headings, last.headings);
  narrow(first.kappas, last.kappas);
  last = first;
}

std::string with_tolerances_from(const std::string& text, double tolerance) {
  std::string out;
  std::istringstream lines(text);
  std::optional<std::size_t> column;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells = cells_of(line);
    for (std::size_t i = 0; i < cells.size() && !is_number(cells[0]); ++i) {
      if (cells[i] == "tol") column = i;
    }
    if (column && *column < cells.size() && is_number(cells[*column]) &&
        std::strtod(cells[*column].c_str(), nullptr) < tolerance) {
      cells[*column] = fmt::format("{}", tolerance);
    }
    for (std::size_t i = 0; i < cells.size(); ++i) out += (i == 0 ? "" : ",") + cells[i];
    out += "\n";
  }
  return out;
}

std::vector<std::string> without_datum(const std::vector<std::string>& options, bool heading,
                                       std::size_t point, std::size_t points) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const std::string& word = options[i];
    const std::size_t first = word.find('=');
    const std::string name = word.substr(0, first);
    const bool alike = heading ? name.ends_with("heading") || name == "--heading-at"
                               : name.ends_with("radius") || name.ends_with("kappa") ||
                                     name == "--kappa-at" || name == "--radius-at";
    const bool apart = alike && first == std::string::npos;  // its value is the next word
    const std::string value =
        apart ? (i + 1 < options.size() ? options[i + 1] : "") : word.substr(first + 1);
    const bool of_point = name.ends_with("-at") ? value.starts_with(std::to_string(point) + "=")
                          : name.starts_with("--start") ? point == 1
                                                        : point == points;
    if (alike && of_point) {
      i += apart ? 1 : 0;
      continue;
    }
    out.push_back(word);
  }
  return out;
}

}  // namespace judge
