// SPDX-License-Identifier: MIT
#include "ideal_judge.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "calibration.hpp"
#include "ideal_signal.hpp"
#include "json_file.hpp"
#include "opened_case.hpp"
#include "output_file.hpp"
#include "random.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using Products = std::vector<std::vector<double>>;

/// Returns the products with negative eigenvalues, which are noise, set to nothing.
Eigen::MatrixXd sensible(const Products& products) {
  const auto size = static_cast<Eigen::Index>(products.size());
  Eigen::MatrixXd matrix(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j)
      matrix(i, j) = products[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(1e-9).asDiagonal() *
         solver.eigenvectors().transpose();
}

/// Returns ln of the integral of Cauchy(a) exp(b a - g a^2 / 2) over the strength a, summed on points of
/// whichever of the two factors is the narrower.
double log_evidence(double b, double g) {
  constexpr int points = 401;
  const double centre = b / g, width = 1 / std::sqrt(g);
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double share = (i + 0.5) / points;
    if (width < 1) {
      constexpr double reach = 8;  // standard deviations of the strength
      const double z = reach * (2 * share - 1), a = centre + z * width;
      sum += std::exp(-0.5 * z * z) / (std::numbers::pi * (1 + a * a)) * 2 * reach * width / points;
    } else {
      const double z = (std::tan(std::numbers::pi * (share - 0.5)) - centre) / width;
      sum += std::exp(-0.5 * z * z) / points;
    }
  }
  return 0.5 * b * b / g + std::log(sum);
}

/// Returns the effects of the list that move box and grains, each at its typical strength.
std::vector<const Hideable*> candidates() {
  std::vector<const Hideable*> list;
  for (const Hideable& hideable : hideable_effects())
    if (hideable.effect->acts_on != ActsOn::camera && !hideable.effect->nuisance) list.push_back(&hideable);
  return list;
}

Products products_of(const fs::path& folder, const Json& plan, const Setup& believed,
                     const TrialTools& tools) {
  const fs::path file = folder / "signatures.json";
  Json ids = Json::array();
  for (const Hideable* one : candidates()) ids.push_back(one->id);
  Products products;
  if (fs::exists(file)) {
    read_json_file(file, "a table of signatures", "remove it, and it is measured anew",
                   [&](const std::string& text) {
                     const Json document = Json::parse(text);
                     if (document.at("effects") == ids) document.at("products").get_to(products);
                   });
    if (!products.empty()) return products;
  }
  const bool small = plan.at("small");
  const IdealSettings settings{
      .runs = varied(small ? small_design() : full_design(), plan.value("variant", "")).runs};
  std::vector<Setup> with;
  for (const Hideable* one : candidates())
    with.push_back(changed(believed, at_strength(*one, 1, believed), tools.known));
  products = ideal_products(believed, with, settings, tools);
  write_file(file, Json{{"schema_version", 1}, {"effects", ids}, {"products", products}}.dump(2) + "\n");
  return products;
}

}  // namespace

double ideal_log_score(const Products& products, std::optional<std::size_t> hidden, double strength,
                       int draws, std::uint64_t seed) {
  constexpr double least = 1e-3, nothing = 0.5;
  const Eigen::MatrixXd g = sensible(products);
  const Eigen::MatrixXd root = g.llt().matrixL();
  const double each = std::log((1 - nothing) / static_cast<double>(products.size()));
  Random random(seed, 0, Stream::other);
  double sum = 0;
  for (int draw = 0; draw < draws; ++draw) {
    Eigen::VectorXd noise(g.rows());
    for (double& value : noise) value = random.normal();
    Eigen::VectorXd b = root * noise;
    if (hidden) b += strength * g.col(static_cast<Eigen::Index>(*hidden));
    std::vector<double> weights{std::log(nothing)};
    for (Eigen::Index k = 0; k < g.rows(); ++k) weights.push_back(each + log_evidence(b(k), g(k, k)));
    const double most = *std::max_element(weights.begin(), weights.end());
    double all = 0;
    for (const double weight : weights) all += std::exp(weight - most);
    const double truth = weights[hidden ? *hidden + 1 : 0];
    sum -= std::log(std::max(std::exp(truth - most) / all, least));
  }
  return sum / draws;
}

std::vector<BlindFigure> ideal_judge(const fs::path& folder, const Setup& believed, const TrialTools& tools) {
  Json plan;
  read_json_file(folder / "plan.json", "the plan of a suite", "put back the one that was there when it began",
                 [&](const std::string& text) { plan = Json::parse(text); });
  const Products products = products_of(folder, plan, believed, tools);
  const std::vector<const Hideable*> known = candidates();
  double judge = 0, answers = 0;
  int cases = 0;
  for (const auto& [name, seal] : plan.at("sealed").get<std::map<std::string, std::string>>()) {
    if (!fs::exists(folder / "answers" / (name + ".json"))) continue;
    const OpenedCase one = open_case(folder, name, seal);
    std::optional<std::size_t> hidden;
    if (one.kind == BlindKind::single)
      for (std::size_t k = 0; k < known.size(); ++k)
        if (one.ids.size() == 1 && known[k]->id == one.ids.front()) hidden = k;
    if (one.kind != BlindKind::null && one.kind != BlindKind::parameters && !hidden) continue;
    if (one.hypotheses.empty() && !one.lost) continue;
    const double square = hidden ? std::max(products[*hidden][*hidden], 1e-9) : 1;
    constexpr int draws = 200;
    judge += ideal_log_score(products, hidden, one.signal / std::sqrt(square), draws, 1);
    answers += log_score(one);
    ++cases;
  }
  const auto row = [&](const char* what, double sum) -> BlindFigure {
    return {what, "-", cases == 0 ? "no such case" : fmt::format("{:.2f} ({} cases)", sum / cases, cases)};
  };
  return {row("mean log score with nothing or one effect hidden", answers),
          row("the same of an ideal judge, who knows signatures and covariance", judge)};
}

}  // namespace shakedown
