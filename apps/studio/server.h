// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <optional>
#include <string>

namespace obvid::studio {

/// What the page opens with.
struct Opened {
  std::string name;  ///< of the file; empty: none was named
  std::string text;
};

struct Settings {
  std::string page;  ///< the page, one HTML text
  Opened opened;
  int port = 0;  ///< 0: any that is free
};

/// Serves the page and the engine to browsers of this machine.
///
/// Listens on 127.0.0.1 alone. Every request must carry the token of this start, in the address of
/// the page or in the header X-Obvid-Token of jobs, and name this server as Host; with an Origin,
/// it must be this server's. Requests are limited in size and time, and none of them names a file:
/// the page hands texts over and gets texts back. Newer requests of a kind cancel older ones of the
/// same page.
class Server {
 public:
  explicit Server(Settings settings);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The address with its token; nothing where no port could be had.
  [[nodiscard]] std::optional<std::string> bind();
  /// Until `stop`. After `bind`.
  void run();
  /// From any thread, and from a handler of signals.
  void stop();

 private:
  struct Parts;
  Parts* parts_;
};

}  // namespace obvid::studio
