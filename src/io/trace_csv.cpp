#include "io/trace_csv.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <iterator>

#include "base/error.h"

namespace hl {

TraceWriter::TraceWriter(const std::string& file) : name_(file), file_(std::fopen(file.c_str(), "wb")) {
  if (file_ == nullptr) throw Error(name_ + ": cannot be written: " + std::strerror(errno));
  fmt::print(file_,
             "t,finger_x,finger_y,finger_z,proxy_x,proxy_y,proxy_z,target_x,target_y,target_z,force_x,force_y,force_z,"
             "contacts,iterations,injected_J,tick_ns\n");
}

TraceWriter::~TraceWriter() {
  if (file_ != nullptr) std::fclose(file_);
}

void TraceWriter::write(const TraceRow& row) {
  fmt::memory_buffer line;
  auto out = std::back_inserter(line);
  fmt::format_to(out, "{:.17g}", row.t);
  for (const Vec3* v : {&row.finger, &row.proxy, &row.target, &row.force}) {
    fmt::format_to(out, ",{:.17g},{:.17g},{:.17g}", v->x(), v->y(), v->z());
  }
  fmt::format_to(out, ",{},{},{:.17g},{}\n", row.contacts, row.iterations, row.injected_J, row.tick_ns);
  if (std::fwrite(line.data(), 1, line.size(), file_) != line.size()) {
    throw Error(name_ + ": cannot be written: " + std::strerror(errno));
  }
}

void TraceWriter::close() {
  std::FILE* file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) throw Error(name_ + ": cannot be written: " + std::strerror(errno));
}

}  // namespace hl
