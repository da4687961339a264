#include "io/trace_csv.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <iterator>

namespace hl {

TraceWriter::TraceWriter(const std::string& file, std::initializer_list<std::string> read) : file_(file, read) {
  file_.write(
      "t,finger_x,finger_y,finger_z,proxy_x,proxy_y,proxy_z,target_x,target_y,target_z,force_x,force_y,force_z,"
      "contacts,iterations,injected_J,tick_ns\n");
}

void TraceWriter::write(const TraceRow& row) {
  fmt::memory_buffer line;
  auto out = std::back_inserter(line);
  fmt::format_to(out, "{:.17g}", row.t);
  for (const Vec3* v : {&row.finger, &row.proxy, &row.target, &row.force}) {
    fmt::format_to(out, ",{:.17g},{:.17g},{:.17g}", v->x(), v->y(), v->z());
  }
  fmt::format_to(out, ",{},{},{:.17g},{}\n", row.contacts, row.iterations, row.injected_J, row.tick_ns);
  file_.write({line.data(), line.size()});
}

}  // namespace hl
