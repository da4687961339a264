// The table: one element a task in each column, in the order of the plan. Names of columns are in docs/sweeps.md.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/error.h"
#include "base/fields.h"
#include "fleet/beside.h"
#include "fleet/fleet_report.h"
#include "io/npz_file.h"

namespace hl {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Numbers of a row that belong together.
struct RowColumn {
  const char* name;
  std::size_t first, count;
};
constexpr std::array<RowColumn, 8> kRowColumns{{{"t", 0, 1},
                                                {"finger", 1, 3},
                                                {"proxy", 4, 3},
                                                {"target", 7, 3},
                                                {"force", 10, 3},
                                                {"contacts", 13, 1},
                                                {"iterations", 14, 1},
                                                {"row_injected_J", 15, 1}}};

class TableWriter {
 public:
  TableWriter(const FleetPlan& plan, const FleetStore& store, const std::string& path)
      : plan_(plan), store_(store), file_(path) {}

  void write() {
    writeInputs();
    writeOptions();
    writeSummaries();
    if (plan_.rows) writeRows();
    file_.close();
  }

 private:
  template <typename Value, typename Make>
  void addForEach(const std::string& name, Make make) {
    std::vector<Value> values;
    for (const FleetTask& task : plan_.tasks) values.push_back(make(task));
    file_.add(name, values);
  }
  void writeInputs() {
    addForEach<std::string>("task", [](const FleetTask& task) { return task.name; });
    addForEach<std::string>("scene", [&](const FleetTask& task) { return plan_.scenes[task.scene].name; });
    addForEach<std::string>("path", [&](const FleetTask& task) { return plan_.paths[task.path].name; });
    addForEach<std::int64_t>("seed", [](const FleetTask& task) { return task.seed; });
  }
  // A column is of numbers if all its values are: NaN then stands where the option is not given.
  void writeOptions() {
    std::map<std::string, std::vector<const std::string*>> columns;
    for (std::size_t i = 0; i < plan_.options.size(); ++i) {
      for (const SweepOption& option : plan_.options[i]) {
        auto& column = columns[option.name];
        column.resize(plan_.options.size());
        column[i] = &option.value;
      }
    }
    for (const auto& [name, values] : columns) {
      std::vector<double> numbers;
      bool all = true;
      for (const std::string* value : values) all = numberOf(value, numbers.emplace_back(kNone)) && all;
      std::string column = name;
      std::replace(column.begin(), column.end(), '-', '_');
      if (all) {
        addForEach<double>(column, [&](const FleetTask& task) { return numbers[task.options]; });
      } else {
        addForEach<std::string>(column, [&, &texts = values](const FleetTask& task) {
          return texts[task.options] == nullptr ? std::string() : *texts[task.options];
        });
      }
    }
  }
  static bool numberOf(const std::string* text, double& number) {
    if (text == nullptr) return true;
    const char* const end = text->data() + text->size();
    const auto [at, error] = std::from_chars(text->data(), end, number);
    return error == std::errc() && at == end;
  }
  void writeSummaries() {
    std::vector<std::vector<double>> numbers(fleetColumns().size());
    std::vector<std::string> failures;
    for (const FleetTask& task : plan_.tasks) {
      std::optional<StoredResult> stored = store_.find(task.name);
      failures.push_back(stored ? "" : store_.failureOf(task.name).value_or("was not run"));
      ticks_.push_back(stored ? static_cast<std::size_t>(stored->result.summary.ticks) : 0);
      std::size_t at = 0;
      FleetSummary summary = stored ? stored->result.summary : FleetSummary{};
      auto visit = [&](double number) { numbers[at++].push_back(stored ? number : kNone); };
      visitFields(summary, visit);
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) addSummary(fleetColumns()[i], numbers[i]);
    file_.add("failure", failures);
  }
  // Counts are whole; of a task that failed 0.
  void addSummary(const FleetColumn& column, const std::vector<double>& numbers) {
    if (!column.count) return file_.add(column.name, numbers);
    std::vector<std::int64_t> counts;
    counts.reserve(numbers.size());
    for (const double number : numbers) counts.push_back(std::isnan(number) ? 0 : static_cast<std::int64_t>(number));
    file_.add(column.name, counts);
  }
  // The rows of all tasks one after the other; those of task i are row_begin[i] to row_begin[i + 1]. Read once for each
  // column, as all of them may be more than the memory holds.
  void writeRows() {
    std::vector<std::int64_t> begins{0};
    for (const std::size_t ticks : ticks_) begins.push_back(begins.back() + static_cast<std::int64_t>(ticks));
    file_.add("row_begin", begins);
    const auto rows = static_cast<std::size_t>(begins.back());
    for (const RowColumn& column : kRowColumns) {
      std::vector<std::size_t> shape{rows};
      if (column.count > 1) shape.push_back(column.count);
      file_.begin(column.name, "<f8", shape);
      for (std::size_t i = 0; i < plan_.tasks.size(); ++i) {
        if (ticks_[i] > 0) writeColumn(column, i);
      }
    }
  }
  void writeColumn(const RowColumn& column, std::size_t task) {
    const std::optional<StoredResult> stored = store_.find(plan_.tasks[task].name);
    if (!stored || stored->result.rows.size() != ticks_[task] * kFleetRowNumbers)
      throw Error("a result was removed meanwhile: run the sweep again");
    std::vector<double> numbers;
    for (std::size_t at = column.first; at < stored->result.rows.size(); at += kFleetRowNumbers)
      numbers.insert(numbers.end(), &stored->result.rows[at], &stored->result.rows[at] + column.count);
    file_.write(numbers.data(), numbers.size() * sizeof(double));
  }

  const FleetPlan& plan_;
  const FleetStore& store_;
  NpzFile file_;
  std::vector<std::size_t> ticks_;  // of each task
};

}  // namespace

FleetProgress progressOf(const FleetPlan& plan, const FleetStore& store) {
  FleetProgress progress;
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const std::string& name = plan.tasks[i].name;
    if (store.find(name)) {
      ++progress.done;
    } else if (std::optional<std::string> why = store.failureOf(name)) {
      ++progress.failed;
      progress.failures.emplace_back(i, std::move(*why));
    } else {
      ++progress.left;
    }
  }
  return progress;
}

void writeFleetTable(const FleetPlan& plan, const FleetStore& store, const std::string& folder) {
  const std::string path = folder + "/result.npz", beside = nameBeside(path);
  removeBeside(path);
  TableWriter(plan, store, beside).write();
  putInPlace(beside, path);
}

}  // namespace hl
