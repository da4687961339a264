#include "surfaces/matter.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"

namespace hl {

namespace {

constexpr double kMax = 1e9;  // as of a surface's quantities (base/quantities.def)

void checkNumber(const char* name, double number, double most) {
  if (!(number >= 0 && number <= most))
    throw Error("matter: " + std::string(name) + " must be from 0 to " + (most == 1 ? "1" : "1e9"));
}

void checkRow(const MatterRow& row) {
  if (!std::isfinite(row.value)) throw Error("matter: each row needs a value, which is a finite number");
  if (row.stiffness) checkNumber("stiffness", *row.stiffness, 1);
  if (row.strength_N) checkNumber("strength", *row.strength_N, kMax);
  checkNumber("resistance", row.force.resistance_N, kMax);
  checkNumber("drag", row.force.drag_Ns_m, kMax);
}

std::optional<double> between(const std::optional<double>& low, const std::optional<double>& high, double part) {
  return low && high ? std::optional(std::lerp(*low, *high, part)) : std::nullopt;
}

// In all rows or in none.
void checkEverywhere(const std::vector<MatterRow>& rows, std::optional<double> MatterRow::*number, const char* name) {
  const auto has = [&](const MatterRow& row) { return (row.*number).has_value(); };
  if (std::any_of(rows.begin(), rows.end(), has) && !std::all_of(rows.begin(), rows.end(), has))
    throw Error("matter: give a " + std::string(name) + " in each row or in none");
}

}  // namespace

MatterTable::MatterTable(std::vector<MatterRow> rows) : rows_(std::move(rows)) {
  if (rows_.size() > kMaxRows) throw Error("matter: there are more than " + std::to_string(kMaxRows) + " rows");
  for (const MatterRow& row : rows_) checkRow(row);
  checkEverywhere(rows_, &MatterRow::stiffness, "stiffness");
  checkEverywhere(rows_, &MatterRow::strength_N, "strength");
  const auto falls = [](const MatterRow& a, const MatterRow& b) { return !(a.value < b.value); };
  if (std::adjacent_find(rows_.begin(), rows_.end(), falls) != rows_.end())
    throw Error("matter: the values of its rows must rise from row to row");
}

bool MatterTable::resists() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const MatterRow& row) { return row.force.acts(); });
}

MatterRow MatterTable::at(double value) const {
  if (rows_.empty() || std::isnan(value)) return {.value = value};
  const auto above = [](double number, const MatterRow& row) { return number < row.value; };
  const auto high = std::upper_bound(rows_.begin(), rows_.end(), value, above);
  if (high == rows_.begin()) return rows_.front();
  if (high == rows_.end()) return rows_.back();
  const auto low = high - 1;
  const double part = (value - low->value) / (high->value - low->value);
  const bool never = low->strength_N == 0.0 || high->strength_N == 0.0;
  return {value,
          between(low->stiffness, high->stiffness, part),
          never ? (part < 0.5 ? low : high)->strength_N : between(low->strength_N, high->strength_N, part),
          {std::lerp(low->force.resistance_N, high->force.resistance_N, part),
           std::lerp(low->force.drag_Ns_m, high->force.drag_Ns_m, part)}};
}

}  // namespace hl
