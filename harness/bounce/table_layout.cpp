// SPDX-License-Identifier: MIT
#include "table_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "robust_statistics.hpp"

namespace shakedown {

namespace {

constexpr double said_in_header = 0.25;  // a word in the header counts as much as a quarter of the numbers
constexpr double of_all_numbers = 0.3;   // for a layout that uses every number of the table
constexpr double most_for_unlike = 0.2;
constexpr double least_score = 0.5;

std::vector<double> numbers_of(const std::vector<double>& values) {
  std::vector<double> numbers;
  for (const double value : values)
    if (std::isfinite(value)) numbers.push_back(value);
  return numbers;
}

bool is_counting(const std::vector<double>& values) {
  const std::vector<double> x = numbers_of(values);
  int counts = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] != std::round(x[i])) return false;
    counts += i > 0 && x[i] == x[i - 1] + 1;
  }
  return x.size() > 1 && 2 * counts >= static_cast<int>(x.size() - 1);
}

std::string cell_of(const TableColumn& column, std::size_t row) {
  for (const TableColumn::TextCell& cell : column.not_numbers)
    if (cell.row == row) return cell.text;
  return std::isfinite(column.value[row]) ? fmt::format("{}", column.value[row]) : "";
}

/// Tells whether a column labels drops: the same word over some rows, then another.
bool is_label(const TableColumn& column) {
  const std::size_t rows = column.value.size();
  std::size_t changes = 0;
  std::string last;
  for (std::size_t i = 0; i < rows; ++i) {
    const std::string cell = cell_of(column, i);
    changes += i > 0 && cell != last;
    last = cell;
  }
  return rows > 3 && 2 * changes < rows;
}

/// Returns the share of neighbours that are like flights of one ball, each shorter than the one before, not
/// by much, less something for ratios that differ.
double like_flights(const std::vector<std::vector<double>>& series, TimesKind kind) {
  double good = 0, all = 0;
  std::vector<double> ratios;
  for (const std::vector<double>& one : series) {
    std::vector<double> x = numbers_of(one);
    if (kind == TimesKind::instants) {
      for (std::size_t i = 0; i + 1 < x.size(); ++i) x[i] = x[i + 1] - x[i];
      if (!x.empty()) x.pop_back();
    }
    for (std::size_t i = 1; i < x.size(); ++i) {
      const double ratio = x[i] / x[i - 1];
      all += 1;
      if (x[i] > 0 && x[i - 1] > 0 && ratio > 0.25 && ratio < 1.04) good += 1, ratios.push_back(ratio);
    }
  }
  if (all < 2 || ratios.empty()) return 0;
  const double middle = median(ratios);
  if (middle >= 0.998) return 0;  // equal steps are a clock or a counter
  // Rows and columns may both fall: of one ball the ratios are alike.
  return good / all - std::min(most_for_unlike, robust_deviation(ratios) / middle);
}

double word_for(Topic topic, TimesKind kind) {
  if (topic == Topic::other_quantity || topic == Topic::error || topic == Topic::height) return -1;
  if (topic == Topic::index) return -0.1;
  if (kind == TimesKind::intervals) return topic == Topic::interval ? said_in_header : 0;
  return topic == Topic::instant ? said_in_header : topic == Topic::interval ? -said_in_header : 0;
}

double unit_score(const std::string& unit) {
  return unit == "m" || unit == "cm" || unit == "mm" || unit == "px" || unit.find('/') != std::string::npos
             ? -1
             : 0;
}

std::string unit_of(const TableColumn& column) {
  return column.unit.empty() ? unit_in_name(column.name) : column.unit;
}

class LayoutSearch {
 public:
  LayoutSearch(const Table& table, const DropReading& reading) : table_(table), reading_(reading) {
    for (const TableColumn& column : table.columns)
      if (wanted(column) && !numbers_of(column.value).empty()) usable_.push_back(&column);
  }

  Layout best() {
    for (const TimesKind kind : {TimesKind::intervals, TimesKind::instants}) {
      if (!reading_.as.empty() && (reading_.as == "intervals") != (kind == TimesKind::intervals)) continue;
      for (const TableColumn* column : usable_) try_column(*column, kind);
      try_columns(kind);
      try_rows(kind);
    }
    return best_;
  }

 private:
  bool wanted(const TableColumn& column) const {
    if (reading_.columns.empty()) return true;
    return std::any_of(reading_.columns.begin(), reading_.columns.end(),
                       [&](const std::string& name) { return find_column(table_, name) == &column; });
  }
  bool chosen() const { return !reading_.columns.empty(); }

  double from_header(const TableColumn& column, TimesKind kind) const {
    if (chosen()) return 0;
    return word_for(topic_of(column.name), kind) + unit_score(unit_of(column));
  }

  /// Counts the numbers that could be times of this kind.
  double possible(TimesKind kind) const {
    double count = 0;
    for (const TableColumn* column : usable_)
      if (!is_counting(column->value) && !is_label(*column) && from_header(*column, kind) > -0.5)
        count += static_cast<double>(numbers_of(column->value).size());
    return count;
  }

  void take(Layout layout) {
    double used = 0;
    for (const Layout::Series& one : layout.series) used += static_cast<double>(numbers_of(one.times).size());
    layout.score += of_all_numbers * std::min(1.0, used / std::max(1.0, possible(layout.kind)));
    if (layout.score > best_.score + 1e-9) best_ = std::move(layout);
  }

  /// Tries a column of times with others that label the drops.
  void try_column(const TableColumn& column, TimesKind kind) {
    if (is_counting(column.value) && !chosen()) return;
    std::vector<const TableColumn*> labels;
    for (const TableColumn& other : table_.columns)
      if (&other != &column && topic_of(other.name) != Topic::error && is_label(other))
        labels.push_back(&other);
    Layout layout{kind, fmt::format("column '{}'", column.name), {}, unit_of(column), 0};
    std::string last = "\n";
    double counter = not_said;
    const TableColumn* counting = counter_beside(column);
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      std::string key;
      for (const TableColumn* label : labels)
        key += (key.empty() ? "" : ", ") + label->name + " " + cell_of(*label, row);
      const double count = counting ? counting->value[row] : not_said;
      if (key != last || count < counter || layout.series.empty()) {
        layout.series.push_back({key, {}});
        for (const TableColumn* label : labels)
          if (topic_of(label->name) == Topic::height) {
            layout.series.back().height = label->value[row];
            layout.series.back().height_unit = unit_of(*label);
          }
      }
      last = key, counter = count;
      layout.series.back().times.push_back(column.value[row]);
    }
    layout.score = score(layout) + from_header(column, kind);
    take(std::move(layout));
  }

  const TableColumn* counter_beside(const TableColumn& column) const {
    for (const TableColumn& other : table_.columns)
      if (&other != &column && !is_label(other) && is_counting(other.value)) return &other;
    return nullptr;
  }

  double score(const Layout& layout) const {
    std::vector<std::vector<double>> all;
    for (const Layout::Series& one : layout.series) all.push_back(one.times);
    return like_flights(all, layout.kind);
  }

  /// Tries columns side by side, a drop each.
  void try_columns(TimesKind kind) {
    Layout layout{kind, "", {}, "", 0};
    double words = 0;
    for (const TableColumn* column : usable_) {
      if (is_counting(column->value) && !chosen()) continue;
      if (!chosen() &&
          (from_header(*column, kind) <= -0.5 || like_flights({column->value}, kind) < least_score))
        continue;
      layout.series.push_back({column->name, column->value});
      if (layout.unit.empty()) layout.unit = unit_of(*column);
      words += from_header(*column, kind);
    }
    if (layout.series.size() < 2) return;
    layout.how = fmt::format("{} columns side by side", layout.series.size());
    // A table of drops is likelier than one drop beside columns of no use.
    layout.score = score(layout) + words / static_cast<double>(layout.series.size()) + 0.02;
    take(std::move(layout));
  }

  using Columns = std::span<const TableColumn* const>;

  /// Tries a row a drop, with columns before that label it.
  void try_rows(TimesKind kind) {
    std::vector<const TableColumn*> possible;
    for (const TableColumn* column : usable_)
      if (chosen() || (!is_counting(column->value) && from_header(*column, kind) > -0.5))
        possible.push_back(column);
    // Labels stand before the times: leading columns whose steps to the next fit no drop.
    Columns times(possible);
    while (times.size() >= 3 && row_score(times, kind) < 0.9 &&
           row_score(times.subspan(1), kind) > row_score(times, kind))
      times = times.subspan(1);
    if (times.size() < 3) return;
    Layout layout{kind, fmt::format("a row a drop, {} columns", times.size()), {}, unit_of(*times[0]), 0};
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      Layout::Series one{label_of_row(row, times), {}};
      for (const TableColumn* column : times) one.times.push_back(column->value[row]);
      for (const TableColumn& column : table_.columns)
        if (&column != times[0] && topic_of(column.name) == Topic::height &&
            std::find(times.begin(), times.end(), &column) == times.end())
          one.height = column.value[row], one.height_unit = unit_of(column);
      layout.series.push_back(std::move(one));
    }
    layout.score = score(layout) + from_header(*times[0], kind);
    take(std::move(layout));
  }

  double row_score(Columns columns, TimesKind kind) const {
    std::vector<std::vector<double>> rows(table_.rows());
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (const TableColumn* column : columns) rows[row].push_back(column->value[row]);
    return like_flights(rows, kind);
  }

  std::string label_of_row(std::size_t row, Columns times) const {
    std::string label;
    for (const TableColumn& column : table_.columns) {
      if (&column == times[0]) break;
      label += (label.empty() ? "" : ", ") + column.name + " " + cell_of(column, row);
    }
    return label.empty() ? fmt::format("row {}", row + 1) : label;
  }

  const Table& table_;
  const DropReading& reading_;
  std::vector<const TableColumn*> usable_;
  Layout best_;
};

}  // namespace

Layout layout_of(const Table& table, const DropReading& reading) {
  for (const std::string& name : reading.columns)
    if (!find_column(table, name)) {
      std::string names;
      for (const std::string& one : column_names(table)) names += (names.empty() ? "" : ", ") + one;
      throw InputError({{{table.file, 1, 1},
                         "--column",
                         "there is no column '" + name + "'",
                         "the columns are: " + names}});
    }
  Layout best = LayoutSearch(table, reading).best();
  if (best.score >= least_score || (!reading.as.empty() && !reading.columns.empty() && !best.series.empty()))
    return best;
  throw InputError({{{table.file, 1, 1},
                     "",
                     "holds no times of a bouncing ball (no column or row in which flights grow shorter)",
                     "say where they are: --column NAME --as intervals, --as instants or --as track"}});
}

namespace {

/// Tells whether values turn from falling to rising as a bouncing ball's do, and are smooth but for that;
/// looks at means of some frames where there are many.
bool bounces(const std::vector<double>& frames) {
  constexpr std::size_t points = 250;
  const std::size_t block = std::max<std::size_t>(1, frames.size() / points);
  std::vector<double> y;
  for (std::size_t i = 0; i + block <= frames.size(); i += block) {
    double sum = 0;
    for (std::size_t j = i; j < i + block; ++j) sum += frames[j];
    y.push_back(sum / static_cast<double>(block));
  }
  int turns = 0, steps = 0;
  for (std::size_t i = 2; i < y.size(); ++i, ++steps) turns += (y[i] < y[i - 1]) != (y[i - 1] < y[i - 2]);
  return turns >= 4 && turns * 4 < steps;
}

bool is_clock(const std::vector<double>& t) {
  if (t.size() < 15 || std::adjacent_find(t.begin(), t.end(), std::greater_equal<>()) != t.end())
    return false;
  std::vector<double> step;
  for (std::size_t i = 1; i < t.size(); ++i) step.push_back(t[i] - t[i - 1]);
  const double usual = median(step);
  int equal = 0;
  for (const double one : step) equal += std::abs(one / usual - 1) < 0.25;
  return usual > 0 && 10 * equal >= 8 * static_cast<int>(step.size());
}

}  // namespace

TrackColumns track_columns(const Table& table, const DropReading& reading) {
  TrackColumns found;
  if (reading.columns.size() == 2)
    return {find_column(table, reading.columns[0]), find_column(table, reading.columns[1])};
  for (const TableColumn& column : table.columns) {
    if (!is_clock(numbers_of(column.value))) continue;
    const bool better = !found.time || (is_counting(found.time->value) && !is_counting(column.value));
    if (better) found.time = &column;
  }
  double widest = 0;
  for (const TableColumn& column : table.columns) {
    if (&column == found.time || topic_of(column.name) == Topic::other_quantity) continue;
    const std::vector<double> y = numbers_of(column.value);
    if (!bounces(y)) continue;
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    const double width = (*high - *low) * (topic_of(column.name) == Topic::height ? 10 : 1);
    if (width > widest) widest = width, found.height = &column;
  }
  return found.time && found.height ? found : TrackColumns{};
}

}  // namespace shakedown
