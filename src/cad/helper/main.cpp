// SPDX-License-Identifier: Apache-2.0
// The helper `obvid-cad`: does one job of the kernel's for the program that started it, and ends.
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Standard_Failure.hxx>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "cad_build_mark.h"
#include "helper_file.h"
#include "helper_message.h"
#include "helper_process.h"
#include "read.h"
#include "read_faces.h"
#include "write.h"

/// What the program looks for in this file before it starts it; not folded into other code.
extern "C" {
extern const char obvid_cad_mark[];
const char obvid_cad_mark[] = "obvid-cad " OBVID_CAD_BUILD_MARK;
}

namespace obvid::cad {
namespace {

/// The kernel's chatter belongs neither into the report nor into the errors.
void be_quiet() { Message::DefaultMessenger()->ChangePrinters().Clear(); }

/// A file that cannot be read is the file's fault; geometry that cannot be written is ours.
Error fault(const std::string& text, const std::string& where) {
  const bool reading = !where.empty();
  return {reading ? ErrorCode::kDamaged : ErrorCode::kInternal,
          "the CAD kernel gave up: " + text,
          where,
          reading ? "the file may be damaged; export it again"
                  : "look at it with `obvid verify` or `obvid surface check`",
          -1,
          0.0};
}

/// Whatever the kernel throws becomes an error.
template <class Value, class Work>
Result<Value> guarded(const std::string& where, Work work) {
  try {
    be_quiet();
    return work();
  } catch (const Standard_Failure& failure) {
    const char* text = failure.GetMessageString();
    return fail(fault(text != nullptr && *text != '\0' ? text : "unknown reason", where));
  } catch (const std::bad_alloc&) {
    return fail(fault("out of memory", where));
  } catch (const std::exception& error) {
    return fail(fault(error.what(), where));
  }
}

void limit(decltype(RLIMIT_CPU) resource, rlim_t most, rlim_t beyond) {
  rlimit now{};
  ::getrlimit(resource, &now);
  const rlimit both{std::min(most, now.rlim_max), std::min(beyond, now.rlim_max)};
  ::setrlimit(resource, &both);
}

/// Files come from anywhere: what they make the kernel do has bounds.
void limit_reading() {
  limit(RLIMIT_CPU, kMostProcessorSeconds, kMostProcessorSeconds + 1);
  limit(RLIMIT_AS, kMostBytes, kMostBytes);
  limit(RLIMIT_FSIZE, 0, 0);
}

std::string answer(const ReadCurves& job) {
  limit_reading();
  return packed(guarded<Drawing>(job.path, [&] { return read_file(job.path); }));
}
std::string answer(const ReadFaces& job) {
  limit_reading();
  return packed(guarded<CadSurfaces>(job.path, [&] { return read_faces(job.path); }));
}
std::string answer(const WriteCurves& job) {
  return packed(guarded<std::string>("", [&] { return write_text(job.curves, job.options); }));
}
std::string answer(const WriteFaces& job) {
  return packed(guarded<std::string>("", [&] { return write_surfaces(job.model, job.options); }));
}

/// Whether all of it came.
bool receive(char* to, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::recv(kHelperSocket, to, size, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    to += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

std::optional<Job> received_job() {
  std::uint64_t size = 0;
  if (!receive(reinterpret_cast<char*>(&size), sizeof size)) return std::nullopt;
  std::string bytes(size, '\0');
  if (!receive(bytes.data(), bytes.size())) return std::nullopt;
  return unpacked_job(bytes);
}

void send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::send(kHelperSocket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

/// Nobody sends more than the job: what comes then is the end of the program that asked.
void end_with_the_program() {
  std::thread([] {
    char nothing = 0;
    while (::recv(kHelperSocket, &nothing, 1, 0) < 0 && errno == EINTR) {
    }
    ::_exit(1);
  }).detach();
}

int run() {
  limit(RLIMIT_CORE, 0, 0);
  const std::optional<Job> job = received_job();
  if (!job) {
    std::fprintf(stderr, "%s: started by obvid for STEP, IGES and BREP, of no use by itself\n",
                 obvid_cad_mark);
    return 2;
  }
  end_with_the_program();
  send(std::visit([](const auto& one) { return answer(one); }, *job));
  std::fflush(nullptr);
  ::_exit(0);  // without taking the kernel apart
}

}  // namespace
}  // namespace obvid::cad

int main() { return obvid::cad::run(); }
