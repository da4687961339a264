// HttpAnswers: what a plain HTTP request gets: a file of the page, the login that turns a token into a cookie, the
// server's health, its numbers, or a refusal.
#pragma once

#include <boost/beast/http/file_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "http/access.h"
#include "http/traffic.h"

namespace hl {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;
/// Why a request without the right token is refused, and what to do.
inline constexpr const char* kAsksForToken =
    "this server asks for its token, and this one is missing or wrong: a browser opens the page once with "
    "/?token=TOKEN, a program sends 'Authorization: Bearer TOKEN'";

using HttpFileResponse = boost::beast::http::response<boost::beast::http::file_body>;

/// Any thread; the sources are asked by the one that answers.
class HttpAnswers {
 public:
  struct Sources {
    std::string page_folder;
    std::function<std::string()> fault;                       ///< empty: healthy
    std::function<std::string(const ServerCounts&)> metrics;  ///< the whole text
  };
  /// `access` outlives this.
  HttpAnswers(const Access& access, Sources sources);

  /// Host and Origin are right. Tokens are another matter: see isTrusted().
  bool mayConnect(const HttpRequest& request) const;
  /// Has shown the token by its cookie or as a bearer, or none is asked for.
  bool isTrusted(const HttpRequest& request) const;

  HttpResponse answer(const HttpRequest& request, const ServerCounts& counts) const;
  /// Whether the finished recording of a page is asked for, by one who may have it.
  bool asksForRecording(const HttpRequest& request) const;
  /// Whose: the number in the address; 0: there is none.
  static std::uint32_t ownerOf(const HttpRequest& request);
  /// The head of that answer.
  static HttpFileResponse sendRecording(const HttpRequest& request);

  /// What a caller has decided on, with the headers that every answer has.
  static HttpResponse reply(const HttpRequest& request, boost::beast::http::status status, const std::string& mime,
                            std::string body);
  /// A refusal that a caller has decided on: `text` is one line.
  static HttpResponse refuse(const HttpRequest& request, boost::beast::http::status status, const std::string& text);

 private:
  HttpResponse answerGet(const HttpRequest& request, const ServerCounts& counts) const;
  HttpResponse health(const HttpRequest& request) const;
  HttpResponse login(const HttpRequest& request, std::string_view token) const;
  HttpResponse file(const HttpRequest& request, std::string_view target) const;

  const Access& access_;
  Sources sources_;
};

}  // namespace hl
