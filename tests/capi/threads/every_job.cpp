// SPDX-License-Identifier: Apache-2.0
// Runs every job of the C interface by itself, then from two threads at once over the same handles,
// and compares what they say; then asks for the end of each in its middle, from two threads as
// well, with inputs that are large enough for one. usage: every_job SOURCE_FOLDER [kernel], the
// second: jobs of the helper program of the CAD kernel. tests/capi/jobs_test.py looks that all
// functions, kinds of surfaces and formats are among them.
#include <time.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "obvid/obvid.h"

namespace {

std::atomic<int> faults{0};

void fault(const std::string& job, const char* what) {
  std::fprintf(stderr, "%s: %s\n", job.c_str(), what);
  ++faults;
}

/// Without the times in it.
std::string timeless(std::string_view text) {
  constexpr std::string_view kSeconds = "\"seconds\": ";
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t time = std::min(text.find(kSeconds, at), text.size());
    out.append(text.substr(at, time - at));
    if (time == text.size()) break;
    at = std::min(text.find_first_not_of("0123456789.e+-", time + kSeconds.size()), text.size());
  }
  return out;
}

/// A text of the library.
std::string taken(char* text) {
  std::string out = text == nullptr ? "" : timeless(text);
  obvid_free(text);
  return out;
}

std::string told(obvid_files* files) {
  std::string out;
  for (std::size_t i = 0; files != nullptr && i < obvid_files_count(files); ++i) {
    std::size_t size = 0;
    const char* data = obvid_files_data(files, i, &size);
    out += timeless({data, size});
  }
  obvid_files_free(files);
  return out;
}

std::string code_text(int code) { return code == 0 ? "" : " E" + std::to_string(code); }

struct Handles {
  obvid_input *points = nullptr, *drawing = nullptr, *grid = nullptr, *rail = nullptr,
              *table = nullptr, *net = nullptr, *stations = nullptr, *corner = nullptr,
              *stored = nullptr;                  ///< a surface file
  std::vector<double> knots{}, poles{};           ///< of a cubic in space
  std::vector<obvid_input*> curves{};             ///< four borders, in order, then two across
  obvid_input *step = nullptr, *faces = nullptr;  ///< curves and faces of files of the CAD kernel
  obvid_contour* contour = nullptr;
  obvid_space* space = nullptr;
  obvid_surface* surface = nullptr;
};

/// A job: what it says, and how it ended.
struct Job {
  std::string name;
  std::function<std::string(const Handles&, const obvid_run*)> work;
};

using Report = int (*)(const obvid_input*, const char*, const obvid_run*, char**, obvid_error**);

Job on_points(const char* name, Report job, const char* options, bool drawing = false) {
  return {name, [=](const Handles& h, const obvid_run* run) {
            char* text = nullptr;
            const int code = job(drawing ? h.drawing : h.points, options, run, &text, nullptr);
            return taken(text) + code_text(code);
          }};
}

using File = int (*)(const obvid_input*, const char*, const char*, const obvid_run*, obvid_files**,
                     obvid_error**);

Job file_of_points(const char* name, File job, const char* ending, const char* options = nullptr,
                   bool drawing = false) {
  return {name, [=](const Handles& h, const obvid_run* run) {
            obvid_files* files = nullptr;
            const int code =
                job(drawing ? h.drawing : h.points, options, ending, run, &files, nullptr);
            return told(files) + code_text(code);
          }};
}

Job fit(const char* options) {
  return {std::string("fit ") + options, [=](const Handles& h, const obvid_run* run) {
            obvid_contour* contour = nullptr;
            char* text = nullptr;
            const int code = obvid_fit(h.points, options, run, &contour, &text, nullptr);
            std::string out = taken(text) + code_text(code);
            obvid_files* files = nullptr;
            if (contour != nullptr &&
                obvid_export(contour, "json", nullptr, nullptr, &files, nullptr) == 0) {
              out += told(files);
            }
            obvid_contour_free(contour);
            return out;
          }};
}

Job exported(const char* ending) {
  return {std::string("export ") + ending, [=](const Handles& h, const obvid_run* run) {
            obvid_files* files = nullptr;
            const int code = obvid_export(h.contour, ending, nullptr, run, &files, nullptr);
            return told(files) + code_text(code);
          }};
}

Job surface_file(const char* ending) {
  return {std::string("surface_export ") + ending, [=](const Handles& h, const obvid_run* run) {
            obvid_files* files = nullptr;
            const int code = obvid_surface_export(h.surface, ending, "{\"chord-tolerance\": 0.1}",
                                                  run, &files, nullptr);
            return told(files) + code_text(code);
          }};
}

/// Jobs that need the helper program of the CAD kernel: what reads its files, what writes them.
std::vector<Job> jobs_of_kernel() {
  std::vector<Job> all = {
      {"analyse a STEP file",
       [](const Handles& h, const obvid_run* run) {
         char* text = nullptr;
         const int code = obvid_analyse(h.step, nullptr, run, &text, nullptr);
         return taken(text) + code_text(code);
       }},
      {"stored of a STEP file",
       [](const Handles& h, const obvid_run* run) {
         obvid_contour* contour = nullptr;
         const int code = obvid_stored(h.step, nullptr, run, &contour, nullptr);
         const std::size_t pieces = contour == nullptr ? 0 : obvid_contour_pieces(contour);
         obvid_contour_free(contour);
         return std::to_string(pieces) + code_text(code);
       }},
      {"convert a STEP file", [](const Handles& h, const obvid_run* run) {
         obvid_surface* surface = nullptr;
         char* text = nullptr;
         const int code = obvid_surface_make("convert", &h.faces, 1, nullptr, 0, nullptr, run,
                                             &surface, &text, nullptr);
         obvid_surface_free(surface);
         return taken(text) + code_text(code);
       }}};
  for (const char* ending : {"iges", "brep"}) all.push_back(exported(ending));
  for (const char* ending : {"step", "iges", "brep"}) all.push_back(surface_file(ending));
  return all;
}

/// The first text that is made, to be read again; E310 where the kernel's helper is not there.
int read_back(int code, obvid_files* files, const char* name, obvid_input** input) {
  if (code != 0) return code;
  std::size_t size = 0;
  const char* data = obvid_files_data(files, 0, &size);
  const int read = obvid_read_text(data, size, name, input, nullptr);
  obvid_files_free(files);
  return read;
}

/// Files of the kernel, of what the other jobs work on.
int prepare_kernel(Handles& h) {
  obvid_files *curve = nullptr, *faces = nullptr;
  const int made = obvid_export(h.contour, "step", nullptr, nullptr, &curve, nullptr);
  if (const int code = read_back(made, curve, "curve.step", &h.step); code != 0) return code;
  const int written = obvid_surface_export(h.surface, "step", nullptr, nullptr, &faces, nullptr);
  return read_back(written, faces, "faces.step", &h.faces);
}

/// A surface of some inputs, and of some across; what it says, and its file.
Job surface_of(const char* kind, std::vector<obvid_input*> (*inputs)(const Handles&),
               const char* options = nullptr,
               std::vector<obvid_input*> (*across)(const Handles&) = nullptr) {
  return {std::string("surface ") + kind, [=](const Handles& h, const obvid_run* run) {
            const auto first = inputs(h);
            const auto second = across == nullptr ? std::vector<obvid_input*>{} : across(h);
            obvid_surface* surface = nullptr;
            char* text = nullptr;
            const int code =
                obvid_surface_make(kind, first.data(), first.size(), second.data(), second.size(),
                                   options, run, &surface, &text, nullptr);
            std::string out = taken(text) + code_text(code);
            obvid_files* files = nullptr;
            if (surface != nullptr &&
                obvid_surface_export(surface, "json", nullptr, nullptr, &files, nullptr) == 0) {
              out += told(files);
            }
            obvid_surface_free(surface);
            return out;
          }};
}

std::vector<Job> jobs_of_kinds() {
  using Inputs = std::vector<obvid_input*>;
  const auto grid = [](const Handles& h) { return Inputs{h.grid}; };
  const auto stored = [](const Handles& h) { return Inputs{h.stored}; };
  const auto corner = [](const Handles& h) { return Inputs{h.corner}; };
  const auto one = [](const Handles& h) { return Inputs{h.curves[0]}; };
  const auto two = [](const Handles& h) { return Inputs{h.curves[0], h.curves[2]}; };
  const auto borders = [](const Handles& h) {
    return Inputs(h.curves.begin(), h.curves.begin() + 4);
  };
  const auto across = [](const Handles& h) { return Inputs{h.curves[3], h.curves[1]}; };
  return {surface_of("skin", [](const Handles& h) { return Inputs{h.stations}; }),
          surface_of("ruled", two),
          surface_of("revolve", one, "{\"axis\": \"z\"}"),
          surface_of("coons", borders),
          surface_of("gordon", two, nullptr, across),
          surface_of("grid", grid, "{\"near\": true, \"tolerance\": 0.05}"),
          surface_of("id", grid),
          surface_of("scatter", grid, "{\"tolerance\": 0.1}"),
          surface_of("offset", stored, "{\"distance\": 0.2}"),
          surface_of("trim", stored, "{\"plane\": \"x=20\", \"keep\": \"below\"}"),
          surface_of("fillet", corner, "{\"faces\": \"floor,wall\", \"radius\": 5}"),
          surface_of("match", corner,
                     "{\"border\": \"wall:u0\", \"to\": \"floor:u1\", \"join\": \"G1\"}"),
          surface_of("convert", stored)};
}

std::vector<Job> jobs() {
  std::vector<Job> all = {
      on_points("suggest", obvid_suggest, "{}"),
      on_points("analyse", obvid_analyse, nullptr),
      on_points("analyse a drawing", obvid_analyse, nullptr, true),
      on_points("series", obvid_series, nullptr),
      on_points("region", obvid_region, "{\"tolerance\": 0.1}"),
      on_points("compare", obvid_compare, "{}"),
      on_points("why_not", obvid_why_not, "{\"start-heading\": 170, \"end-heading\": 10}"),
      file_of_points("worksheet", obvid_worksheet, "csv"),
      file_of_points("analyse_file", obvid_analyse_file, "csv"),
      file_of_points("analyse_file of a drawing", obvid_analyse_file, "svg", nullptr, true),
      file_of_points("compare_file", obvid_compare_file, "svg"),
      file_of_points("suggest_file", obvid_suggest_file, "svg"),
      file_of_points("why_not_file", obvid_why_not_file, "svg",
                     "{\"start-heading\": 170, \"end-heading\": 10}"),
      {"stored",
       [](const Handles& h, const obvid_run* run) {
         obvid_contour* contour = nullptr;
         const int code = obvid_stored(h.drawing, nullptr, run, &contour, nullptr);
         const std::size_t pieces = contour == nullptr ? 0 : obvid_contour_pieces(contour);
         obvid_contour_free(contour);
         return std::to_string(pieces) + code_text(code);
       }},
      {"verify",
       [](const Handles& h, const obvid_run* run) {
         char* text = nullptr;
         const int code = obvid_verify(h.contour, run, &text, nullptr);
         return taken(text) + code_text(code);
       }},
      {"fit_space",
       [](const Handles& h, const obvid_run* run) {
         char* text = nullptr;
         const int code = obvid_fit_space(h.rail, nullptr, run, nullptr, &text, nullptr);
         return taken(text) + code_text(code);
       }},
      {"verify_space",
       [](const Handles& h, const obvid_run* run) {
         char* text = nullptr;
         const int code = obvid_verify_space(h.space, run, &text, nullptr);
         return taken(text) + code_text(code);
       }},
      {"space_export",
       [](const Handles& h, const obvid_run* run) {
         obvid_files* files = nullptr;
         const int code = obvid_space_export(h.space, "step", nullptr, run, &files, nullptr);
         return told(files) + code_text(code);
       }},
      {"surface_check",
       [](const Handles& h, const obvid_run* run) {
         char* text = nullptr;
         const int code = obvid_surface_check(h.surface, "{\"samples\": 12}", run, &text, nullptr);
         return taken(text) + code_text(code);
       }},
      {"alignment",
       [](const Handles& h, const obvid_run* run) {
         obvid_files* files = nullptr;
         char* text = nullptr;
         const int code = obvid_alignment(h.points, nullptr, "{\"noise\": 0.5}", run, nullptr,
                                          &files, &text, nullptr);
         return told(files) + taken(text) + code_text(code);
       }},
      {"compare_curves",
       [](const Handles& h, const obvid_run* run) {
         const obvid_input* inputs[] = {h.points, h.points};
         obvid_files* files = nullptr;
         char* text = nullptr;
         const int code = obvid_compare_curves(inputs, 2, nullptr, run, &files, &text, nullptr);
         return told(files) + taken(text) + code_text(code);
       }},
      {"cut",
       [](const Handles& h, const obvid_run* run) {
         obvid_files* files = nullptr;
         char* text = nullptr;
         const int code = obvid_cut(&h.drawing, 1, "{\"diameter\": 0.01, \"depth\": 1}", run,
                                    &files, &text, nullptr);
         return told(files) + taken(text) + code_text(code);
       }},
      {"spline",
       [](const Handles& h, const obvid_run* run) {
         obvid_files* files = nullptr;
         char* text = nullptr;
         const int code = obvid_spline(h.table, h.table, "{\"compare\": true}", "dxf", run, nullptr,
                                       &files, &text, nullptr);
         return told(files) + taken(text) + code_text(code);
       }},
      {"nurbs_make",
       [](const Handles& h, const obvid_run* run) {
         obvid_surface* surface = nullptr;
         char* text = nullptr;
         const int code =
             obvid_nurbs_make(h.net, nullptr, nullptr, run, &surface, nullptr, &text, nullptr);
         const bool made = surface != nullptr;
         obvid_surface_free(surface);
         return taken(text) + (made ? " surface" : "") + code_text(code);
       }},
      {"space_audit",
       [](const Handles& h, const obvid_run* run) {
         char* text = nullptr;
         const int code = obvid_space_audit(3, h.knots.size() - 4, h.knots.data(), h.poles.data(),
                                            nullptr, run, &text, nullptr);
         return taken(text) + code_text(code);
       }},
      {"verify_file",
       [](const Handles& h, const obvid_run* run) {
         obvid_files* files = nullptr;
         const int code = obvid_verify_file(h.contour, "html", run, &files, nullptr);
         return told(files) + code_text(code);
       }},
      {"surface_check_file",
       [](const Handles& h, const obvid_run* run) {
         obvid_files* files = nullptr;
         const int code =
             obvid_surface_check_file(h.surface, "{\"samples\": 12}", "svg", run, &files, nullptr);
         return told(files) + code_text(code);
       }},
      {"surface_branches",
       [](const Handles& h, const obvid_run* run) {
         obvid_files* files = nullptr;
         const int code = obvid_surface_branches(h.surface, "{\"waterlines\": \"count:5\"}", "csv",
                                                 run, &files, nullptr);
         return told(files) + code_text(code);
       }},
      {"surface_cut",
       [](const Handles& h, const obvid_run* run) {
         obvid_files* files = nullptr;
         char* text = nullptr;
         const int code = obvid_surface_cut(
             h.surface, "{\"waterlines\": \"count:5\", \"plane\": \"1,1,0,40\", \"draught\": 2}",
             run, &files, &text, nullptr);
         return told(files) + taken(text) + code_text(code);
       }},
      {"surface_toolpath", [](const Handles& h, const obvid_run* run) {
         obvid_files* files = nullptr;
         char* text = nullptr;
         const int code = obvid_surface_toolpath(
             h.surface, "{\"diameter\": 6, \"scallop\": 0.3, \"tolerance\": 0.1}", run, &files,
             &text, nullptr);
         return told(files) + taken(text) + code_text(code);
       }}};
  for (Job& job : jobs_of_kinds()) all.push_back(std::move(job));
  for (const char* options :
       {"{}", "{\"carrier\": \"arcs\", \"tolerance\": 0.01}", "{\"carrier\": \"conics\"}",
        "{\"carrier\": \"beziers\"}", "{\"carrier\": \"clothoids\"}", "{\"carrier\": \"bspline\"}",
        "{\"carrier\": \"cubic\"}", "{\"carrier\": \"baseline\"}", "{\"construction\": \"arcs\"}",
        "{\"noise\": 0.05}"}) {
    all.push_back(fit(options));
  }
  for (const char* ending : {"json", "svg", "step", "dxf", "nc", "xodr", "xml", "csv", "dat",
                             "sldcrv", "swb", "obj", "ply", "html"}) {
    all.push_back(exported(ending));
  }
  for (const char* ending : {"json", "stl", "obj", "glb", "ply", "html", "svg"}) {
    all.push_back(surface_file(ending));
  }
  return all;
}

/// Says yes to the question of this number and does not expect another.
struct Ending {
  int left = 0;
  bool ended = false;
  int questions_after = 0;
};

int ends(void* user) {
  auto* const ending = static_cast<Ending*>(user);
  if (ending->ended) ++ending->questions_after;
  ending->ended = ending->ended || ending->left-- <= 0;
  return ending->ended ? 1 : 0;
}

/// Processor time of this thread, s.
double own_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Gaps {
  double last = 0.0, longest = 0.0;
  int questions = 0;
};

int notes(void* user) {
  auto* const gaps = static_cast<Gaps*>(user);
  const double now = own_seconds();
  gaps->longest = std::max(gaps->longest, now - gaps->last);
  gaps->last = now;
  ++gaps->questions;
  return 0;
}

/// A job that is asked to go on does, and asks again. How long it goes without a question is
/// printed (50 ms are aimed at; benches/cancellation.py measures longer jobs), not judged. How
/// often it asked.
int ask_often(const Job& job, const Handles& h, const std::string& wanted) {
  Gaps gaps{own_seconds()};
  const obvid_run run{&gaps, nullptr, notes, 0};
  if (job.work(h, &run) != wanted) fault(job.name, "says something else when it is asked");
  const int questions = gaps.questions;
  notes(&gaps);
  if (questions < 1) fault(job.name, "never asks whether to go on");
  std::printf("%-32s %6d questions, at most %4.0f ms of processor time between two\n",
              job.name.c_str(), gaps.questions, 1e3 * gaps.longest);
  return questions;
}

/// Cancelled at a question, counted from 0: there is nothing. Whether it came to that: the library
/// asks by the clock, and a quick run may end before.
bool ends_at(int question, const Job& job, const Handles& h, const std::string& wanted) {
  Ending ending{question};
  const obvid_run run{&ending, nullptr, ends, 0};
  const std::string got = job.work(h, &run);
  const std::string cancelled = code_text(OBVID_CANCELLED);
  const bool nothing = got == cancelled || got == "0" + cancelled;
  if (ending.ended ? !nothing : got != wanted) fault(job.name, "its end left something behind");
  if (ending.questions_after > 0) fault(job.name, "asks again after a yes");
  return ending.ended;
}

/// What a job is ended on: inputs so large that it has a middle, what it says of them, and how
/// often it asked then.
struct Middle {
  const Handles* handles = nullptr;
  std::string wanted;
  int questions = 0;
  bool there = false;
};

Middle asked_on(const Job& job, const Handles& h) {
  Gaps gaps{own_seconds()};
  const obvid_run run{&gaps, nullptr, notes, 0};
  Middle out{&h, job.work(h, &run)};
  out.questions = gaps.questions;
  return out;
}

constexpr int kWithMiddle = 3;  // questions of a job that has one
constexpr int kTries = 5;       // of a middle that quick runs may miss

/// The first of its questions always comes.
void end_at_once(const Job& job, const Middle& on) {
  if (!ends_at(0, job, *on.handles, on.wanted)) fault(job.name, "never asks whether to go on");
}

void end_in_the_middle(const Job& job, const Middle& on) {
  int questions = on.questions;
  for (int k = 0; k < kTries; ++k) {
    if (ends_at(questions / 2, job, *on.handles, on.wanted)) return;
    questions = asked_on(job, *on.handles).questions;
  }
  fault(job.name, "its middle was never reached");
}

/// The last question of a quicker run may not come.
void end_at_last(const Job& job, const Middle& on) {
  (void)ends_at(on.questions - 1, job, *on.handles, on.wanted);
}

/// Both threads do `work` for every job, one forwards and one backwards, and are told which of them
/// they are.
void from_two_threads(std::size_t count,
                      const std::function<void(std::size_t job, std::size_t thread)>& work) {
  std::thread other([&] {
    for (std::size_t i = count; i-- > 0;) work(i, 1);
  });
  for (std::size_t i = 0; i < count; ++i) work(i, 0);
  other.join();
}

/// A surface file: two plates, 40 x 30 and 40 x 25, that share an edge at a right angle.
std::string plates_at_a_corner() {
  const auto plate = [](const char* name, const char* far) {
    return std::string("{\"name\": \"") + name +
           "\", \"degree_u\": 1, \"degree_v\": 1, \"knots_u\": [0, 0, 1, 1], \"knots_v\": [0, 0, "
           "1, 1], "
           "\"points\": [[0, 0, 0], [40, 0, 0], [0, " +
           far + "], [40, " + far + "]]}";
  };
  return "{\"format\": \"obvid-surface\", \"version\": 1, \"name\": \"corner\", \"units\": \"mm\", "
         "\"units_source\": \"given\", \"patches\": [" +
         plate("floor", "30, 0") + ", " + plate("wall", "0, 25") + "]}";
}

/// How large the inputs are: those of level 0 are the files of the project.
struct Size {
  int points, rows, side, turns;
};
constexpr std::array<Size, 4> kSizes{
    {{0, 4, 0, 8}, {300, 60, 24, 16}, {2000, 400, 60, 32}, {12000, 3000, 140, 48}}};

bool read_text(const std::string& text, const char* name, obvid_input** input) {
  return obvid_read_text(text.data(), text.size(), name, input, nullptr) == 0;
}

/// All digits.
std::string figure(double number) {
  std::array<char, 32> out{};
  std::snprintf(out.data(), out.size(), "%.17g", number);
  return out.data();
}

/// Points x, y, z of a grid of so many rows and columns over gentle waves.
std::string grid_rows(int side) {
  std::string out = "x,y,z\n";
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double x = 60.0 * i / (side - 1), y = 40.0 * j / (side - 1);
      out += figure(x) + "," + figure(y) + "," +
             figure(3.0 * std::sin(0.1 * x) * std::cos(0.08 * y)) + "\n";
    }
  }
  return out;
}

/// The same as control points.
std::string net_rows(int side) {
  std::string out = "row,col,x,y,z\n";
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      out += figure(j) + "," + figure(i) + "," + figure(i) + "," + figure(j) + "," +
             figure(std::sin(0.3 * i) * std::cos(0.2 * j)) + "\n";
    }
  }
  return out;
}

/// A slow wave, points at equal steps.
std::string wave_rows(int count, const char* heads, double step) {
  std::string out = heads;
  for (int k = 0; k < count; ++k) {
    const double x = step * k;
    out += figure(x) + "," + figure(4.0 * std::sin(0.035 * x) + 9.0 * std::sin(0.011 * x)) + "\n";
  }
  return out;
}

/// Curves of z = x y / 10 over [0, 40] x [0, 30]: its borders, one after the other.
bool read_curves(int count, std::vector<obvid_input*>& curves) {
  const auto along = [count](bool x_runs, double fixed) {
    std::vector<double> out;
    for (int k = 0; k < count; ++k) {
      const double t = static_cast<double>(k) / (count - 1);
      const double x = x_runs ? 40.0 * t : fixed, y = x_runs ? fixed : 30.0 * t;
      out.insert(out.end(), {x, y, 0.1 * x * y});
    }
    return out;
  };
  for (const auto& rows :
       {along(true, 0.0), along(false, 40.0), along(true, 30.0), along(false, 0.0)}) {
    curves.push_back(nullptr);
    if (obvid_space_points(rows.data(), rows.size() / 3, &curves.back(), nullptr) != 0)
      return false;
  }
  return true;
}

/// A file of the first of some files, read back.
bool read_again(obvid_files* files, const char* name, obvid_input** input) {
  return read_back(0, files, name, input) == 0;
}

bool prepare(const std::string& folder, const Size& size, Handles& h) {
  const auto read = [&](const char* name, obvid_input** input) {
    return obvid_read_file((folder + name).c_str(), input, nullptr) == 0;
  };
  std::vector<double> helix;
  for (int k = 0; k < size.turns; ++k) {
    helix.insert(helix.end(), {10.0 * std::cos(0.4 * k), 10.0 * std::sin(0.4 * k), 1.5 * k});
  }
  const bool small = size.points == 0;
  const int spans = std::max(size.points, 4);
  h.knots.assign(3, 0.0);
  for (int k = 0; k <= spans; ++k) h.knots.push_back(k);
  h.knots.insert(h.knots.end(), 3, spans);
  for (int k = 0; k < spans + 3; ++k) {
    h.poles.insert(h.poles.end(), {std::cos(0.3 * k), std::sin(0.3 * k), 0.1 * k});
  }
  if (small ? !read("/examples/series10.csv", &h.points) ||
                  !read("/tests/data/judge/series10.dxf", &h.drawing) ||
                  !read("/examples/surfaces/wavy_grid.csv", &h.grid)
            : !read_text(wave_rows(size.points, "x,y\n", 0.3), "wave.csv", &h.points) ||
                  !read_text(grid_rows(size.side), "grid.csv", &h.grid)) {
    return false;
  }
  if (!read("/examples/surfaces/wigley_stations.csv", &h.stations) ||
      !read_text(wave_rows(size.rows, "x,f\n", 5.0), "table", &h.table) ||
      !read_text(net_rows(std::max(size.side, 2)), "net", &h.net) ||
      !read_text(plates_at_a_corner(), "corner.json", &h.corner) ||
      !read_curves(std::max(size.side, 7), h.curves)) {
    return false;
  }
  const obvid_input* const grid[1] = {h.grid};
  if (obvid_space_points(helix.data(), helix.size() / 3, &h.rail, nullptr) != 0 ||
      obvid_fit(h.points, nullptr, nullptr, &h.contour, nullptr, nullptr) != 0 ||
      obvid_fit_space(h.rail, nullptr, nullptr, &h.space, nullptr, nullptr) != 0 ||
      obvid_surface_make("grid", grid, 1, nullptr, 0, nullptr, nullptr, &h.surface, nullptr,
                         nullptr) != 0) {
    return false;
  }
  obvid_files *drawn = nullptr, *stored = nullptr;
  if (!small && (obvid_export(h.contour, "dxf", nullptr, nullptr, &drawn, nullptr) != 0 ||
                 !read_again(drawn, "wave.dxf", &h.drawing))) {
    return false;
  }
  return obvid_surface_export(h.surface, "json", nullptr, nullptr, &stored, nullptr) == 0 &&
         read_again(stored, "grid.json", &h.stored);
}

void release(Handles& h) {
  obvid_surface_free(h.surface);
  obvid_space_free(h.space);
  obvid_contour_free(h.contour);
  for (obvid_input* input : {h.points, h.drawing, h.grid, h.rail, h.table, h.net, h.stations,
                             h.corner, h.stored, h.step, h.faces}) {
    obvid_input_free(input);
  }
  for (obvid_input* input : h.curves) obvid_input_free(input);
}

/// Inputs of growing size, made when they are wanted.
class Levels {
 public:
  Levels(std::string folder, const Handles& smallest, bool kernel)
      : folder_(std::move(folder)), kernel_(kernel), made_{smallest} {}
  ~Levels() {
    for (std::size_t k = 1; k < made_.size(); ++k) release(made_[k]);
  }
  Levels(const Levels&) = delete;
  Levels& operator=(const Levels&) = delete;

  /// The smallest inputs on which the job asks often enough; `smallest` is how it did on the first.
  Middle middle_of(const Job& job, Middle smallest) {
    Middle out = smallest;
    for (std::size_t k = 0; k < kSizes.size(); ++k) {
      if (k == made_.size() && !grow()) break;
      if (k > 0) out = asked_on(job, made_[k]);
      if (out.questions < kWithMiddle) continue;
      std::printf("%-32s is ended in its middle on inputs %zu, of %d questions\n", job.name.c_str(),
                  k, out.questions);
      out.there = true;
      return out;
    }
    return smallest;
  }

 private:
  bool grow() {
    if (broken_) return false;
    Handles next;
    if (prepare(folder_, kSizes[made_.size()], next) && (!kernel_ || prepare_kernel(next) == 0)) {
      made_.push_back(next);
      return true;
    }
    fault("larger inputs", "could not be made");
    release(next);
    broken_ = true;
    return false;
  }

  std::string folder_;
  bool kernel_, broken_ = false;
  std::deque<Handles> made_;
};

}  // namespace

int main(int count, char** arguments) {
  Handles h;
  const bool kernel = count == 3 && std::string(arguments[2]) == "kernel";
  if (count != 2 && !kernel) {
    std::fprintf(stderr, "usage: every_job SOURCE_FOLDER [kernel]\n");
    return 2;
  }
  if (!prepare(arguments[1], kSizes.front(), h)) {
    std::fprintf(stderr, "every_job: what the jobs work on could not be made\n");
    return 1;
  }
  constexpr int kNoHelper = 310, kSkipped = 77;
  if (kernel) {
    const int code = prepare_kernel(h);
    if (code == kNoHelper) {
      std::printf("SKIPPED: the helper program of the CAD kernel is not there\n");
      return kSkipped;
    }
    if (code != 0) fault("files of the CAD kernel", "could not be made");
  }
  const std::vector<Job> all = kernel ? jobs_of_kernel() : jobs();
  std::vector<std::string> wanted;
  for (const Job& job : all) {
    wanted.push_back(job.work(h, nullptr));
    if (wanted.back().empty()) fault(job.name, "says nothing");
  }
  from_two_threads(all.size(), [&](std::size_t i, std::size_t) {
    if (all[i].work(h, nullptr) != wanted[i])
      fault(all[i].name, "says something else beside another job");
  });
  std::vector<int> questions;
  for (std::size_t i = 0; i < all.size(); ++i) {
    questions.push_back(ask_often(all[i], h, wanted[i]));
  }
  std::size_t without = 0;
  {
    Levels levels(arguments[1], h, kernel);
    std::vector<Middle> middles;
    for (std::size_t i = 0; i < all.size(); ++i) {
      middles.push_back(levels.middle_of(all[i], {&h, wanted[i], questions[i]}));
      // one step of some milliseconds over what was read: it is ended before that
      if (!middles.back().there) std::printf("%s: has no middle\n", all[i].name.c_str());
      without += middles.back().there ? 0 : 1;
    }
    constexpr std::size_t kOneOf = 3;  // the library asks by the clock, and machines differ
    if (kOneOf * without > all.size()) fault("jobs", "too many have no middle to be ended in");
    // Each thread ends every job at once, and of two jobs one in the middle and one at its last
    // question; the other thread does it the other way round.
    from_two_threads(all.size(), [&](std::size_t i, std::size_t thread) {
      end_at_once(all[i], middles[i]);
      if (!middles[i].there) return;
      if ((i + thread) % 2 == 0) {
        end_in_the_middle(all[i], middles[i]);
      } else {
        end_at_last(all[i], middles[i]);
      }
    });
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].work(h, nullptr) != wanted[i])
      fault(all[i].name, "says something else after all ends");
  }
  release(h);
  std::printf("%zu jobs, %zu of them without a middle, ended before they begin alone; %d faults\n",
              all.size(), without, faults.load());
  return faults == 0 ? 0 : 1;
}
