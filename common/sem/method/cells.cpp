#include "sem/method/cells.h"

#include <algorithm>
#include <cmath>

namespace sem {
namespace {

using Eigen::VectorXd;

constexpr double finest_on_strand =
    1e-16;  // tolerance of the points on strands that are judged, by the measure
constexpr int reference_strands = 27;
constexpr double share_of_cell = 0.2;  // of the tolerance

template <int Dim>
VectorXd integrals_over(const Strands<Dim>& strands, const SmoothIntegrands<Dim>& f,
                        double tolerance) {
  VectorXd sum = VectorXd::Zero(f.size());
  for (const auto& strand : strands)
    for_each_point(strand, f.rate(), tolerance,
                   [&](const Vec<Dim>& X, double weight) { f.add(X, weight, sum); });
  return sum;
}

// A rule as the numbers of strands in each cell and the tolerance of the points on them.
template <int Dim>
class CellTuner {
 public:
  CellTuner(const std::vector<Cell<Dim>>& cells, const Yardstick<Dim>& yardstick)
      : cells_(cells), yardstick_(yardstick), n_(cells.size(), -1) {}

  // As many strands as have errors of at most `local` in each cell, or the best there are. False if these are
  // the ones chosen before.
  bool choose_strands(double local) {
    bool changed = false;
    for (size_t c = 0; c < cells_.size(); ++c) {
      const auto& trials = cells_[c].trials;
      auto chosen = std::find_if(trials.begin(), trials.end(),
                                 [&](const auto& t) { return t.error <= local; });
      if (chosen == trials.end())
        chosen = std::min_element(trials.begin(), trials.end(),
                                  [](const auto& s, const auto& t) { return s.error < t.error; });
      changed |= n_[c] != int(chosen - trials.begin());
      n_[c] = int(chosen - trials.begin());
    }
    return changed;
  }

  double error_of_strands() const {
    VectorXd sum = VectorXd::Zero(yardstick_.scale.size());
    for (size_t c = 0; c < cells_.size(); ++c) sum += trial(c).deviation;
    return sum.cwiseAbs().maxCoeff();
  }

  // Relative deviation of the rule with points for the tolerance `on_strands`, and its number of
  // points.
  VectorXd deviation(double on_strands, int& n_points) const {
    VectorXd sum = VectorXd::Zero(yardstick_.scale.size());
    const auto& f = yardstick_.integrands;
    n_points = 0;
    for (size_t c = 0; c < cells_.size(); ++c) {
      sum -= cells_[c].reference;
      if (trial(c).strands.empty()) sum[0] = std::numeric_limits<double>::infinity();
      for (const auto& strand : trial(c).strands)
        for_each_point(strand, f.rate(), on_strands * yardstick_.scale[0],
                       [&](const Vec<Dim>& X, double weight) {
                         f.add(X, weight, sum);
                         ++n_points;
                       });
    }
    return sum.cwiseQuotient(yardstick_.scale);
  }

  // Takes away strands, one of each cell in turn, where the rest stays right.
  void drop_dispensable(double on_strands) {
    int n_points = 0;
    VectorXd now = deviation(on_strands, n_points);
    for (bool dropped = true; dropped;) {
      dropped = false;
      for (size_t c = 0; c < cells_.size(); ++c) {
        if (n_[c] == 0) continue;
        const VectorXd next = now - trial(c).deviation + cells_[c].trials[n_[c] - 1].deviation;
        if (!(next.cwiseAbs().maxCoeff() <= 0.95 * yardstick_.tolerance)) continue;
        now = next;
        --n_[c];
        dropped = true;
      }
    }
  }

  CellRule<Dim> rule(double on_strands) const {
    CellRule<Dim> result;
    std::vector<Vec<Dim>> position;
    for (size_t c = 0; c < cells_.size(); ++c)
      for (const auto& strand : trial(c).strands)
        for_each_point(strand, yardstick_.integrands.rate(),
                       on_strands * yardstick_.scale[0], [&](const Vec<Dim>& X, double weight) {
                         position.push_back(X);
                         result.weight.push_back(weight);
                         result.solid.push_back(strand.solid);
                       });
    result.position.resize(Dim, position.size());
    for (size_t k = 0; k < position.size(); ++k) result.position.col(k) = position[k];
    int n_points = 0;
    result.error = deviation(on_strands, n_points).cwiseAbs().maxCoeff();
    return result;
  }

 private:
  const typename Cell<Dim>::Trial& trial(size_t c) const { return cells_[c].trials[n_[c]]; }

  const std::vector<Cell<Dim>>& cells_;
  const Yardstick<Dim>& yardstick_;
  std::vector<int> n_;  // of each cell: strands - 1
};

}  // namespace

template <int Dim>
Cell<Dim> fit_cell(const StrandFamily<Dim>& family, const Yardstick<Dim>& yardstick, int n_most,
                   const std::optional<VectorXd>& reference) {
  const auto& f = yardstick.integrands;
  const double finest = finest_on_strand * yardstick.scale[0];
  Cell<Dim> cell;
  if (reference) {
    cell.reference = *reference;
  } else {
    const Strands<Dim> many = family(reference_strands);
    cell.reference = integrals_over(many, f, finest);
    n_most = many.empty()
                 ? 1
                 : std::min(n_most, reference_strands * 2 / 3);  // the reference has to be better
  }
  for (int n = 1; n <= n_most && !cell.fitted; ++n) {
    auto& trial = cell.trials.emplace_back();
    trial.strands = family(n);
    trial.deviation =
        (integrals_over(trial.strands, f, finest) - cell.reference).cwiseQuotient(yardstick.scale);
    if (trial.strands.empty()) trial.deviation.setConstant(std::numeric_limits<double>::infinity());
    trial.error = trial.deviation.cwiseAbs().maxCoeff();
    cell.fitted = trial.error <= share_of_cell * yardstick.tolerance && !cell.reference.isZero(0);
  }
  return cell;
}

template <int Dim>
CellRule<Dim> cheapest_rule(const std::vector<Cell<Dim>>& cells, const Yardstick<Dim>& yardstick) {
  constexpr double step = 1.7, loosest = 1e-3, tightest = 1e-17;
  CellTuner<Dim> tuner(cells, yardstick);
  double strands = loosest, best_strands = 0, points = tightest,
         best_points = tightest;  // relative to the measure
  int fewest = std::numeric_limits<int>::max();
  // From many points on few strands to few points on many.
  for (; strands > tightest; strands /= step) {
    if (!tuner.choose_strands(strands) || tuner.error_of_strands() > yardstick.tolerance) continue;
    while (points < loosest) {
      int n_points = 0;
      if (tuner.deviation(points, n_points).cwiseAbs().maxCoeff() > yardstick.tolerance) break;
      if (n_points < fewest) {
        fewest = n_points;
        best_strands = strands;
        best_points = points;
      }
      points *= step;
    }
  }
  tuner.choose_strands(best_strands);
  const CellRule<Dim> right = tuner.rule(best_points);
  tuner.drop_dispensable(best_points);
  CellRule<Dim> smaller = tuner.rule(best_points);
  return smaller.error <= yardstick.tolerance ? smaller : right;
}

template Cell<2> fit_cell<2>(const StrandFamily<2>&, const Yardstick<2>&, int,
                             const std::optional<VectorXd>&);
template Cell<3> fit_cell<3>(const StrandFamily<3>&, const Yardstick<3>&, int,
                             const std::optional<VectorXd>&);
template CellRule<2> cheapest_rule<2>(const std::vector<Cell<2>>&, const Yardstick<2>&);
template CellRule<3> cheapest_rule<3>(const std::vector<Cell<3>>&, const Yardstick<3>&);

}  // namespace sem
