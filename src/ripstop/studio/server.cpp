#include "ripstop/studio/server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/random.h>
#include <sys/socket.h>

#include <chrono>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "ripstop/case/case.h"
#include "ripstop/case/quantity_keys.h"
#include "ripstop/core/error.h"
#include "ripstop/studio/actions.h"

namespace ripstop::inline studio {
namespace {

using httplib::Request;
using httplib::Response;
using Json = nlohmann::ordered_json;

constexpr std::size_t largest_body = 2 << 20, largest_records = 24 << 20;  // [bytes]
constexpr const char* records_path = "/api/material";
constexpr const char* json_type = "application/json; charset=utf-8";
constexpr const char* page_type = "text/html; charset=utf-8";

std::string random_word() {
  unsigned char bytes[16];
  if (getrandom(bytes, sizeof bytes, 0) != sizeof bytes)
    throw Error(ExitCode::io, "the system has no random numbers");
  std::string word;
  for (unsigned char byte : bytes) word += fmt::format("{:02x}", byte);
  return word;
}

/// Takes as long for any wrong word of this length.
bool same_word(const std::string& a, const std::string& b) {
  unsigned char difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
  return difference == 0;
}

void refuse(Response& response, int status, const std::string& message) {
  response.status = status;
  response.set_content(error_json(message), json_type);
}

std::string parameter(const Request& request, const char* name) {
  if (!request.has_param(name)) throw Error(ExitCode::usage, fmt::format("the request has no {}", name));
  return request.get_param_value(name);
}

int whole_number(const Request& request, const char* name) {
  const std::string text = parameter(request, name);
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos)
    throw Error(ExitCode::usage, fmt::format("{} is not a whole number of at most 9 digits", name));
  return std::stoi(text);
}

struct Body {
  Json json;
  std::string text(const char* name) const {
    if (!json.is_object() || !json.contains(name) || !json.at(name).is_string())
      throw Error(ExitCode::usage, fmt::format("the request has no text {}", name));
    return json.at(name).get<std::string>();
  }
  /// A number, or a text such as "5 lb" that a command reads.
  std::string quantity(const char* name) const {
    if (json.is_object() && json.contains(name) && json.at(name).is_number()) return json.at(name).dump();
    return text(name);
  }
};

Body body_of(const Request& request) {
  Body body{Json::parse(request.body, nullptr, false)};
  if (!body.json.is_object()) throw Error(ExitCode::usage, "the request is not a JSON object");
  return body;
}

/// Answers of an action as JSON, its errors with the message for the page.
template <class Action>
void answer(Response& response, const Action& action) {
  try {
    response.set_content(action(), json_type);
  } catch (const Conflict& error) {
    refuse(response, 409, message_of(error));
  } catch (const Error& error) {
    refuse(response, error.code() == ExitCode::io ? 507 : 400, message_of(error));
  } catch (const std::exception& error) {
    refuse(response, 500, error.what());
  }
}

}  // namespace

struct StudioServer::Parts {
  Parts(const std::filesystem::path& folder, const std::string& program) : actions(folder, program) {}

  Actions actions;
  httplib::Server server;
  std::string token = random_word(), host;
  std::mutex keys_mutex;
  std::map<std::string, std::vector<std::string>> view_keys;  // key -> runs

  bool admitted(const Request& request, Response& response) const;
  void add_pages();
  void add_reading();
  void add_writing();
  void add_runs();

  template <class Action>
  void get(const char* path, Action action) {
    server.Get(path, [action](const Request& request, Response& response) {
      answer(response, [&] { return action(request); });
    });
  }
  template <class Action>
  void post(const char* path, Action action) {
    server.Post(path, [action](const Request& request, Response& response) {
      answer(response, [&] { return action(body_of(request)); });
    });
  }
};

/// Before a body is read.
bool StudioServer::Parts::admitted(const Request& request, Response& response) const {
  const std::string from = request.get_header_value("Host"), origin = request.get_header_value("Origin");
  if (from != host)
    return refuse(response, 403, "wrong Host: use the address that ripstop studio prints"), false;
  if (!origin.empty() && origin != "http://" + host && !(origin == "null" && request.path == "/view"))
    return refuse(response, 403, "a page of another origin cannot use this server"), false;
  if (request.method != "GET" && request.method != "POST")
    return refuse(response, 405, "only GET and POST are served"), false;
  if (request.has_header("Transfer-Encoding") || request.has_header("Content-Encoding"))
    return refuse(response, 411, "a body needs its Content-Length, without compression"), false;
  if (request.method == "POST") {
    if (!request.get_header_value("Content-Type").starts_with("application/json"))
      return refuse(response, 415, "a body is JSON"), false;
    const std::string length = request.get_header_value("Content-Length");
    const std::size_t largest = request.path == records_path ? largest_records : largest_body;
    if (length.empty() || length.size() > 8 || length.find_first_not_of("0123456789") != std::string::npos ||
        std::stoul(length) > largest)
      return refuse(response, 413, fmt::format("a body has at most {} MiB", largest >> 20)), false;
  }
  if (request.path == "/view") return true;  // has a key of its own
  const std::string given =
      request.path == "/" ? request.get_param_value("token") : request.get_header_value("X-Ripstop-Token");
  if (!same_word(given, token))
    return refuse(response, 403, "wrong token: open the address that ripstop studio prints"), false;
  return true;
}

void StudioServer::Parts::add_pages() {
  server.Get("/", [](const Request&, Response& response) {
    const std::string nonce = random_word();
    response.set_header(
        "Content-Security-Policy",
        fmt::format("default-src 'none'; script-src 'nonce-{}'; style-src 'unsafe-inline'; "
                    "img-src data: blob:; connect-src 'self'; frame-src 'self'; base-uri 'none'; "
                    "form-action 'none'; frame-ancestors 'none'",
                    nonce));
    response.set_content(studio_page(nonce), page_type);
  });
  // A report in a frame of its own origin: its scripts run, and reach neither the page nor the token.
  server.Get("/view", [this](const Request& request, Response& response) {
    std::vector<std::string> runs;
    {
      const std::lock_guard lock(keys_mutex);
      const auto found = view_keys.find(request.get_param_value("key"));
      if (found != view_keys.end()) runs = found->second;
    }
    if (runs.empty()) return refuse(response, 403, "wrong key: open the report in Studio");
    try {
      response.set_header(
          "Content-Security-Policy",
          "sandbox allow-scripts allow-modals; default-src 'none'; script-src 'unsafe-inline'; "
          "style-src 'unsafe-inline'; img-src data: blob:; frame-ancestors 'self'");
      response.set_content(actions.report(runs), page_type);
    } catch (const Error& error) {
      refuse(response, 404, error.what());
    }
  });
}

void StudioServer::Parts::add_reading() {
  get("/api/folder", [this](const Request&) { return actions.folder(); });
  get("/api/schema", [](const Request&) { return case_schema(); });
  get("/api/drawings", [](const Request&) { return studio_drawings(); });
  get("/api/case", [this](const Request& r) { return actions.read(parameter(r, "file")); });
  get("/api/pattern", [this](const Request& r) { return actions.pattern(parameter(r, "file")); });
  get("/api/load", [this](const Request& r) {
    return actions.load(parameter(r, "file"), parameter(r, "mass"), parameter(r, "speed"),
                        r.get_param_value("drag"));
  });
  get("/api/shape", [this](const Request& r) {
    return actions.shape(parameter(r, "view"), parameter(r, "file"), r.get_param_value("pressure"),
                         whole_number(r, "nodes"));
  });
  get("/api/shape/later", [this](const Request& r) {
    return actions.later_shape(parameter(r, "view"), whole_number(r, "number"));
  });
}

void StudioServer::Parts::add_writing() {
  post("/api/case/change", [this](const Body& b) {
    if (!b.json.contains("changes")) throw Error(ExitCode::usage, "the request has no changes");
    return actions.change(b.text("file"), b.text("version"), b.json.at("changes").dump());
  });
  post("/api/case/write",
       [this](const Body& b) { return actions.write(b.text("file"), b.text("version"), b.text("text")); });
  post("/api/case/create",
       [this](const Body& b) { return actions.create(b.text("file"), b.text("family")); });
  post("/api/case/copy", [this](const Body& b) { return actions.copy(b.text("file"), b.text("from")); });
  post("/api/case/size", [this](const Body& b) {
    return actions.size(b.text("file"), b.text("family"), b.quantity("mass"), b.quantity("rate"),
                        b.quantity("speed"), b.quantity("height"));
  });
}

void StudioServer::Parts::add_runs() {
  get("/api/jobs", [this](const Request&) { return actions.jobs(); });
  get("/api/log", [this](const Request& r) { return actions.log(parameter(r, "name")); });
  get("/api/report", [this](const Request& r) {
    std::vector<std::string> runs;
    for (std::size_t i = 0; i < r.get_param_value_count("run"); ++i)
      runs.push_back(r.get_param_value("run", i));
    actions.report(runs);
    const std::string key = random_word();
    const std::lock_guard lock(keys_mutex);
    if (view_keys.size() > 1000) view_keys.clear();
    view_keys[key] = runs;
    return Json{{"address", "/view?key=" + key}}.dump();
  });
  get("/api/progress", [this](const Request& r) {
    return actions.progress(parameter(r, "name"), r.get_param_value("known"));
  });
  post(records_path, [this](const Body& b) { return actions.fit(b.json.dump()); });
  get("/api/export",
      [this](const Request& r) { return actions.exported(parameter(r, "run"), parameter(r, "format")); });
  post("/api/pattern", [this](const Body& b) { return actions.export_pattern(b.text("file")); });
  const std::string done = "{}";
  post("/api/jobs/start", [this, done](const Body& b) { return actions.start(b.json.dump()), done; });
  post("/api/jobs/stop", [this, done](const Body& b) { return actions.stop(b.text("name")), done; });
  post("/api/jobs/resume", [this, done](const Body& b) { return actions.resume(b.text("name")), done; });
}

StudioServer::StudioServer(const std::filesystem::path& folder, const std::string& program, int port)
    : parts_(std::make_unique<Parts>(folder, program)) {
  httplib::Server& server = parts_->server;
  server.set_payload_max_length(largest_records);
  server.set_tcp_nodelay(true);  // head and body are two writes
  server.set_keep_alive_max_count(1000);
  server.set_keep_alive_timeout(2);  // [s]; a stop waits for it
  // By default the library lets a second server share the port.
  server.set_socket_options([](auto socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_default_headers({{"Cache-Control", "no-store"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Cross-Origin-Opener-Policy", "same-origin"}});
  Parts* parts = parts_.get();
  server.set_pre_routing_handler([parts](const Request& request, Response& response) {
    return parts->admitted(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                              : httplib::Server::HandlerResponse::Handled;
  });
  parts->add_pages();
  parts->add_reading();
  parts->add_writing();
  parts->add_runs();
  const int bound = port == 0                                ? server.bind_to_any_port("127.0.0.1")
                    : server.bind_to_port("127.0.0.1", port) ? port
                                                             : -1;
  if (bound <= 0)
    throw Error(ExitCode::io, fmt::format("port {} cannot be used; choose another --port, or none", port));
  parts_->host = fmt::format("127.0.0.1:{}", bound);
}

StudioServer::~StudioServer() = default;

std::string StudioServer::address() const {
  return fmt::format("http://{}/?token={}", parts_->host, parts_->token);
}

void StudioServer::serve() {
  parts_->server.listen_after_bind();
}

void StudioServer::wait_until_ready() const {
  while (!parts_->server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void StudioServer::stop() {
  parts_->server.stop();
}

}  // namespace ripstop::inline studio
