// SPDX-License-Identifier: Apache-2.0
// Runs every job of the C interface by itself, then from two threads at once over the same handles,
// and compares what they say; then asks for the end of each in its middle, from two threads as
// well. usage: every_job SOURCE_FOLDER
#include <time.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <regex>
#include <string>
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

/// A text of the library, without the times in it.
std::string taken(char* text) {
  static const std::regex kSeconds("\"seconds\": [0-9.e+-]+");
  std::string out = text == nullptr ? "" : std::regex_replace(text, kSeconds, "");
  obvid_free(text);
  return out;
}

std::string told(obvid_files* files) {
  static const std::regex kSeconds("\"seconds\": [0-9.e+-]+");
  std::string out;
  for (std::size_t i = 0; files != nullptr && i < obvid_files_count(files); ++i) {
    std::size_t size = 0;
    const char* data = obvid_files_data(files, i, &size);
    out += std::regex_replace(std::string(data, size), kSeconds, "");
  }
  obvid_files_free(files);
  return out;
}

std::string code_text(int code) { return code == 0 ? "" : " E" + std::to_string(code); }

struct Handles {
  obvid_input *points = nullptr, *drawing = nullptr, *grid = nullptr, *rail = nullptr,
              *table = nullptr, *net = nullptr, *stations = nullptr, *corner = nullptr;
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
      {"surface_make",
       [](const Handles& h, const obvid_run* run) {
         const obvid_input* inputs[] = {h.grid};
         obvid_surface* surface = nullptr;
         char* text = nullptr;
         const int code = obvid_surface_make("grid", inputs, 1, nullptr, 0,
                                             "{\"near\": true, \"tolerance\": 0.05}", run, &surface,
                                             &text, nullptr);
         obvid_surface_free(surface);
         return taken(text) + code_text(code);
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
      {"scatter",
       [](const Handles& h, const obvid_run* run) {
         obvid_surface* surface = nullptr;
         char* text = nullptr;
         const int code = obvid_surface_make("scatter", &h.grid, 1, nullptr, 0,
                                             "{\"tolerance\": 0.1}", run, &surface, &text, nullptr);
         obvid_surface_free(surface);
         return taken(text) + code_text(code);
       }},
      {"skin",
       [](const Handles& h, const obvid_run* run) {
         obvid_surface* surface = nullptr;
         char* text = nullptr;
         const int code = obvid_surface_make("skin", &h.stations, 1, nullptr, 0, nullptr, run,
                                             &surface, &text, nullptr);
         obvid_surface_free(surface);
         return taken(text) + code_text(code);
       }},
      {"fillet",
       [](const Handles& h, const obvid_run* run) {
         obvid_surface* surface = nullptr;
         char* text = nullptr;
         const int code = obvid_surface_make("fillet", &h.corner, 1, nullptr, 0,
                                             "{\"faces\": \"floor,wall\", \"radius\": 5}", run,
                                             &surface, &text, nullptr);
         std::string out = taken(text) + code_text(code);
         obvid_files* files = nullptr;
         if (surface != nullptr &&
             obvid_surface_export(surface, "json", nullptr, nullptr, &files, nullptr) == 0) {
           out += told(files);
         }
         obvid_surface_free(surface);
         return out;
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
  for (const char* options :
       {"{}", "{\"carrier\": \"arcs\", \"tolerance\": 0.01}", "{\"carrier\": \"conics\"}",
        "{\"carrier\": \"beziers\"}", "{\"carrier\": \"clothoids\"}", "{\"carrier\": \"bspline\"}",
        "{\"carrier\": \"cubic\"}", "{\"carrier\": \"baseline\"}", "{\"construction\": \"arcs\"}",
        "{\"noise\": 0.05}"}) {
    all.push_back(fit(options));
  }
  for (const char* ending : {"svg", "step", "dxf", "nc", "csv", "obj"}) {
    all.push_back(exported(ending));
  }
  for (const char* ending : {"json", "stl", "glb", "html", "svg"}) {
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
/// printed (50 ms are aimed at; benches/cancellation.py measures longer jobs), not judged.
void ask_often(const Job& job, const Handles& h, const std::string& wanted) {
  Gaps gaps{own_seconds()};
  const obvid_run run{&gaps, nullptr, notes, 0};
  if (job.work(h, &run) != wanted) fault(job.name, "says something else when it is asked");
  notes(&gaps);
  if (gaps.questions < 2) fault(job.name, "never asks whether to go on");
  std::printf("%-32s %6d questions, at most %4.0f ms of processor time between two\n",
              job.name.c_str(), gaps.questions, 1e3 * gaps.longest);
}

/// Cancelled at its questions 0, 1 and 3: there is nothing. Each job asks at least once; quick ones
/// end before a later question, and say all then.
void end_in_the_middle(const Job& job, const Handles& h, const std::string& wanted) {
  for (const int after : {0, 1, 3}) {
    Ending ending{after};
    const obvid_run run{&ending, nullptr, ends, 0};
    const std::string got = job.work(h, &run);
    const std::string cancelled = code_text(OBVID_CANCELLED);
    const bool nothing = got == cancelled || got == "0" + cancelled;
    if (after == 0 && !ending.ended) fault(job.name, "never asks whether to go on");
    if (ending.ended ? !nothing : got != wanted) fault(job.name, "its end left something behind");
    if (ending.questions_after > 0) fault(job.name, "asks again after a yes");
  }
}

/// Both threads do `work` for every job, one forwards and one backwards.
void from_two_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::thread other([&] {
    for (std::size_t i = count; i-- > 0;) work(i);
  });
  for (std::size_t i = 0; i < count; ++i) work(i);
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

bool prepare(const std::string& folder, Handles& h) {
  const auto read = [&](const char* name, obvid_input** input) {
    return obvid_read_file((folder + name).c_str(), input, nullptr) == 0;
  };
  std::vector<double> helix;
  for (int k = 0; k < 8; ++k) {
    helix.insert(helix.end(), {10.0 * std::cos(0.4 * k), 10.0 * std::sin(0.4 * k), 1.5 * k});
  }
  const obvid_input* grid[1] = {nullptr};
  if (!read("/examples/series10.csv", &h.points) ||
      !read("/tests/data/judge/series10.dxf", &h.drawing) ||
      !read("/examples/surfaces/wavy_grid.csv", &h.grid) ||
      !read("/examples/surfaces/wigley_stations.csv", &h.stations)) {
    return false;
  }
  grid[0] = h.grid;
  const std::string table = "x,f\n0,0\n1,0.84\n2,0.9\n3,0.14\n",
                    net = "row,col,x,y,z\n0,0,0,0,0\n0,1,1,0,1\n1,0,0,1,0\n1,1,1,1,3\n",
                    corner = plates_at_a_corner();
  if (obvid_read_text(table.data(), table.size(), "table", &h.table, nullptr) != 0 ||
      obvid_read_text(net.data(), net.size(), "net", &h.net, nullptr) != 0 ||
      obvid_read_text(corner.data(), corner.size(), "corner.json", &h.corner, nullptr) != 0) {
    return false;
  }
  return obvid_space_points(helix.data(), 8, &h.rail, nullptr) == 0 &&
         obvid_fit(h.points, nullptr, nullptr, &h.contour, nullptr, nullptr) == 0 &&
         obvid_fit_space(h.rail, nullptr, nullptr, &h.space, nullptr, nullptr) == 0 &&
         obvid_surface_make("grid", grid, 1, nullptr, 0, nullptr, nullptr, &h.surface, nullptr,
                            nullptr) == 0;
}

}  // namespace

int main(int count, char** arguments) {
  Handles h;
  if (count != 2) {
    std::fprintf(stderr, "usage: every_job SOURCE_FOLDER\n");
    return 2;
  }
  if (!prepare(arguments[1], h)) {
    std::fprintf(stderr, "every_job: what the jobs work on could not be made\n");
    return 1;
  }
  std::vector<Job> all = jobs();
  constexpr int kNoHelper = 310;
  const int kernel = prepare_kernel(h);
  if (kernel == 0) {
    for (Job& job : jobs_of_kernel()) all.push_back(std::move(job));
  } else if (kernel == kNoHelper) {
    std::printf("without the helper program of the CAD kernel: its jobs are left out\n");
  } else {
    fault("files of the CAD kernel", "could not be made");
  }
  std::vector<std::string> wanted;
  for (const Job& job : all) {
    wanted.push_back(job.work(h, nullptr));
    if (wanted.back().empty()) fault(job.name, "says nothing");
  }
  from_two_threads(all.size(), [&](std::size_t i) {
    if (all[i].work(h, nullptr) != wanted[i])
      fault(all[i].name, "says something else beside another job");
  });
  for (std::size_t i = 0; i < all.size(); ++i) ask_often(all[i], h, wanted[i]);
  from_two_threads(all.size(), [&](std::size_t i) { end_in_the_middle(all[i], h, wanted[i]); });
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].work(h, nullptr) != wanted[i])
      fault(all[i].name, "says something else after all ends");
  }
  obvid_surface_free(h.surface);
  obvid_space_free(h.space);
  obvid_contour_free(h.contour);
  for (obvid_input* input : {h.points, h.drawing, h.grid, h.rail, h.table, h.net, h.stations,
                             h.corner, h.step, h.faces}) {
    obvid_input_free(input);
  }
  std::printf("%zu jobs, %d faults\n", all.size(), faults.load());
  return faults == 0 ? 0 : 1;
}
