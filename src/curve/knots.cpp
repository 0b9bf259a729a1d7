// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/knots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/curve/internal/basis.h"

namespace obvid {
namespace {

/// Boehm: the knot u enters span k (knots[k] <= u < knots[k + 1]).
void insert_one(Line& line, double u) {
  const auto p = static_cast<std::size_t>(line.degree);
  const std::size_t k = span_at(line.degree, line.knots, u);
  const Polygon& old = line.points;
  Polygon points(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(k - p + 1));
  for (std::size_t i = k - p + 1; i <= k; ++i) {
    const double low = line.knots[i], high = line.knots[i + p];
    points.push_back(between(old[i - 1], old[i], (u - low) / (high - low)));
  }
  points.insert(points.end(), old.begin() + static_cast<std::ptrdiff_t>(k), old.end());
  line.points = std::move(points);
  line.knots.insert(line.knots.begin() + static_cast<std::ptrdiff_t>(k) + 1, u);
}

/// The part of a line that decides about the spans from `first` to `last`.
Line window(const Line& line, std::size_t first, std::size_t last) {
  const auto p = static_cast<std::ptrdiff_t>(line.degree);
  const auto a = static_cast<std::ptrdiff_t>(first), b = static_cast<std::ptrdiff_t>(last);
  return {line.degree,
          {line.knots.begin() + a - p, line.knots.begin() + b + p + 2},
          {line.points.begin() + a - p, line.points.begin() + b + 1}};
}

/// Value of the blossom at `degree` ascending arguments, all knots of the line: the control point
/// that appears once they are all among the knots, consecutive. Convex combinations only.
Vec4 blossom(const Line& line, const std::vector<double>& arguments) {
  const auto p = static_cast<std::size_t>(line.degree);
  const std::size_t k = span_at(line.degree, line.knots, arguments.front());
  Line part = window(line, k, span_at(line.degree, line.knots, arguments.back()));
  for (std::size_t i = 0; i < p;) {
    const double u = arguments[i];
    const auto same = static_cast<std::size_t>(
        std::upper_bound(arguments.begin(), arguments.end(), u) - arguments.begin());
    for (std::size_t have = multiplicity(part.knots, u); have < same - i; ++have)
      insert_one(part, u);
    i = same;
  }
  const auto at =
      std::search(part.knots.begin() + 1, part.knots.end(), arguments.begin(), arguments.end());
  return part.points[static_cast<std::size_t>(at - part.knots.begin()) - 1];
}

}  // namespace

std::size_t multiplicity(const std::vector<double>& knots, double u) {
  const auto [low, high] = std::equal_range(knots.begin(), knots.end(), u);
  return static_cast<std::size_t>(high - low);
}

Line inserted(const Line& line, const std::vector<double>& added) {
  if (added.empty()) return line;
  // Piegl and Tiller, The NURBS Book, A5.4: from the back, each new knot once
  const auto p = static_cast<std::size_t>(line.degree);
  const std::size_t n = line.points.size() - 1, r = added.size() - 1;
  const std::vector<double>& u = line.knots;
  const std::size_t a = span_at(line.degree, u, added.front());
  const std::size_t b = span_at(line.degree, u, added.back()) + 1;
  Line out{line.degree, std::vector<double>(u.size() + r + 1), Polygon(n + r + 2)};
  for (std::size_t j = 0; j <= a - p; ++j) out.points[j] = line.points[j];
  for (std::size_t j = b - 1; j <= n; ++j) out.points[j + r + 1] = line.points[j];
  for (std::size_t j = 0; j <= a; ++j) out.knots[j] = u[j];
  for (std::size_t j = b + p; j < u.size(); ++j) out.knots[j + r + 1] = u[j];
  std::size_t i = b + p - 1, k = b + p + r;
  for (std::size_t j = r + 1; j-- > 0;) {
    while (added[j] <= u[i] && i > a) {
      out.points[k - p - 1] = line.points[i - p - 1];
      out.knots[k--] = u[i--];
    }
    out.points[k - p - 1] = out.points[k - p];
    for (std::size_t l = 1; l <= p; ++l) {
      const std::size_t at = k - p + l;
      const double above = out.knots[k + l] - added[j];
      if (above == 0.0) {
        out.points[at - 1] = out.points[at];
      } else {
        const double part = above / (out.knots[k + l] - u[i - p + l]);
        out.points[at - 1] = between(out.points[at], out.points[at - 1], part);
      }
    }
    out.knots[k--] = added[j];
  }
  return out;
}

std::vector<double> raised_knots(const std::vector<double>& knots) {
  std::vector<double> raised;
  raised.reserve(knots.size() + knots.size() / 2);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    raised.push_back(knots[i]);
    if (i + 1 == knots.size() || knots[i + 1] != knots[i]) raised.push_back(knots[i]);
  }
  return raised;
}

Line raised(const Line& line) {
  // the blossom of the raised spline is the mean of those that leave one argument out
  // (Prautzsch 1984)
  Line out{line.degree + 1, raised_knots(line.knots), {}};
  const auto q = static_cast<std::size_t>(out.degree);
  const std::size_t count = out.knots.size() - q - 1;
  out.points.reserve(count);
  std::vector<double> arguments(q - 1);
  for (std::size_t i = 0; i < count; ++i) {
    Vec4 sum;
    for (std::size_t left_out = 0; left_out < q; ++left_out) {
      for (std::size_t j = 0, at = 0; j < q; ++j) {
        if (j != left_out) arguments[at++] = out.knots[i + 1 + j];
      }
      sum = sum + blossom(line, arguments);
    }
    out.points.push_back((1.0 / static_cast<double>(q)) * sum);
  }
  // the ends are the line's own, without rounding
  out.points.front() = line.points.front();
  out.points.back() = line.points.back();
  return out;
}

Result<void> check_knots(int degree, const std::vector<double>& knots, const char* what) {
  const auto refuse = [&](std::string sentence, std::size_t index) -> Result<void> {
    return error(ErrorCode::kBadOption, fmt::format("{} {}", what, sentence))
        .point(index)
        .value(index < knots.size() ? knots[index] : 0.0);
  };
  if (degree < 1 || degree > kMaxNurbsDegree) {
    return refuse(fmt::format("have degree {}, which is not in 1 to {}", degree, kMaxNurbsDegree),
                  0);
  }
  const auto p = static_cast<std::size_t>(degree);
  if (knots.size() < 2 * (p + 1)) return refuse("are too few for their degree", knots.size());
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) {
      return error(ErrorCode::kNotFinite, fmt::format("{} hold a number that is not finite", what))
          .point(i)
          .value(knots[i]);
    }
    if (i > 0 && knots[i] < knots[i - 1]) return refuse("descend", i);
  }
  if (multiplicity(knots, knots.front()) != p + 1) return refuse("are not clamped at the start", 0);
  if (multiplicity(knots, knots.back()) != p + 1) {
    return refuse("are not clamped at the end", knots.size() - 1);
  }
  for (std::size_t i = p + 1; i + p + 1 < knots.size(); ++i) {
    if (multiplicity(knots, knots[i]) > p)
      return refuse("have a multiplicity that exceeds the degree", i);
  }
  return {};
}

std::vector<double> mapped(const std::vector<double>& knots, double from, double to) {
  const double first = knots.front(), last = knots.back();
  std::vector<double> moved(knots.size());
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double part = (knots[i] - first) / (last - first);
    moved[i] = knots[i] == last ? to : from + part * (to - from);
  }
  return moved;
}

}  // namespace obvid
