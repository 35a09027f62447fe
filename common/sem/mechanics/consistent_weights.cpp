#include "sem/mechanics/consistent_weights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sem/mechanics/assembly.h"
#include "sem/method/join_blocks.h"
#include "sem/solve/dense_kernels.h"
#include "sem/solve/sparse_cholesky.h"

namespace sem {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double contradiction = 1e-3;  // of the affine field: a boundary with gaps or overlaps
constexpr double rounding = 1e-12, settled = 1e-7;  // of a defect
constexpr double shift = 1e-10;         // fields without divergence that the boundary holds do not count
constexpr double largest_exponent = 1;  // where weights must change by more, the rule is too coarse to say how
constexpr int max_steps = 8;

template <int Dim>
class Balance {
 public:
  explicit Balance(const Discretization<Dim>& d)
      : rule_(boundary_rule(d)),
        interior_(joined(d.interior, blocks_to_join(d.interior))),
        on_boundary_(with_parts(map_at(d, rule_.samples.position, false), rule_.samples.part, d.boundary.n_parts())),
        volume_(d.quadrature.weight),
        area_(rule_.samples.weight),
        length_(volume_.sum() / area_.sum()),
        plan_(plan_elimination(on_boundary_.n_columns, all_couplings())),
        gather_(interior_, plan_, Dim),
        gather_boundary_(on_boundary_, plan_, Dim) {}

  ConsistentWeights run() {
    const int n = Dim * on_boundary_.n_columns;
    ConsistentWeights given{volume_, area_, 0, false}, now = given;
    size_ = terms(volume_, area_);
    VectorXd lambda = VectorXd::Zero(n), defect = defect_of(volume_, area_);
    double error = relative(defect);
    given.defect = now.defect = error;
    // Columns 0 to Dim are 1 and X / size, whose gradients are exact.
    const double slope = size_.segment(Dim, Dim).maxCoeff();
    if (!(defect.head(Dim * (Dim + 1)).cwiseAbs().maxCoeff() <= contradiction * slope)) return given;
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    SymmetricMatrix G(plan_, Dim);
    SparseCholesky factor(plan_, Dim, all);
    for (int step = 0; step < max_steps && error > rounding; ++step) {
      set_matrix(now.interior, now.boundary, G);
      if (!factor.compute(G)) return given;
      VectorXd way = defect;
      factor.solve_in_place(way);
      lambda += way;
      const VectorXd exponent = exponents(lambda);
      if (!(exponent.cwiseAbs().maxCoeff() < largest_exponent)) return given;
      now.interior = volume_.array() * exponent.head(volume_.size()).array().exp();
      now.boundary = area_.array() * exponent.tail(area_.size()).array().exp();
      defect = defect_of(now.interior, now.boundary);
      const double before = error;
      error = relative(defect);
      if (error > 0.5 * before) break;  // what is left is in fields that have no divergence but for rounding
    }
    now.reached = error <= settled;
    return now.reached ? now : given;
  }

 private:
  // With the parts' indicators for further functions: weights of a part keep their sum, as loads on it do.
  static Map<Dim> with_parts(Map<Dim> map, const std::vector<int>& part, int n_parts) {
    for (auto& block : map.blocks) {
      std::vector<int> present;
      for (const int s : block.points) present.push_back(part[s]);
      std::sort(present.begin(), present.end());
      present.erase(std::unique(present.begin(), present.end()), present.end());
      const Eigen::Index n = block.value.cols();
      block.value.conservativeResizeLike(MatrixXd::Zero(block.value.rows(), n + Eigen::Index(present.size())));
      for (size_t p = 0; p < present.size(); ++p) {
        block.columns.push_back(map.n_columns + present[p]);
        for (size_t k = 0; k < block.points.size(); ++k)
          if (part[block.points[k]] == present[p]) block.value(k, n + Eigen::Index(p)) = 1;
      }
    }
    map.n_columns += n_parts;
    return map;
  }

  // What a unit of component a of the multipliers does at the block's samples through its column j: phi N_a, or the
  // indicator.
  VectorXd flux(const MapBlock<Dim>& block, int j, int a) const {
    if (block.columns[j] < interior_.n_columns) return block.value.col(j).cwiseProduct(rule_.normal.row(a)(block.points).transpose());
    return a == 0 ? VectorXd(block.value.col(j)) : VectorXd::Zero(block.value.rows());
  }

  std::vector<std::vector<int>> all_couplings() const {
    auto cliques = couplings(interior_);
    for (auto& clique : couplings(on_boundary_)) cliques.push_back(std::move(clique));
    return cliques;
  }

  // sum_k v_k grad phi - sum_q s_q phi N, component by component; of the parts what their sums lack.
  VectorXd defect_of(const VectorXd& v, const VectorXd& s) const {
    VectorXd sum = VectorXd::Zero(Dim * on_boundary_.n_columns);
    for (const auto& block : interior_.blocks) {
      const VectorXd weight = v(block.points);
      for (int a = 0; a < Dim; ++a) {
        const VectorXd part = block.gradient[a].transpose() * weight;
        for (size_t j = 0; j < block.columns.size(); ++j) sum[Dim * block.columns[j] + a] += part[j];
      }
    }
    for (const auto& block : on_boundary_.blocks) {
      const VectorXd weight = s(block.points), given = area_(block.points);
      for (int j = 0; j < int(block.columns.size()); ++j)
        for (int a = 0; a < Dim; ++a) {
          const bool indicator = block.columns[j] >= interior_.n_columns;
          sum[Dim * block.columns[j] + a] -= flux(block, j, a).dot(indicator ? VectorXd(weight - given) : weight);
        }
    }
    return sum;
  }

  // The sums of its terms' sizes.
  VectorXd terms(const VectorXd& v, const VectorXd& s) const {
    VectorXd sum = VectorXd::Zero(Dim * on_boundary_.n_columns);
    for (const auto& block : interior_.blocks)
      for (int a = 0; a < Dim; ++a)
        for (size_t j = 0; j < block.columns.size(); ++j)
          sum[Dim * block.columns[j] + a] += block.gradient[a].col(j).cwiseAbs().dot(v(block.points));
    for (const auto& block : on_boundary_.blocks)
      for (int j = 0; j < int(block.columns.size()); ++j)
        for (int a = 0; a < Dim; ++a) sum[Dim * block.columns[j] + a] += flux(block, j, a).cwiseAbs().dot(s(block.points));
    return sum;
  }

  double relative(const VectorXd& defect) const {
    double largest = 0;
    for (Eigen::Index i = 0; i < defect.size(); ++i)
      if (size_[i] > 0) largest = std::max(largest, std::abs(defect[i]) / size_[i]);
    return largest;
  }

  // -div lambda at the points, lambda . N / l at the samples.
  VectorXd exponents(const VectorXd& lambda) const {
    const Eigen::Map<const Points<Dim>> field(lambda.data(), Dim, on_boundary_.n_columns);
    VectorXd all = VectorXd::Zero(volume_.size() + area_.size());
    auto inside = all.head(volume_.size());
    auto outside = all.tail(area_.size());
    for (const auto& block : interior_.blocks)
      for (int a = 0; a < Dim; ++a) {
        const VectorXd part = block.gradient[a] * field.row(a)(block.columns).transpose();
        inside(block.points) -= part;
      }
    for (const auto& block : on_boundary_.blocks) {
      VectorXd sum = VectorXd::Zero(Eigen::Index(block.points.size()));
      for (int j = 0; j < int(block.columns.size()); ++j)
        for (int a = 0; a < Dim; ++a) sum += field(a, block.columns[j]) * flux(block, j, a);
      outside(block.points) += sum / length_;
    }
    return all;
  }

  // sum_k v_k div phi div psi + sum_q s_q / l (phi . N)(psi . N).
  void set_matrix(const VectorXd& v, const VectorXd& s, SymmetricMatrix& G) {
    G.set_zero();
    for (size_t b = 0; b < interior_.blocks.size(); ++b) {
      const auto& block = interior_.blocks[b];
      const VectorXd root = v(block.points).cwiseSqrt();
      add_products(block, int(b), gather_, G, [&](int a, int j) -> VectorXd { return root.cwiseProduct(block.gradient[a].col(j)); });
    }
    gather_.finish(G);
    for (size_t b = 0; b < on_boundary_.blocks.size(); ++b) {
      const auto& block = on_boundary_.blocks[b];
      const VectorXd root = (s(block.points) / length_).cwiseSqrt();
      add_products(block, int(b), gather_boundary_, G, [&](int a, int j) -> VectorXd { return root.cwiseProduct(flux(block, j, a)); });
    }
    gather_boundary_.finish(G);
    VectorXd more = shift * G.diagonal();
    for (double& entry : more)
      if (entry == 0) entry = 1;  // a further component of a part, which does nothing
    G.add_to_diagonal(more);
  }

  template <class Column>
  void add_products(const MapBlock<Dim>& block, int b, Assembly<Dim>& gather, SymmetricMatrix& G, const Column& column) {
    const auto& order = gather.order(b);
    const int k = int(block.points.size()), n = Dim * int(order.size());
    rows_.resize(k, n);
    for (size_t j = 0; j < order.size(); ++j)
      for (int a = 0; a < Dim; ++a) rows_.col(Dim * Eigen::Index(j) + a) = column(a, order[j]);
    local_.setZero(n, n);
    dense_kernels().add_lower_product(local_.data(), n, rows_.data(), k, rows_.data(), k, n, k);
    gather.add(b, local_, G);
  }

  const BoundaryRule<Dim> rule_;
  const Map<Dim> interior_, on_boundary_;
  const VectorXd volume_, area_;
  const double length_;
  std::shared_ptr<const Elimination> plan_;
  Assembly<Dim> gather_, gather_boundary_;
  VectorXd size_;
  MatrixXd rows_, local_;
};

}  // namespace

template <int Dim>
ConsistentWeights consistent_weights(const Discretization<Dim>& d) {
  return Balance<Dim>(d).run();
}

template ConsistentWeights consistent_weights<2>(const Discretization<2>&);
template ConsistentWeights consistent_weights<3>(const Discretization<3>&);

}  // namespace sem
