#include "bench_output.h"
#include "standard_streams.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cmath>

namespace hl {

namespace {

constexpr const char* kHeader =
    "scene      motion   radius      mm triangles what                      p50       p99     p99.9       max  1x p99.9"
    "    1x max     mean   ticks capped spent  build 1     all refit bytes   all  x plain   x tick  x query  wrong\n";
constexpr const char* kCsvHeader =
    "scene,motion,radius,radius_m,who,question,hierarchy,surface,primitives,mean_edge_m,count,p50_us,p99_us,p999_us,"
    "max_us,single_p999_us,single_max_us,mean_us,capped,out_of_work,build_one_thread_ns,build_ns,refit_ns,index_bytes,"
    "all_bytes,"
    "to_plain,to_tick,to_query,compared,different,note\n";

// A number, or nothing where the row has none.
std::string text(double value, int digits, const char* none) {
  return std::isnan(value) ? std::string(none) : fmt::format("{:.{}f}", value, digits);
}

// As "tick bvh friction", "near embree".
std::string whatOf(const bench::Row& row) {
  if (row.question == "tick") return "tick " + row.hierarchy + (row.surface == "plain" ? "" : " " + row.surface);
  return row.question + " " + row.who;
}

std::string wrongOf(const bench::Row& row) {
  if (row.agreement.compared == 0) return "-";
  return fmt::format("{} of {}", row.agreement.different, row.agreement.compared);
}

}  // namespace

BenchOutput::BenchOutput(const std::string& csv, const std::string& scene) {
  if (!csv.empty()) {
    csv_.emplace(csv, std::initializer_list<std::string>{scene});
    csv_->write(kCsvHeader);
    csv_->flush();
  }
  fmt::print(kHeader);
  std::fflush(stdout);
}

bench::SuiteOutput BenchOutput::sink() {
  return {[this](const bench::Row& r) { row(r); }, [this](const bench::Growth& g) { growth(g); },
          [this](const std::string& text) { note(text); }, [this](const std::string& text) { progress(text); }};
}

void BenchOutput::row(const bench::Row& r) {
  clearProgress();
  const double p50 = r.times.median_us(), p99 = r.times.percentile_us(0.99), p999 = r.times.percentile_us(0.999);
  fmt::print("{:<10} {:<8} {:<6} {:>7.4g} {:>9} {:<20}", r.scene, r.motion, r.radius, 1e3 * r.radius_m, r.primitives,
             whatOf(r));
  const double single_p999 = r.single.percentile_us(0.999);
  fmt::print("{:>9.2f}{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}", p50, p99, p999, r.times.max_us(), single_p999,
             r.single.max_us());
  fmt::print("{:>9.2f}{:>8}{:>7}{:>6}", r.times.mean_us(), r.times.count(), r.capped, r.out_of_work);
  fmt::print("{:>9}{:>8}{:>6}{:>6}{:>6}{:>9}{:>9}{:>9}  {}{}\n", text(r.cost.build_one_thread_ns, 0, "-"),
             text(r.cost.build_ns, 0, "-"), text(r.cost.refit_ns, 0, "-"), text(r.cost.index_bytes, 0, "-"),
             text(r.cost.all_bytes, 0, "-"), text(r.to_plain, 2, "-"), text(r.to_tick, 2, "-"),
             text(r.to_query, 2, "-"), wrongOf(r), r.note.empty() ? "" : "; " + r.note);
  std::fflush(stdout);
  if (!csv_) return;
  csv_->print("{},{},{},{:.9g},{},{},{},{},{},{:.6g},", r.scene, r.motion, r.radius, r.radius_m, r.who, r.question,
              r.hierarchy, r.surface, r.primitives, r.mean_edge_m);
  csv_->print("{},{:.3f},{:.3f},{:.3f},{:.3f},", r.times.count(), p50, p99, p999, r.times.max_us());
  csv_->print("{:.3f},{:.3f},{:.3f},{},{},", single_p999, r.single.max_us(), r.times.mean_us(), r.capped,
              r.out_of_work);
  csv_->print("{},{},{},{},{},{},{},{},{},{},{}\n", text(r.cost.build_one_thread_ns, 1, ""),
              text(r.cost.build_ns, 1, ""), text(r.cost.refit_ns, 1, ""), text(r.cost.index_bytes, 1, ""),
              text(r.cost.all_bytes, 1, ""), text(r.to_plain, 4, ""), text(r.to_tick, 4, ""), text(r.to_query, 4, ""),
              r.agreement.compared, r.agreement.different, r.note);
  csv_->flush();
}

void BenchOutput::growth(const bench::Growth& g) {
  clearProgress();
  fmt::print("{}, {}, {} radius: the median tick grows as n^{:.3f} from {} to {} primitives\n", g.scene, g.motion,
             g.radius, g.slope, g.least, g.most);
  std::fflush(stdout);
}

void BenchOutput::note(const std::string& text) {
  clearProgress();
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

void BenchOutput::progress(const std::string& text) {
  if (isatty(STDERR_FILENO) == 0) return;
  clearProgress();
  tell("{}", text);
  std::fflush(stderr);
  progress_width_ = text.size();
}

void BenchOutput::clearProgress() {
  if (progress_width_ == 0) return;
  tell("\r{:{}}\r", "", progress_width_);
  std::fflush(stderr);
  progress_width_ = 0;
}

}  // namespace hl
