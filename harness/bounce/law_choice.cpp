// SPDX-License-Identifier: MIT
#include "law_choice.hpp"

#include <algorithm>
#include <cmath>

#include "errors.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

constexpr double odds_of_free_air = 0.5;  // size and mass were not said
constexpr int most_rounds = 6;
constexpr double called_odd = 0.01;  // impacts of a recording that chance calls odd
constexpr double suspected = 0.3;    // and that are looked at more closely
constexpr std::size_t most_suspects = 12;
constexpr std::size_t least_rows = 8;           // impacts without which nothing is called odd
constexpr std::size_t most_outliers_share = 4;  // of the impacts one in so many at most

double two_digits(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::round(value / unit) * unit;
}

struct Speeds {
  double slowest = 1e300, fastest = 0, middle = 1;
};

Speeds speeds_of(const std::vector<Flights>& all, const BounceModel& model) {
  Eigen::VectorXd value(static_cast<Eigen::Index>(model.parameters().size()));
  for (Eigen::Index k = 0; k < value.size(); ++k)
    value[k] = model.parameters()[static_cast<std::size_t>(k)].start;
  const Linearised at = linearised(all, model, value);
  Speeds speeds;
  double logs = 0;
  for (const ImpactRow& row : at.rows) {
    speeds.slowest = std::min(speeds.slowest, row.speed);
    speeds.fastest = std::max(speeds.fastest, row.speed);
    logs += std::log(row.speed);
  }
  speeds.middle = std::exp(logs / static_cast<double>(at.rows.size()));
  return speeds;
}

/// Returns values to start from: the median restitution, and what is believed of the rest.
Eigen::VectorXd start_of(const std::vector<Flights>& flights, const BounceModel& model,
                         const std::vector<LawParameter>& parameters) {
  Eigen::VectorXd value(std::ssize(parameters));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    value[static_cast<Eigen::Index>(k)] = parameters[k].start;
  // A power law is cut off at its most: impacts there say nothing of its restitution at the reference speed.
  const double exponent = model.law == LawKind::plastic ? 0.25 : model.law == LawKind::power ? value[1] : 0;
  std::vector<double> all, below_most;
  for (const ImpactRow& row : linearised(flights, model, value).rows) {
    const double at_reference = row.restitution * std::pow(row.speed / model.reference, exponent);
    all.push_back(at_reference);
    if (row.restitution < 0.97) below_most.push_back(at_reference);
  }
  value[0] = std::clamp(median(below_most.empty() ? all : below_most), 0.01, 0.9999);
  return value;
}

double mean_square(const Eigen::VectorXd& residual) {
  return std::max(1e-18, residual.squaredNorm() / static_cast<double>(residual.size()));
}

/// Sets the probabilities of the laws, which sum to one, and puts the most probable first.
void weigh(std::vector<LawFit>& laws, const std::vector<double>& priors) {
  double top = -1e300, sum = 0;
  for (std::size_t i = 0; i < laws.size(); ++i)
    top = std::max(top, laws[i].posterior.log_evidence + std::log(priors[i]));
  for (std::size_t i = 0; i < laws.size(); ++i) {
    LawFit& law = laws[i];
    law.probability = priors[i] * std::exp(law.posterior.log_evidence - top);
    law.probability_still = priors[i] * std::exp(law.posterior.log_evidence_still - top);
    sum += law.probability;
  }
  for (LawFit& law : laws) law.probability /= sum, law.probability_still /= sum;
  std::stable_sort(laws.begin(), laws.end(),
                   [](const LawFit& a, const LawFit& b) { return a.probability > b.probability; });
}

/// Returns the impact that stands out most, measured by the spreads of the others without any that is
/// suspected (they would widen what they are measured by); empty: none does.
std::vector<Outlier> oddest(const std::vector<Drop>& drops, const BounceModel& model,
                            const TimingKnown& timing, const BounceAnswer& answer) {
  const LawFit fit = fit_law(answer.flights, model, timing);
  std::vector<Outlier> suspects = odd_ones(fit, suspected);
  suspects.resize(std::min({suspects.size(), most_suspects, fit.at.rows.size() / most_outliers_share}));
  if (suspects.empty()) return {};
  std::vector<Outlier> cut = answer.outliers;
  cut.insert(cut.end(), suspects.begin(), suspects.end());
  const LawFit without = fit_law(usable_flights(drops, cut), model, timing);
  std::vector<Outlier> worst;
  double least = called_odd;
  for (const Outlier& suspect : suspects)
    if (const double chance = chance_of(suspect, fit, without); chance < least)
      least = chance, worst = {suspect};
  return worst;
}

/// Cuts out odd impacts one after the other.
void find_odd_ones(const std::vector<Drop>& drops, const BounceModel& model, const TimingKnown& timing,
                   BounceAnswer& answer) {
  while (true) {
    answer.flights = usable_flights(drops, answer.outliers);
    std::size_t rows = 0;
    for (const Flights& flights : answer.flights) rows += flights.interval.size() - 1;
    if (rows < least_rows || answer.outliers.size() * most_outliers_share >= rows) return;
    const std::vector<Outlier> odd = oddest(drops, model, timing, answer);
    if (odd.empty()) return;
    answer.outliers.push_back(odd.front());
  }
}

/// Returns the law that explains all impacts best, odd ones with them: they are found beside it.
LawKind likeliest_law(const std::vector<Flights>& flights, BounceModel model, const TimingKnown& timing) {
  double most = -1e300;
  LawKind best = LawKind::curve;
  for (const RestitutionLaw& law : restitution_laws()) {
    model.law = law.kind;
    const double evidence = fit_law(flights, model, timing).posterior.log_evidence;
    if (evidence > most) most = evidence, best = law.kind;
  }
  return best;
}

void expect_enough(const std::vector<Drop>& drops, const std::vector<Flights>& flights) {
  std::size_t rows = 0;
  for (const Flights& one : flights) rows += one.interval.size() - (std::isfinite(one.height) ? 0 : 1);
  if (rows >= 2) return;
  throw InputError({{{drops.empty() ? "" : drops.front().file, 0, 0},
                     "",
                     "has fewer than three flights in a row that fit each other (a restitution needs two)",
                     "record more bounces of a drop, or say how the times are to be read: --as, --column, "
                     "--unit"}});
}

}  // namespace

std::string LawFit::name() const {
  return std::string(law_of(model.law).name) + (model.air == AirModel::free ? " and air" : "");
}

Estimate LawFit::restitution_at(double speed) const { return posterior.estimate(linear_at(speed)); }

LinearValue LawFit::linear_at(double speed) const {
  const std::size_t own = law_of(model.law).parameters.size();
  const auto value = [&](const Eigen::VectorXd& of) {
    return restitution(model.law, {of.data(), own}, speed, model.reference);
  };
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(at.value.size());
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(own); ++k) {
    const LawParameter& p = parameters[static_cast<std::size_t>(k)];
    Eigen::VectorXd low = at.value, high = at.value;
    low[k] = std::max(p.low, low[k] - 1e-4), high[k] = std::min(p.high, high[k] + 1e-4);
    slope[k] = (value(high) - value(low)) / (high[k] - low[k]);
  }
  return {value(at.value), slope, at.value, 0, model.law == LawKind::curve ? 2.0 : 1.0};
}

bool BounceAnswer::holds() const {
  return best().model.law != LawKind::curve && !(test.p_value <= holds_above);
}

Estimate BounceAnswer::averaged_at(double speed) const {
  constexpr double negligible = 1e-4;
  std::vector<NormalPart> parts;
  for (const LawFit& law : laws)
    if (law.probability > negligible) law.posterior.add_to(parts, law.linear_at(speed), law.probability);
  return estimate_of(parts);
}

LawFit fit_law(const std::vector<Flights>& flights, const BounceModel& model, const TimingKnown& timing) {
  LawFit fit;
  fit.model = model;
  fit.parameters = model.parameters();
  Eigen::VectorXd value = start_of(flights, model, fit.parameters);
  for (int round = 0; round < most_rounds; ++round) {
    fit.at = linearised(flights, model, value);
    fit.posterior = spread_posterior(fit.at, fit.parameters, timing, mean_square(fit.at.residual));
    Eigen::VectorXd mean = fit.posterior.mean();
    for (Eigen::Index k = 0; k < mean.size(); ++k) {
      const LawParameter& p = fit.parameters[static_cast<std::size_t>(k)];
      mean[k] = std::clamp(mean[k], p.low + 1e-6, p.high - 1e-6);
    }
    const Eigen::VectorXd spread = fit.posterior.covariance().diagonal().cwiseSqrt();
    const bool settled = ((mean - value).array().abs() < 0.02 * spread.array() + 1e-9).all();
    value = mean;
    if (settled && round > 0) break;
  }
  fit.at = linearised(flights, model, value);
  for (Eigen::Index k = 0; k < value.size(); ++k) {
    const LawParameter& p = fit.parameters[static_cast<std::size_t>(k)];
    fit.values.push_back(fit.posterior.estimate(
        LinearValue{value[k], Eigen::VectorXd::Unit(value.size(), k), value, p.low, p.high}));
  }
  return fit;
}

BounceAnswer choose_law(const std::vector<Drop>& drops, const BounceOptions& options) {
  BounceModel model;
  model.gravity = options.gravity;
  model.height_error = options.height_error;
  for (const Drop& drop : drops) model.heights = model.heights || std::isfinite(drop.height);
  if (options.ball.known()) {
    model.air = AirModel::ball;
    model.ball = std::make_shared<BallFlights>(options.ball, options.gravity);
  }
  BounceAnswer answer;
  answer.outliers = gross_outliers(drops);
  answer.flights = usable_flights(drops, answer.outliers);
  expect_enough(drops, answer.flights);
  const Speeds speeds = speeds_of(answer.flights, model);
  answer.slowest = speeds.slowest, answer.fastest = speeds.fastest;
  model.reference = answer.reference = options.reference > 0 ? options.reference : two_digits(speeds.middle);
  model.law = likeliest_law(answer.flights, model, options.timing);
  find_odd_ones(drops, model, options.timing, answer);
  std::vector<double> priors;
  for (const RestitutionLaw& law : restitution_laws()) {
    model.law = law.kind;
    answer.laws.push_back(fit_law(answer.flights, model, options.timing));
    priors.push_back(law.prior);
    if (model.air != AirModel::none || law.kind == LawKind::curve) continue;
    BounceModel in_air = model;
    in_air.air = AirModel::free;
    answer.laws.push_back(fit_law(answer.flights, in_air, options.timing));
    priors.back() *= 1 - odds_of_free_air;
    priors.push_back(law.prior * odds_of_free_air);
  }
  weigh(answer.laws, priors);
  for (const LawFit& law : answer.laws) {
    answer.tests.push_back(test_of(law, options.timing));
    answer.scatter_odds += law.probability * law.posterior.scatter_odds;
    answer.drop_scatter_odds += law.probability * law.posterior.drop_scatter_odds;
  }
  answer.test = answer.tests.front();
  return answer;
}

}  // namespace shakedown
