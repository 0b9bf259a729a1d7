// SPDX-License-Identifier: Apache-2.0
#include "engine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "obvid/obvid.h"

namespace obvid::studio {
namespace {

using nlohmann::json;

constexpr std::size_t kMostSamples = 200'000;  // of one answer
constexpr int kSamplesOfPiece = 16, kMostSamplesOfPiece = 256;

struct Free {
  void operator()(obvid_input* p) const { obvid_input_free(p); }
  void operator()(obvid_contour* p) const { obvid_contour_free(p); }
  void operator()(obvid_files* p) const { obvid_files_free(p); }
  void operator()(obvid_error* p) const { obvid_error_free(p); }
  void operator()(char* p) const { obvid_free(p); }
};
template <class T>
using Held = std::unique_ptr<T, Free>;

json told(const obvid_error& error) {
  json points = json::array();
  for (std::size_t i = 0; i < error.point_count; ++i) points.push_back(error.points[i]);
  return {{"code", error.code},   {"category", error.category}, {"message", error.message},
          {"where", error.where}, {"advice", error.advice},     {"points", std::move(points)}};
}

json usage(const char* message) {
  return {{"code", 201},  {"category", OBVID_USAGE}, {"message", message}, {"where", ""},
          {"advice", ""}, {"points", json::array()}};
}

/// Takes what a call hands out.
class Call {
 public:
  explicit Call(const std::function<bool()>& cancelled) : cancelled_(cancelled) {
    run_.user = this;
    run_.cancelled = [](void* user) {
      const auto& asked = static_cast<Call*>(user)->cancelled_;
      return asked && asked() ? 1 : 0;
    };
  }

  const obvid_run* run() const { return &run_; }
  obvid_error** error() { return &error_; }
  char** report() { return &report_; }

  /// `report` and `error` of the answer.
  void put_into(json& out) {
    const Held<obvid_error> error(error_);
    const Held<char> report(report_);
    error_ = nullptr;
    report_ = nullptr;
    out["error"] = error ? told(*error) : json(nullptr);
    if (report) out["report"] = json::parse(report.get(), nullptr, false);
  }

 private:
  const std::function<bool()>& cancelled_;
  obvid_run run_{};
  obvid_error* error_ = nullptr;
  char* report_ = nullptr;
};

/// Points of the request as one array of x and y; empty: they are not what they should be.
std::vector<double> coordinates(const json& points) {
  std::vector<double> out;
  for (const json& p : points) {
    if (!p.is_array() || p.size() != 2 || !p[0].is_number() || !p[1].is_number()) return {};
    out.push_back(p[0].get<double>());
    out.push_back(p[1].get<double>());
  }
  return out;
}

/// A text of the request; what is no text counts as left out.
std::string text_in(const json& request, const char* key, const char* otherwise) {
  const auto found = request.find(key);
  return found != request.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

Held<obvid_input> input_of(const json& request, obvid_error** error) {
  obvid_input* input = nullptr;
  if (request.contains("points") && request["points"].is_array()) {
    const std::vector<double> xy = coordinates(request["points"]);
    obvid_points(xy.data(), xy.size() / 2, &input, error);
  } else if (request.contains("text") && request["text"].is_string()) {
    const auto& text = request["text"].get_ref<const std::string&>();
    const std::string name = text_in(request, "name", "text");
    obvid_read_text(text.data(), text.size(), name.c_str(), &input, error);
  } else {
    obvid_points(nullptr, 0, &input, error);
  }
  return Held<obvid_input>(input);
}

std::string options_of(const json& request) {
  const auto found = request.find("options");
  return found == request.end() || found->is_null() ? "{}" : found->dump();
}

/// Derivative of the curvature by arc length.
double slope(const double* d1, const double* d2, const double* d3) {
  const double speed2 = d1[0] * d1[0] + d1[1] * d1[1], speed = std::sqrt(speed2);
  const double turn = d1[0] * d2[1] - d1[1] * d2[0];
  const double along = d1[0] * d2[0] + d1[1] * d2[1];
  const double by_t = (d1[0] * d3[1] - d1[1] * d3[0]) / (speed2 * speed) -
                      3.0 * turn * along / (speed2 * speed2 * speed);
  return by_t / speed;
}

json curve_of(const obvid_contour& contour, int asked) {
  const std::size_t pieces = obvid_contour_pieces(&contour);
  const auto each = std::clamp<std::size_t>(kMostSamples / std::max<std::size_t>(pieces, 1), 2,
                                            static_cast<std::size_t>(asked));
  std::vector<double> at;
  for (std::size_t i = 0; i < pieces; ++i) {
    for (std::size_t k = 0; k <= each; ++k) {
      at.push_back(static_cast<double>(i) + static_cast<double>(k) / static_cast<double>(each));
    }
  }
  // both ends of a piece are looked at within it: curvatures may step between pieces
  for (std::size_t i = 0; i < pieces; ++i) {
    double& last = at[i * (each + 1) + each];
    last = std::nextafter(last, 0.0);
  }
  const std::size_t n = at.size();
  std::vector<double> xy(2 * n), heading(n), kappa(n), d1(2 * n), d2(2 * n), d3(2 * n), slopes(n);
  const bool good = obvid_evaluate(&contour, OBVID_BY_PARAMETER, at.data(), n, xy.data(),
                                   heading.data(), kappa.data(), nullptr) == 0 &&
                    obvid_derivatives(&contour, at.data(), n, 1, d1.data(), nullptr) == 0 &&
                    obvid_derivatives(&contour, at.data(), n, 2, d2.data(), nullptr) == 0 &&
                    obvid_derivatives(&contour, at.data(), n, 3, d3.data(), nullptr) == 0;
  if (!good) return nullptr;
  for (std::size_t i = 0; i < n; ++i) slopes[i] = slope(&d1[2 * i], &d2[2 * i], &d3[2 * i]);
  return {{"pieces", pieces},
          {"samples", each + 1},
          {"t", at},
          {"xy", xy},
          {"heading", heading},
          {"kappa", kappa},
          {"slope", slopes},
          {"length", obvid_contour_length(&contour)},
          {"closed", obvid_contour_closed(&contour) != 0}};
}

/// What a call made, into `files` and `remarks` of the answer.
void put_files(obvid_files* made, json& out) {
  const Held<obvid_files> held(made);
  out["files"] = json::array();
  out["remarks"] = json::array();
  for (std::size_t i = 0; made != nullptr && i < obvid_files_count(made); ++i) {
    std::size_t size = 0;
    const char* data = obvid_files_data(made, i, &size);
    out["files"].push_back(
        {{"suffix", obvid_files_suffix(made, i)}, {"text", std::string(data, size)}});
  }
  for (std::size_t i = 0; made != nullptr; ++i) {
    const char* remark = obvid_files_remark(made, i);
    if (remark == nullptr) break;
    out["remarks"].push_back(remark);
  }
}

int samples_of(const json& request) {
  const auto found = request.find("samples");
  if (found == request.end() || !found->is_number()) return kSamplesOfPiece;
  return static_cast<int>(std::clamp<double>(found->get<double>(), 2, kMostSamplesOfPiece));
}

json fit_of(const json& request, const std::function<bool()>& cancelled) {
  json out;
  Call call(cancelled);
  const Held<obvid_input> input = input_of(request, call.error());
  Held<obvid_contour> contour;
  if (input) {
    obvid_contour* made = nullptr;
    obvid_fit(input.get(), options_of(request).c_str(), call.run(), &made, call.report(),
              call.error());
    contour.reset(made);
  }
  call.put_into(out);
  if (!contour) return out;
  out["curve"] = curve_of(*contour, samples_of(request));
  const auto file = request.find("file");
  if (file == request.end() || *file != false) {
    obvid_files* made = nullptr;
    obvid_error* failed = nullptr;
    json files;
    obvid_export(contour.get(), "json", nullptr, nullptr, &made, &failed);
    put_files(made, files);
    const Held<obvid_error> held(failed);
    if (failed == nullptr) out["contour"] = files["files"][0]["text"];
  }
  out["warnings"] = json::array();
  for (std::size_t i = 0;; ++i) {
    const char* warning = obvid_contour_warning(contour.get(), i);
    if (warning == nullptr) break;
    out["warnings"].push_back(warning);
  }
  return out;
}

json worksheet_of(const json& request, const std::function<bool()>& cancelled) {
  json out;
  Call call(cancelled);
  const Held<obvid_input> input = input_of(request, call.error());
  obvid_files* made = nullptr;
  if (input) {
    obvid_worksheet(input.get(), options_of(request).c_str(),
                    text_in(request, "format", "csv").c_str(), call.run(), &made, call.error());
  }
  call.put_into(out);
  put_files(made, out);
  return out;
}

using Job = int (*)(const obvid_input*, const char*, const obvid_run*, char**, obvid_error**);

json report_of(Job job, const json& request, const std::function<bool()>& cancelled) {
  json out;
  Call call(cancelled);
  const Held<obvid_input> input = input_of(request, call.error());
  if (input) {
    job(input.get(), options_of(request).c_str(), call.run(), call.report(), call.error());
  }
  call.put_into(out);
  return out;
}

/// The contour of a contour file that the request holds.
Held<obvid_contour> stored_of(const json& request, obvid_error** error) {
  const std::string text = text_in(request, "contour", "");
  obvid_input* input = nullptr;
  obvid_contour* contour = nullptr;
  const std::string name = text_in(request, "name", "contour.json");
  if (obvid_read_text(text.data(), text.size(), name.c_str(), &input, error) == 0) {
    obvid_stored(input, nullptr, nullptr, &contour, error);
    obvid_input_free(input);
  }
  return Held<obvid_contour>(contour);
}

json drawn_of(const json& request, const std::function<bool()>& cancelled) {
  json out;
  Call call(cancelled);
  const Held<obvid_input> input = input_of(request, call.error());
  Held<obvid_contour> contour;
  if (input) {
    obvid_contour* made = nullptr;
    obvid_stored(input.get(), options_of(request).c_str(), call.run(), &made, call.error());
    contour.reset(made);
  }
  call.put_into(out);
  if (contour) out["curve"] = curve_of(*contour, samples_of(request));
  return out;
}

json verified(const json& request, const std::function<bool()>& cancelled) {
  json out;
  Call call(cancelled);
  const Held<obvid_contour> contour = stored_of(request, call.error());
  if (contour) obvid_verify(contour.get(), call.run(), call.report(), call.error());
  call.put_into(out);
  return out;
}

json exported(const json& request, const std::function<bool()>& cancelled) {
  json out;
  Call call(cancelled);
  const Held<obvid_contour> contour = stored_of(request, call.error());
  obvid_files* made = nullptr;
  if (contour) {
    obvid_export(contour.get(), text_in(request, "format", "json").c_str(),
                 options_of(request).c_str(), call.run(), &made, call.error());
  }
  call.put_into(out);
  put_files(made, out);
  return out;
}

json answered(std::string_view kind, const std::string& text,
              const std::function<bool()>& cancelled) {
  const json request = json::parse(text, nullptr, false);
  if (!request.is_object()) return {{"error", usage("the request is no JSON object")}};
  if (kind == "fit") return fit_of(request, cancelled);
  if (kind == "drawn") return drawn_of(request, cancelled);
  if (kind == "verify") return verified(request, cancelled);
  if (kind == "export") return exported(request, cancelled);
  if (kind == "worksheet") return worksheet_of(request, cancelled);
  struct Named {
    std::string_view kind;
    Job job;
  };
  for (const Named& one : {Named{"series", obvid_series}, Named{"region", obvid_region},
                           Named{"analyse", obvid_analyse}, Named{"compare", obvid_compare},
                           Named{"suggest", obvid_suggest}, Named{"why_not", obvid_why_not}}) {
    if (kind == one.kind) return report_of(one.job, request, cancelled);
  }
  return {{"error", usage("there is no such job")}};
}

}  // namespace

std::string answer(std::string_view kind, const std::string& request,
                   const std::function<bool()>& cancelled) {
  return answered(kind, request, cancelled).dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace obvid::studio
