// UploadRequest: whether a request may send a file, before any of the file has come.
#pragma once

#include <boost/beast/http/status.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "http/http_answers.h"
#include "http/traffic.h"

namespace hl {

/// Why a file is not taken: one line for the user.
struct UploadRefusal {
  boost::beast::http::status status;
  UploadResult result;
  std::string text;
};

/// The length of a request's body as its head gives it.
struct BodyLength {
  std::optional<std::uint64_t> bytes;
  bool chunked = false;  ///< in pieces until the last one: the length is not given
};

bool isUpload(std::string_view target);  ///< for /upload, whatever the query

/// Of a request for /upload; `limit_bytes` 0: no files are taken. Nothing: it may send its file.
std::optional<UploadRefusal> refusalOf(const HttpRequest& head, const BodyLength& length, const HttpAnswers& answers,
                                       std::uint64_t limit_bytes);
UploadRefusal tooLarge(std::uint64_t limit_bytes);

/// The file's name as it may be shown, its ending kept: the part after the last slash, in UTF-8, without control
/// characters. It names nothing on this machine. Empty when the target has none, or one that is not so.
std::string uploadName(std::string_view target);

}  // namespace hl
