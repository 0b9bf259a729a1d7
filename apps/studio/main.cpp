// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <spawn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <thread>

#include "help/help_lines.h"
#include "server.h"
#include "studio_build_mark.h"

/// What the program looks for in this file before it starts it; not folded into other code.
extern "C" {
extern const char obvid_studio_mark[];
const char obvid_studio_mark[] = "obvid-studio " OBVID_STUDIO_BUILD_MARK;
}

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace obvid::studio {
namespace {

constexpr std::uintmax_t kLargestFile = 64U << 20U;

struct Asked {
  std::string file, page;
  int port = 0;
  bool no_browser = false;
};

int fail(int code, const std::string& what, const std::string& where, const std::string& hint) {
  fmt::print(stderr, "obvid: error E{}: {} ({}); {}\n", code, what, where, hint);
  return code / 100;
}

std::optional<std::string> content_of(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  if (std::filesystem::file_size(path, error) > kLargestFile || error) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

/// A page is code, too: a file of root's, of the user's or of the owner of the program, which not
/// everybody may write to.
bool may_be_served(const std::filesystem::path& page, const std::filesystem::path& self) {
  struct stat found {
  }, program{};
  if (::stat(page.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return false;
  const bool programs_owner = ::stat(self.c_str(), &program) == 0 && found.st_uid == program.st_uid;
  return (found.st_uid == 0 || found.st_uid == ::geteuid() || programs_owner) &&
         (found.st_mode & S_IWOTH) == 0;
}

/// Beside the program, or where the install puts it; nothing where no such page may be served.
std::optional<std::string> page_beside(const char* program) {
  std::error_code error;
  std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) self = program;
  const std::filesystem::path folder = self.parent_path();
  for (const auto& place : {folder / "studio.html", folder / "../share/obvid/studio.html",
                            folder / "../../share/obvid/studio.html"}) {
    if (!std::filesystem::exists(place, error)) continue;
    return may_be_served(place, self) ? content_of(place.string()) : std::nullopt;
  }
  return std::nullopt;
}

void open_browser(const std::string& address) {
  std::string program = "xdg-open", argument = address;
  const std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t quiet;
  if (::posix_spawn_file_actions_init(&quiet) != 0) return;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    ::posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_WRONLY, 0);
  }
  pid_t process = 0;
  ::posix_spawnp(&process, program.c_str(), &quiet, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&quiet);
}

int serve(const Asked& asked, const char* program) {
  const auto page = asked.page.empty() ? page_beside(program) : content_of(asked.page);
  if (!page) {
    return fail(301, "the page is missing, or anybody may change it",
                asked.page.empty() ? "studio.html" : asked.page,
                "build it with tools/build_studio");
  }
  Settings settings;
  settings.page = *page;
  settings.port = asked.port;
  if (!asked.file.empty()) {
    const auto text = content_of(asked.file);
    if (!text) {
      return fail(301, "cannot read the file", asked.file,
                  "check the path and the permissions; 64 MB at most");
    }
    settings.opened = {std::filesystem::path(asked.file).filename().string(), *text};
  }
  // signals come to the thread that waits for them, not to those that serve
  sigset_t ends;
  sigemptyset(&ends);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, signal);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  Server server(std::move(settings));
  const auto address = server.bind();
  if (!address) {
    return fail(101, "no port could be had", fmt::format("port {}", asked.port),
                "leave out --port, or name one that is free");
  }
  fmt::print("{}\nCtrl-C ends it\n", *address);
  std::fflush(stdout);
  std::thread serving([&server] { server.run(); });
  if (!asked.no_browser) open_browser(*address);
  int signal = 0;
  sigwait(&ends, &signal);
  server.stop();
  serving.join();
  return 0;
}

int run(int argc, char** argv) {
  CLI::App app(
      "Drag points, see what is possible, get the proof: a page in the browser, for this\n"
      "machine alone",
      "obvid studio");
  constexpr std::size_t kHelpColumn = 30;
  shape_help(app, kHelpColumn, argc, argv);
  Asked asked;
  app.add_option("FILE", asked.file, "Points, a contour or a drawing to begin with");
  app.add_option("--port", asked.port, "Port on 127.0.0.1 [any that is free]")
      ->check(CLI::Range(1, 65535))
      ->option_text("N");
  app.add_flag("--no-browser", asked.no_browser, "Only print the address");
  app.add_option("--page", asked.page, "The page, another than the program's own")->group("");
  app.set_version_flag("--version", obvid_studio_mark);
  app.footer("\nExample: obvid studio points.csv");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return fail(201, error.what(), "obvid studio", "see obvid studio --help");
  }
  return serve(asked, argv[0]);
}

}  // namespace
}  // namespace obvid::studio

int main(int argc, char** argv) {
  try {
    return obvid::studio::run(argc, argv);
  } catch (const std::exception& error) {
    return obvid::studio::fail(101, error.what(), "obvid studio", "please report this");
  }
}
