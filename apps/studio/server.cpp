// SPDX-License-Identifier: Apache-2.0
#include "server.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine.h"
#include "httplib.h"

namespace obvid::studio {
namespace {

constexpr const char* kHost = "127.0.0.1";
constexpr std::size_t kMostBytes = 64U << 20U;  // of a request
constexpr int kSecondsToRead = 10, kSecondsToWrite = 30;
constexpr std::chrono::seconds kMostToAnswer{120};
/// With this addition the library does not compress, which takes seconds a megabyte.
constexpr const char* kJson = "application/json; charset=utf-8";
constexpr std::size_t kTokenBytes = 16;

/// Nobody else on this machine can guess it; empty: the system gave no random bytes.
std::string new_token() {
  std::array<std::uint8_t, kTokenBytes> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) return {};
  std::string out;
  for (const std::uint8_t byte : bytes) out += fmt::format("{:02x}", byte);
  return out;
}

/// Takes as long whatever differs.
bool same(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned differ = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differ |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return differ == 0;
}

}  // namespace

/// The newest request of each page and kind; older ones end.
class NewestRequests {
 public:
  using Number = std::shared_ptr<std::atomic<std::uint64_t>>;

  /// Whether a request that begins now is still the newest.
  std::function<bool()> begin(const std::string& key) {
    Number newest;
    {
      const std::lock_guard lock(mutex_);
      Number& held = numbers_[key];
      if (!held) held = std::make_shared<std::atomic<std::uint64_t>>(0);
      newest = held;
    }
    const std::uint64_t mine = newest->fetch_add(1) + 1;
    return [newest, mine] { return newest->load() != mine; };
  }

 private:
  std::mutex mutex_;
  std::map<std::string, Number> numbers_;
};

struct Server::Parts {
  Settings settings;
  std::string token;
  std::string origin;  ///< http://127.0.0.1:port
  httplib::Server http;
  NewestRequests newest;
  std::atomic<bool> stopping = false;

  [[nodiscard]] bool is_ours(const httplib::Request& request) const {
    const std::string host = request.get_header_value("Host");
    if ("http://" + host != origin) return false;
    return !request.has_header("Origin") || request.get_header_value("Origin") == origin;
  }

  void refuse(httplib::Response& response, int status, const std::string& why) const {
    response.status = status;
    response.set_content(why, "text/plain");
  }

  void page(const httplib::Request& request, httplib::Response& response) const {
    if (!is_ours(request) || !same(request.get_param_value("token"), token)) {
      refuse(response, 403, "open the address that obvid studio printed");
      return;
    }
    response.set_header("Cache-Control", "no-store");
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Referrer-Policy", "no-referrer");
    response.set_header("Content-Security-Policy",
                        "default-src 'none'; script-src 'unsafe-inline'; style-src "
                        "'unsafe-inline'; img-src data: blob:; connect-src 'self'; "
                        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    response.set_content(settings.page, "text/html; charset=utf-8");
  }

  void job(const httplib::Request& request, httplib::Response& response) {
    if (!is_ours(request) || !same(request.get_header_value("X-Obvid-Token"), token)) {
      refuse(response, 403, "the token is missing");
      return;
    }
    const std::string kind = request.matches[1].str();
    const std::string page = request.get_header_value("X-Obvid-Page").substr(0, 64);
    response.set_header("Cache-Control", "no-store");
    if (kind == "opened") {
      const nlohmann::json opened = {{"name", settings.opened.name},
                                     {"text", settings.opened.text}};
      response.set_content(opened.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
                           kJson);
      return;
    }
    const auto older = newest.begin(page + ' ' + kind);
    const auto until = std::chrono::steady_clock::now() + kMostToAnswer;
    bool late = false;
    std::string text = answer(kind, request.body, [&] {
      late = late || std::chrono::steady_clock::now() > until;
      return late || older() || stopping.load();
    });
    if (late) {
      refuse(response, 503,
             fmt::format("given up after {} s; fewer points, a noise or another curve family may do",
                         kMostToAnswer.count()));
      return;
    }
    response.set_content(std::move(text), kJson);
  }
};

Server::Server(Settings settings) : parts_(new Parts) { parts_->settings = std::move(settings); }
Server::~Server() { delete parts_; }

std::optional<std::string> Server::bind() {
  Parts& p = *parts_;
  p.token = new_token();
  if (p.token.empty()) return std::nullopt;
  p.http.set_payload_max_length(kMostBytes);
  p.http.set_read_timeout(kSecondsToRead, 0);
  p.http.set_write_timeout(kSecondsToWrite, 0);
  p.http.set_tcp_nodelay(true);
  p.http.Get("/", [&p](const auto& request, auto& response) { p.page(request, response); });
  p.http.Post("/api/([a-z_]{1,20})",
              [&p](const auto& request, auto& response) { p.job(request, response); });
  p.http.set_exception_handler([](const auto&, auto& response, std::exception_ptr) {
    response.status = 500;
    response.set_content("out of memory", "text/plain");
  });
  const int port = p.settings.port > 0
                       ? (p.http.bind_to_port(kHost, p.settings.port) ? p.settings.port : -1)
                       : p.http.bind_to_any_port(kHost);
  if (port <= 0) return std::nullopt;
  p.origin = fmt::format("http://{}:{}", kHost, port);
  return fmt::format("{}/?token={}", p.origin, p.token);
}

void Server::run() { parts_->http.listen_after_bind(); }

void Server::stop() {
  parts_->stopping = true;
  parts_->http.stop();
}

}  // namespace obvid::studio
