// SPDX-License-Identifier: MIT
#include "crosscheck_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "provenance.hpp"
#include "text.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json statistic_json(const Statistic& statistic, double per_si) {
  return {
      {"mean", number(per_si * statistic.mean)}, {"sd", number(per_si * statistic.sd)}, {"n", statistic.n}};
}

double standard_error(const Statistic& statistic) { return statistic.sd / std::sqrt(statistic.n); }

Json engine_json(const EngineResult& result) {
  Json json{{"engine", result.engine}, {"runs", result.runs}, {"peaks_mm", Json::array()}};
  for (const Statistic& peak : result.peaks) json["peaks_mm"].push_back(statistic_json(peak, 1e3));
  for (std::size_t i = 0; i < result.numbers.size(); ++i) {
    const CrosscheckNumber& kind = crosscheck_numbers()[i];
    json[kind.key] = statistic_json(result.numbers[i], kind.per_si);
  }
  return json;
}

Json comparison_json(const Comparison& comparison) {
  const Equivalence& found = comparison.found;
  const double per_si = comparison.number->per_si;
  return {{"first", comparison.first},
          {"second", comparison.second},
          {"number", comparison.number->key},
          {"difference", number(per_si * found.difference)},
          {"standard_error", number(per_si * found.standard_error)},
          {"interval_95", {number(per_si * found.low), number(per_si * found.high)}},
          {"margin", number(per_si * found.margin)},
          {"verdict", to_string(found.verdict)},
          {"in_words", in_words(found)}};
}

Json limit_json(const ContactTimeLimit& limit) {
  Json json{{"contact_times_ms", Json::array()}, {"results", Json::array()}, {"values", Json::array()}};
  for (const double time : limit.contact_times) json["contact_times_ms"].push_back(1e3 * time);
  for (const EngineResult& result : limit.results) json["results"].push_back(engine_json(result));
  for (const ContactTimeLimit::Value& value : limit.values) {
    const double per_si = value.number->per_si;
    json["values"].push_back({{"number", value.number->key},
                              {"at_zero", number(per_si * value.at_zero)},
                              {"standard_error", number(per_si * value.error)},
                              {"chi_squared", number(value.chi_squared)},
                              {"hard", statistic_json(value.hard, per_si)},
                              {"deviation_in_standard_errors", number(value.deviation())}});
  }
  return json;
}

std::string cell(const Statistic& statistic, double per_si) {
  if (statistic.n == 0) return "-";
  const double mean = per_si * statistic.mean, sd = per_si * statistic.sd;
  if (std::abs(mean) >= 1000) return fmt::format("{:.0f} +- {:.0f}", mean, sd);
  return fmt::format("{:.4g} +- {:.2g}", mean, sd);
}

std::string label(const CrosscheckNumber& kind) {
  return *kind.unit == '\0' ? kind.label : fmt::format("{}, {}", kind.label, kind.unit);
}

std::string table(const Crosscheck& crosscheck) {
  std::string text =
      fmt::format("{}: {} runs of {:g} s, mean +- spread of one run\n{:<36}", crosscheck.name,
                  crosscheck.engines.empty() ? 0 : crosscheck.engines[0].runs, crosscheck.duration, "");
  for (const EngineResult& result : crosscheck.engines) text += fmt::format("{:>22}", result.engine);
  text += '\n';
  const auto row = [&](const std::string& name, auto cell_of) {
    text += fmt::format("  {:<34}", name);
    for (const EngineResult& result : crosscheck.engines) text += fmt::format("{:>22}", cell_of(result));
    text += '\n';
  };
  for (std::size_t i = 0; i < crosscheck_numbers().size(); ++i)
    row(label(crosscheck_numbers()[i]),
        [&](const EngineResult& result) { return cell(result.numbers[i], crosscheck_numbers()[i].per_si); });
  for (std::size_t i = 0; i < 8; ++i)
    row(fmt::format("peak {}, mm", i + 1), [&](const EngineResult& result) {
      return i < result.peaks.size() ? cell(result.peaks[i], 1e3) : "-";
    });
  return text;
}

std::string verdicts(const Crosscheck& crosscheck) {
  if (crosscheck.comparisons.empty()) return "";
  std::string text = "  differences with their 95 % intervals, against the margin\n";
  for (const Comparison& comparison : crosscheck.comparisons) {
    const Equivalence& found = comparison.found;
    const double per_si = comparison.number->per_si;
    text +=
        fmt::format("  {:<28}{:<16}{:>9.4f} [{:>8.4f}, {:>8.4f}] +-{:<7.4g} {}\n", label(*comparison.number),
                    fmt::format("{} - {}", comparison.first, comparison.second), per_si * found.difference,
                    per_si * found.low, per_si * found.high, per_si * found.margin, in_words(found));
  }
  return text;
}

std::string limit_table(const ContactTimeLimit& limit) {
  std::string text = fmt::format("  soft engine by contact time, mean +- its error\n  {:<28}", "");
  for (const double time : limit.contact_times)
    text += fmt::format("{:>19}", fmt::format("{:g} ms", 1e3 * time));
  text += fmt::format("{:>19}{:>19}\n", "to 0", "hard");
  const auto value = [](double mean, double error) {
    return fmt::format("{:>19}", std::isnan(mean) ? "-" : fmt::format("{:.4f} +- {:.4f}", mean, error));
  };
  for (const ContactTimeLimit::Value& row : limit.values) {
    const auto index = static_cast<std::size_t>(row.number - crosscheck_numbers().data());
    const double per_si = row.number->per_si;
    text += fmt::format("  {:<28}", label(*row.number));
    for (const EngineResult& result : limit.results)
      text += value(per_si * result.numbers[index].mean, per_si * standard_error(result.numbers[index]));
    text += value(per_si * row.at_zero, per_si * row.error) +
            value(per_si * row.hard.mean, per_si * standard_error(row.hard)) +
            fmt::format("  apart by {:.1f} standard errors; line: chi^2 {:.1f} for {}\n",
                        std::abs(row.deviation()), row.chi_squared, limit.contact_times.size() - 2);
  }
  return text;
}

std::string csv_number(double value) { return std::isnan(value) ? "" : fmt::format("{:.10g}", value); }

}  // namespace

std::string readable_crosscheck(const Crosscheck& crosscheck) {
  return table(crosscheck) + verdicts(crosscheck) + (crosscheck.limit ? limit_table(*crosscheck.limit) : "");
}

std::string crosscheck_json(const std::vector<Crosscheck>& crosschecks) {
  const Provenance program = provenance_of_this_program();
  Json json{{"schema_version", 1},
            {"program", {{"name", "shakedown"}, {"version", program.version}, {"commit", program.commit}}},
            {"crosschecks", Json::array()}};
  for (const Crosscheck& crosscheck : crosschecks) {
    Json one{{"setup", crosscheck.name},
             {"duration_s", crosscheck.duration},
             {"engines", Json::array()},
             {"comparisons", Json::array()},
             {"limit", crosscheck.limit ? limit_json(*crosscheck.limit) : Json(nullptr)}};
    for (const EngineResult& result : crosscheck.engines) one["engines"].push_back(engine_json(result));
    for (const Comparison& comparison : crosscheck.comparisons)
      one["comparisons"].push_back(comparison_json(comparison));
    json["crosschecks"].push_back(std::move(one));
  }
  return json.dump(2) + "\n";
}

std::string crosscheck_numbers_csv(const std::vector<Crosscheck>& crosschecks) {
  std::string text = "setup,engine,number,mean,sd,n\n";
  for (const Crosscheck& crosscheck : crosschecks)
    for (const EngineResult& result : crosscheck.engines) {
      const auto line = [&](const std::string& name, const Statistic& statistic, double per_si) {
        text +=
            fmt::format("{},{},{},{},{},{}\n", csv_cell(crosscheck.name), result.engine, name,
                        csv_number(per_si * statistic.mean), csv_number(per_si * statistic.sd), statistic.n);
      };
      for (std::size_t i = 0; i < result.numbers.size(); ++i)
        line(crosscheck_numbers()[i].key, result.numbers[i], crosscheck_numbers()[i].per_si);
      for (std::size_t i = 0; i < result.peaks.size(); ++i)
        line(fmt::format("peak_{}_mm", i + 1), result.peaks[i], 1e3);
    }
  return text;
}

std::string crosscheck_verdicts_csv(const std::vector<Crosscheck>& crosschecks) {
  std::string text = "setup,first,second,number,difference,standard_error,low,high,margin,verdict\n";
  for (const Crosscheck& crosscheck : crosschecks)
    for (const Comparison& comparison : crosscheck.comparisons) {
      const Equivalence& found = comparison.found;
      const double per_si = comparison.number->per_si;
      text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_cell(crosscheck.name), comparison.first,
                          comparison.second, comparison.number->key, csv_number(per_si * found.difference),
                          csv_number(per_si * found.standard_error), csv_number(per_si * found.low),
                          csv_number(per_si * found.high), csv_number(per_si * found.margin),
                          to_string(found.verdict));
    }
  return text;
}

std::string crosscheck_limit_csv(const std::vector<Crosscheck>& crosschecks) {
  std::string text = "setup,number,contact_time_ms,mean,standard_error\n";
  for (const Crosscheck& crosscheck : crosschecks) {
    if (!crosscheck.limit) continue;
    const ContactTimeLimit& limit = *crosscheck.limit;
    for (const ContactTimeLimit::Value& value : limit.values) {
      const double per_si = value.number->per_si;
      const auto line = [&](const std::string& time, double mean, double error) {
        text += fmt::format("{},{},{},{},{}\n", csv_cell(crosscheck.name), value.number->key, time,
                            csv_number(per_si * mean), csv_number(per_si * error));
      };
      const auto index = static_cast<std::size_t>(value.number - crosscheck_numbers().data());
      for (std::size_t i = 0; i < limit.results.size(); ++i) {
        const Statistic& statistic = limit.results[i].numbers[index];
        line(csv_number(1e3 * limit.contact_times[i]), statistic.mean, standard_error(statistic));
      }
      line("0", value.at_zero, value.error);
      line("", value.hard.mean, standard_error(value.hard));
    }
  }
  return text;
}

}  // namespace shakedown
