#include "fleet/fleet_result.h"

#include <fleet.pb.h>
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "base/error.h"
#include "base/fields.h"

namespace hl {

namespace {

static_assert(std::endian::native == std::endian::little, "rows are hashed and kept as they are in memory");

constexpr std::size_t kMaxRows = 15'000'000;  // messages are smaller than 2 GB

using RowNumbers = std::array<double, kFleetRowNumbers>;

RowNumbers numbersOf(const TraceRow& row) {
  RowNumbers numbers{};
  std::size_t at = 0;
  numbers[at++] = row.t;
  for (const Vec3* vector : {&row.finger, &row.proxy, &row.target, &row.force}) {
    for (int axis = 0; axis < 3; ++axis) numbers[at++] = (*vector)[axis];
  }
  numbers[at++] = row.contacts;
  numbers[at++] = row.iterations;
  numbers[at++] = row.injected_J;
  return numbers;
}

std::vector<double> numbersIn(FleetSummary summary) {
  std::vector<double> numbers;
  auto visit = [&](double& number) { numbers.push_back(number); };
  visitFields(summary, visit);
  return numbers;
}

}  // namespace

std::vector<FleetColumn> fleetColumns() {
  std::vector<FleetColumn> columns{{"ticks", true},       {"contact_ticks", true}, {"gap_max_m", false},
                                   {"gap_mean_m", false}, {"force_max_N", false},  {"force_mean_N", false},
                                   {"injected_J", false}, {"dissipated_J", false}};
  EndingCounts{}.each([&](Ending ending, std::uint64_t) {
    columns.push_back({std::string("ended_") + nameOf(ending), true});
  });
  return columns;
}

void FleetRecorder::add(const TraceRow& row) {
  const RowNumbers numbers = numbersOf(row);
  sha_.add(numbers.data(), sizeof numbers);
  const std::array<std::uint64_t, 2> others{row.world.hash, row.snap.value_or(0)};
  sha_.add(others.data(), sizeof others);
  if (keeps_rows_) result_.rows.insert(result_.rows.end(), numbers.begin(), numbers.end());
  FleetSummary& summary = result_.summary;
  const double gap_m = (row.proxy - row.finger).norm(), force_N = row.force.norm();
  summary.gap_max_m = std::max(summary.gap_max_m, gap_m);
  summary.force_max_N = std::max(summary.force_max_N, force_N);
  if (row.contacts == 0) return;
  summary.gap_mean_m += gap_m;  // sums, until take()
  summary.force_mean_N += force_N;
}

FleetResult FleetRecorder::take(const std::string& name, const TraceTotals& totals) {
  FleetSummary& summary = result_.summary;
  const auto contacts = static_cast<double>(totals.contacts);
  summary.ticks = static_cast<double>(totals.ticks);
  summary.contact_ticks = contacts;
  summary.gap_mean_m = contacts > 0 ? summary.gap_mean_m / contacts : 0;
  summary.force_mean_N = contacts > 0 ? summary.force_mean_N / contacts : 0;
  summary.injected_J = totals.ledger.injected_J;
  summary.dissipated_J = totals.ledger.dissipated_J;
  std::size_t at = 0;
  totals.ended.each([&](Ending, std::uint64_t count) { summary.ended.at(at++) = static_cast<double>(count); });
  result_.name = name;
  result_.rows_sha256 = hexOf(sha_.end());
  return std::move(result_);
}

std::string bytesOf(const FleetResult& result) {
  if (result.rows.size() > kMaxRows * kFleetRowNumbers)
    throw Error(
        fmt::format("has more than {} rows, too many to keep: leave rows = true out, or part the path", kMaxRows));
  proto::FleetOutcome out;
  out.set_name(result.name);
  for (const double number : numbersIn(result.summary)) out.add_summary(number);
  out.set_rows_sha256(result.rows_sha256);
  if (!result.rows.empty()) out.set_rows(result.rows.data(), result.rows.size() * sizeof(double));
  return out.SerializeAsString();
}

std::optional<FleetResult> fleetResultOf(std::string_view bytes) {
  proto::FleetOutcome in;
  FleetResult result;
  const std::size_t numbers = numbersIn(result.summary).size();
  const bool sound = in.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())) &&
                     static_cast<std::size_t>(in.summary_size()) == numbers &&
                     in.rows().size() % (kFleetRowNumbers * sizeof(double)) == 0;
  if (!sound) return {};
  result.name = in.name();
  int at = 0;
  auto visit = [&](double& number) { number = in.summary(at++); };
  visitFields(result.summary, visit);
  result.rows_sha256 = in.rows_sha256();
  result.rows.resize(in.rows().size() / sizeof(double));
  if (!result.rows.empty()) std::memcpy(result.rows.data(), in.rows().data(), in.rows().size());
  return result;
}

}  // namespace hl
