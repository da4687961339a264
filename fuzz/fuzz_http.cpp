// HTTP requests, from bytes to the answer. The first byte chooses what the server asks for: a token, TLS, loopback.
#include <boost/asio/buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "http/http_answers.h"
#include "http/upload_request.h"
#include "refusal.h"

namespace {

namespace http = boost::beast::http;
using namespace hl;

constexpr const char* kToken = "a-token-of-the-fuzzer";
constexpr const char* kOfThePage = "<p>the page</p>";

// A folder of a page, with a file beside it that nobody may ask for.
const std::string& pageFolder() {
  static const std::string folder = [] {
    fuzz::fileOf("secret.txt", reinterpret_cast<const std::uint8_t*>(kToken), 8);
    const std::string beside = test::fileWith("page_index.html", kOfThePage);
    const std::filesystem::path page = std::filesystem::path(beside).parent_path() / "page";
    std::filesystem::create_directories(page);
    std::filesystem::rename(beside, page / "index.html");
    return page.string();
  }();
  return folder;
}

bool parsed(const std::uint8_t* data, std::size_t size, HttpRequest& request) {
  http::request_parser<http::string_body> parser;
  parser.header_limit(16384);
  parser.body_limit(16384);
  parser.eager(true);
  boost::beast::error_code error;
  parser.put(boost::asio::buffer(data, size), error);
  if (error || !parser.is_done()) return false;
  request = parser.release();
  return true;
}

// Who gets what. Nobody gets a file from outside of the page's folder, and without the token nobody gets any.
void answer(const HttpAnswers& answers, const HttpRequest& request) {
  const HttpResponse response = answers.answer(request, ServerCounts{Traffic{}, 0, 0, 0});
  fuzz::require(response.count(http::field::set_cookie) <= 1);
  const bool has_file = response.body().find(kOfThePage) != std::string::npos;
  if (has_file) fuzz::require(answers.mayConnect(request) && answers.isTrusted(request));
  fuzz::require(response.body().find("a-token-") == std::string::npos);
  if (boost::beast::websocket::is_upgrade(request)) answers.mayConnect(request);
}

// Who may send a file, and what its name may be.
void upload(const HttpAnswers& answers, const HttpRequest& request) {
  const std::string_view target{request.target().data(), request.target().size()};
  const std::string name = uploadName(target);
  fuzz::require(name.size() <= 255 && name.find('/') == std::string::npos && name != "..");
  for (const char c : name) fuzz::require(static_cast<unsigned char>(c) >= ' ');
  constexpr std::uint64_t kLimit_bytes = 1000;
  const auto refusal = refusalOf(request, {request.body().size(), false}, answers, kLimit_bytes);
  if (refusal) return fuzz::require(refusal->text.find('\n') == std::string::npos);
  fuzz::require(answers.mayConnect(request) && answers.isTrusted(request) && !name.empty());
  fuzz::require(!request.body().empty() && request.body().size() <= kLimit_bytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const bool loopback = data[0] & 1, tls = data[0] & 2, asks = data[0] & 4;
  const Access access({loopback, tls, 1997, asks ? kToken : ""});
  const HttpAnswers answers(access, {pageFolder(), [] { return std::string(); },
                                     [](const ServerCounts&) { return std::string("hl_up 1\n"); }});
  HttpRequest request;
  if (!parsed(data + 1, size - 1, request)) return 0;
  answer(answers, request);
  upload(answers, request);
  return 0;
}
