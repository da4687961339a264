#include "http/http_answers.h"

#include <charconv>
#include <system_error>
#include <utility>

#include "base/url.h"

#include "http/connection.h"
#include "http/static_files.h"
#include "monitor/event_log.h"

namespace hl {

namespace http = boost::beast::http;

namespace {

constexpr const char* kPlain = "text/plain; charset=utf-8";

template <typename Response>
void setHead(const HttpRequest& request, const std::string& mime, Response& response) {
  response.set(http::field::server, "hl");
  response.set(http::field::content_type, mime);
  response.set(http::field::cache_control, "no-cache");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set(
      "Content-Security-Policy",
      "default-src 'self'; connect-src 'self' ws: wss:; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
      "worker-src 'self' blob:; frame-ancestors 'none'");
  response.keep_alive(request.keep_alive());
}

HttpResponse respond(const HttpRequest& request, http::status status, const std::string& mime, std::string body) {
  HttpResponse response(status, request.version());
  setHead(request, mime, response);
  response.content_length(body.size());
  if (request.method() != http::verb::head) response.body() = std::move(body);
  return response;
}

std::string_view pathOf(std::string_view target) { return target.substr(0, target.find_first_of("?#")); }

}  // namespace

HttpAnswers::HttpAnswers(const Access& access, Sources sources) : access_(access), sources_(std::move(sources)) {}

bool HttpAnswers::mayConnect(const HttpRequest& request) const {
  const std::string_view host = viewOf(request[http::field::host]);
  return access_.allowsHost(host) && access_.allowsOrigin(viewOf(request[http::field::origin]), host);
}

bool HttpAnswers::isTrusted(const HttpRequest& request) const {
  return access_.allowsCookies(viewOf(request[http::field::cookie])) ||
         access_.allowsBearer(viewOf(request[http::field::authorization]));
}

bool HttpAnswers::asksForRecording(const HttpRequest& request) const {
  return request.method() == http::verb::get && pathOf(viewOf(request.target())) == "/recording.hlr" &&
         mayConnect(request) && isTrusted(request);
}

std::uint32_t HttpAnswers::ownerOf(const HttpRequest& request) {
  const std::string text = queryValue(viewOf(request.target()), "owner");
  std::uint32_t owner = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), owner);
  return error == std::errc() && end == text.data() + text.size() ? owner : 0;
}

HttpFileResponse HttpAnswers::sendRecording(const HttpRequest& request) {
  HttpFileResponse response(http::status::ok, request.version());
  setHead(request, "application/octet-stream", response);
  response.set(http::field::content_disposition, "attachment");
  return response;
}

HttpResponse HttpAnswers::reply(const HttpRequest& request, http::status status, const std::string& mime,
                                std::string body) {
  return respond(request, status, mime, std::move(body));
}

HttpResponse HttpAnswers::refuse(const HttpRequest& request, http::status status, const std::string& text) {
  return respond(request, status, kPlain, text + "\n");
}

HttpResponse HttpAnswers::answer(const HttpRequest& request, const ServerCounts& counts) const {
  if (!mayConnect(request)) return refuse(request, http::status::forbidden, "only this server's own page may connect");
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    return refuse(request, http::status::method_not_allowed, "GET only");
  }
  return answerGet(request, counts);
}

HttpResponse HttpAnswers::answerGet(const HttpRequest& request, const ServerCounts& counts) const {
  const std::string_view target = viewOf(request.target());
  const std::string_view path = pathOf(target);
  // Health is for whoever monitors the server; it says nothing else.
  if (path == "/healthz") return health(request);
  const std::string token = queryValue(target, "token");
  if (path == "/" && !token.empty()) return login(request, token);
  if (!isTrusted(request)) {
    return refuse(request, http::status::unauthorized, kAsksForToken);
  }
  if (path == "/metrics")
    return respond(request, http::status::ok, "text/plain; version=0.0.4", sources_.metrics(counts));
  return file(request, target);
}

HttpResponse HttpAnswers::health(const HttpRequest& request) const {
  const std::string fault = sources_.fault();
  if (fault.empty()) return respond(request, http::status::ok, "application/json", "{\"status\":\"ok\"}\n");
  return respond(request, http::status::service_unavailable, "application/json",
                 "{\"status\":\"fault\",\"reason\":" + jsonString(fault) + "}\n");
}

// The token leaves the address bar at once: the page is at the same address without it.
HttpResponse HttpAnswers::login(const HttpRequest& request, std::string_view token) const {
  if (!access_.allowsToken(token)) return refuse(request, http::status::forbidden, "wrong token");
  HttpResponse response = respond(request, http::status::see_other, kPlain, "");
  response.set(http::field::location, "/");
  if (access_.wantsToken()) response.set(http::field::set_cookie, access_.cookie());
  return response;
}

HttpResponse HttpAnswers::file(const HttpRequest& request, std::string_view target) const {
  if (auto found = readStaticFile(sources_.page_folder, target)) {
    return respond(request, http::status::ok, found->mime, std::move(found->content));
  }
  if (pathOf(target) == "/") {
    return respond(request, http::status::ok, "text/html; charset=utf-8", missingPageNotice());
  }
  return refuse(request, http::status::not_found, "no such file");
}

}  // namespace hl
