#include "http/upload_request.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/url.h"
#include "base/utf8.h"
#include "http/connection.h"

namespace hl {

namespace http = boost::beast::http;

namespace {

constexpr std::size_t kLongestName_bytes = 255;  // as file systems have it

}  // namespace

bool isUpload(std::string_view target) { return target.substr(0, target.find_first_of("?#")) == "/upload"; }

std::string uploadName(std::string_view target) {
  std::string name = queryBytes(target, "name");
  const std::size_t slash = name.find_last_of("/\\");
  if (slash != std::string::npos) name.erase(0, slash + 1);
  const bool control = std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; });
  if (control || name == "." || name == ".." || name.size() > kLongestName_bytes || !isUtf8(name)) return {};
  return printable(name);  // without what would turn the direction of the text that it stands in
}

UploadRefusal tooLarge(std::uint64_t limit_bytes) {
  return {http::status::payload_too_large, UploadResult::kTooLarge,
          fmt::format("the file is too large: this server takes {} MB at most", limit_bytes / 1'000'000)};
}

std::optional<UploadRefusal> refusalOf(const HttpRequest& head, const BodyLength& length, const HttpAnswers& answers,
                                       std::uint64_t limit_bytes) {
  const auto malformed = [](http::status status, const char* text) {
    return UploadRefusal{status, UploadResult::kMalformed, text};
  };
  if (!answers.mayConnect(head))
    return UploadRefusal{http::status::forbidden, UploadResult::kDenied, "only this server's own page may send files"};
  if (!answers.isTrusted(head)) return UploadRefusal{http::status::unauthorized, UploadResult::kDenied, kAsksForToken};
  if (limit_bytes == 0)
    return UploadRefusal{http::status::not_found, UploadResult::kNotTaken,
                         "this server takes no files: start it with hl touch --upload on"};
  if (head.method() != http::verb::post) return malformed(http::status::method_not_allowed, "POST only");
  if (uploadName(viewOf(head.target())).empty())
    return malformed(http::status::bad_request,
                     "the file has no name, or one that is no UTF-8, longer than 255 bytes or with control characters: "
                     "POST /upload?name=NAME");
  if (!length.chunked && length.bytes.value_or(0) == 0)
    return malformed(http::status::bad_request, "the file is empty");
  if (length.bytes.value_or(0) > limit_bytes) return tooLarge(limit_bytes);
  return {};
}

}  // namespace hl
