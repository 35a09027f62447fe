// Step 12: the neighbours
//
//   build/release/bin/sem2d_step_12_neighbours --out out/step_12      numbers, pictures
//   build/release/bin/sem2d_step_12_neighbours --set cutoff=1.01      whom does it suit?
//   build/release/bin/sem2d_step_12_neighbours --interactive
//
// New here: the methods of the draft's section 2 on one solid: a beam of 4 x 1 m held on the left,
// linear elasticity. Each is a set of basis functions, x(X) = sum_j N_j(X) z_j, and a stiffness K
// of z, below in a few lines each; loads, solver and tests are the same for all (beam.h). A
// stiffness without a physical meaning is fitted to the pull; bend and pinch then follow.
//
//   shape matching   particles z; force k m (g - z), goals g: the best rigid or affine motion
//   virtual element  nodes z; mean gradient 1/A sum u (x) n of the boundary, plus s(I - Pi)
//   skinning (LBS)   frames z = (A_i, t_i): x = sum w_i(X) (A_i X + t_i), F with grad w
//   D-NURBS          control points z; curve energy 1/2 integral a |x_s|^2 + b |x_ss|^2
//   this method      control points z; frames of degree n by fits (eq. 5), F without grad w
//                    (eq. 12), the stability term
//
// So the first two (Mueller et al. 2005; Beirao da Veiga et al. 2012) are one polynomial for all of
// the solid, skinning is this method with the fit left out, D-NURBS its boundary without an inside.
//
// Things to try: --set beta=1: a shape matching that no pull can stop. --set tau=0.1 or 10: whose
// is a virtual element's answer to bending? --set cutoff=0.75 or 1.01: who gains, who loses?
#include "sem/lesson/lesson.h"
#include "sem/mechanics/quadratic_forms.h"
#include "sem/nurbs/basis.h"
#include "src2d/tutorials/beam.h"
#include "src2d/tutorials/matrices.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

// The best fit of the fields in the columns of B, weighted by the masses m: g = B fit(B, m) x.
MatrixXd fit(const MatrixXd& B, const VectorXd& m) {
  const MatrixXd mB = m.asDiagonal() * B;
  return solve(B.transpose() * mB, mB.transpose());
}

// Mueller et al. 2005, goals g = P x for small displacements (a rotation is 1 + angle (-y, x)
// then), beta = 0: rigid ones, 1: affine ones. The inside follows the affine match.
Method shape_matching(const Beam& beam, double beta) {
  const int N = int(beam.X.cols());
  MatrixXd linear(N, 3), rigid(2 * N, 3), m2 = expand(beam.weight.asDiagonal().toDenseMatrix(), 2);
  linear << VectorXd::Ones(N), beam.X.transpose();
  const MatrixXd affine = expand(linear, 2);
  for (int i = 0; i < N; ++i) rigid.middleRows<2>(2 * i) << 1, 0, -beam.X(1, i), 0, 1, beam.X(0, i);
  const VectorXd m = m2.diagonal();
  const MatrixXd P = beta * affine * fit(affine, m) + (1 - beta) * rigid * fit(rigid, m);
  const MatrixXd K = m2 - m2 * P;  // force k m (g - x)
  const Points<2>& Y = beam.body.quadrature.position;
  MatrixXd at(Y.cols(), 3);
  at << VectorXd::Ones(Y.cols()), Y.transpose();
  return {"shape matching", MatrixXd::Identity(N, N), at * fit(linear, beam.weight), K, true};
}

// Degree 1: Pi u = mean + (mean gradient) (X - mean X).
Method virtual_element(const Beam& beam, double tau) {
  const int N = int(beam.X.cols());
  const double area = beam.length * beam.height;
  MatrixXd G =
      MatrixXd::Zero(2, N);  // mean gradient = 1/A integral u (x) n, exact for straight edges
  for (int i = 0; i < N; ++i) {
    const int j = (i + 1) % N;
    const Vec<2> edge = beam.X.col(j) - beam.X.col(i), normal(edge[1], -edge[0]);  // times length
    G.col(i) += normal / (2 * area);
    G.col(j) += normal / (2 * area);
  }
  const MatrixXd mean = MatrixXd::Constant(1, N, 1.0 / N);
  const auto Pi = [&](const Points<2>& X) -> MatrixXd {
    const Points<2> relative = X.colwise() - Vec<2>(beam.X.rowwise().mean());
    return VectorXd::Ones(X.cols()) * mean + relative.transpose() * G;
  };
  const MatrixXd rest = MatrixXd::Identity(N, N) - Pi(beam.X);
  const MatrixXd K = galerkin(beam.material, G.row(0), G.row(1), VectorXd::Constant(1, area)) +
                     tau * beam.material.youngs_modulus * expand(rest.transpose() * rest, 2);
  return {"virtual element", MatrixXd::Identity(N, N), Pi(beam.body.quadrature.position), K};
}

// The blended map with coefficients and translations themselves as unknowns in place of a fit.
Projection<2> frames(int n_parts) {
  Projection<2> projection;  // degree 1
  for (int i = 0; i < n_parts; ++i) {
    PartFit frame;
    frame.columns = {3 * i, 3 * i + 1, 3 * i + 2};
    frame.coefficients = MatrixXd::Identity(2, 3);
    frame.translation = Eigen::RowVector3d(0, 0, 1);
    projection.parts.push_back(frame);
  }
  return projection;
}

Map<2> skinning_map(const Beam& beam, const Points<2>& X) {
  const auto& d = beam.body;
  const auto variant = d.options.weights.variant;
  const auto distances =
      measure_distances(d.boundary, d.loops, X, variant, d.options.weights.cutoff);
  auto theta = distance_weights(distances, d.options.weights);
  distance_weight_gradients(d.boundary, X, distances, theta);
  const int n_parts = d.boundary.n_parts();
  return blended_map(X, blending_weights(theta, d.boundary, X), d.origins, frames(n_parts),
                     3 * n_parts, true);
}

Method skinning(const Beam& beam) {
  const Map<2> inside = skinning_map(beam, beam.body.quadrature.position);
  return {"skinning", dense_value(skinning_map(beam, beam.X)), dense_value(inside),
          galerkin(beam.material, dense_gradient(inside, 0), dense_gradient(inside, 1),
                   beam.body.quadrature.weight)};
}

// On a straight side a neighbour's weight is 0 on the part itself (the Kronecker rule) but not just
// inside: x(X) jumps there, and an answer may be softer than any continuous one.
double weight_jump(const Beam& beam) {
  const Points<2> in = beam.X + 1e-7 * ((-beam.X).colwise() + Vec<2>(2, 0.5));
  return (dense_value(skinning_map(beam, in)) - dense_value(skinning_map(beam, beam.X)))
      .cwiseAbs()
      .maxCoeff();
}

// Terzopoulos and Qin 1994, a curve's energy. Control points that coincide are one.
Method d_nurbs(const Beam& beam, double bending) {
  const auto& boundary = beam.body.boundary;
  MatrixXd join = MatrixXd::Identity(boundary.n_controls(), boundary.n_controls());
  std::vector<int> kept;
  for (const auto& group : coincident_controls(boundary))
    for (const int c : group) join(c, c) = 0, join(c, group[0]) = 1;
  for (int c = 0; c < boundary.n_controls(); ++c)
    if (join.col(c).any()) kept.push_back(c);
  const Samples<2> samples = sample_boundary(boundary, {.points_per_span = 6});
  MatrixXd K = MatrixXd::Zero(join.rows(), join.rows());
  BasisValues<1> N;
  for (int s = 0; s < samples.size(); ++s) {
    const Nurbs<1, 2>& part = boundary.parts[samples.part[s]].nurbs;
    evaluate_basis(part, samples.u[s], 2, N);
    const double speed = derivatives(part, samples.u[s], 1).first.norm();  // ds/du, constant here
    for (std::size_t i = 0; i < N.column.size(); ++i)
      for (std::size_t j = 0; j < N.column.size(); ++j)
        K(boundary.first_control[samples.part[s]] + N.column[i],
          boundary.first_control[samples.part[s]] + N.column[j]) +=
            samples.weight[s] * (N.first[0][i] * N.first[0][j] / std::pow(speed, 2) +
                                 bending * N.second[0][i] * N.second[0][j] / std::pow(speed, 4));
  }
  const MatrixXd joined = join(Eigen::all, kept);
  return {"D-NURBS", beam.J * joined, MatrixXd(0, kept.size()),
          expand(joined.transpose() * K * joined, 2), true};
}

// Steps 1 to 11.
Method this_method(const Beam& beam, double gamma_h) {
  const auto& d = beam.body;
  const double gamma = gamma_h * beam.material.youngs_modulus;  // parts are 1 m long
  const MatrixXd S = stability_matrix(d.on_boundary, d.samples, d.unknowns);
  return {"this method", dense_value(map_at(d, beam.X, false)), dense_value(d.interior),
          galerkin(beam.material, dense_gradient(d.interior, 0), dense_gradient(d.interior, 1),
                   d.quadrature.weight) +
              gamma * expand(S, 2)};
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 12: the neighbours", {{-0.5, -1.5}, {5, 1.5}});

  // [1] The beam, and the answer that all others are compared with.
  double cutoff = 0.51;
  int degree = 2;
  Beam beam;
  Answer reference;
  lesson.slider("cutoff", cutoff, 0.51, 2, "of the weights of skinning and this method, m");
  lesson.slider("degree", degree, 1, 4, "of this method's polynomials");
  lesson.step(
      "The beam, three loads, and finite elements for reference",
      [&](std::ostream& out) {
        MethodOptions options;
        options.rays = {.axis = 1, .n_rays = 40};
        options.interval.points = 10;
        options.weights.cutoff = cutoff;
        options.origins = OriginChoice::one;
        options.projection.degree = degree;
        beam = make_beam(options);
        const Answer coarse = ask(beam, finite_elements(beam, 8, 2), nullptr);
        if (reference.name.empty()) reference = ask(beam, finite_elements(beam, 16, 4), nullptr);
        out << "reference: " << reference.n_unknowns << " unknowns; with " << coarse.n_unknowns
            << " the answers differ by";
        for (int load = 0; load < n_loads; ++load)
          out << (load ? ", " : " ")
              << error_text((coarse.u[load] - reference.u[load]).norm() / reference.u[load].norm())
              << " (" << load_names[load] << ")";
        out << "\n" << table(headings(), {row(reference)});
      },
      [&](Picture& picture) { draw_answers(picture, beam, reference, reference, colors::black); });

  std::vector<Answer> answers(5);
  const auto add = [&](int i, const std::string& title, const std::function<Method()>& method) {
    lesson.step(
        title,
        [&, i, method](std::ostream& out) {
          answers[i] = ask(beam, method(), &reference);
          out << table(headings(), {row(answers[i])});
          if (i == 2)
            out << "weights on the boundary - just inside: " << rounded(weight_jump(beam), 2)
                << "\n";
        },
        [&, i](Picture& picture) {
          draw_answers(picture, beam, answers[i], reference, colors::categorical(i));
        });
  };
  double beta = 0.5, tau = 1, bending = 0.01, gamma_h = 40;
  lesson.slider("beta", beta, 0, 1, "share of the affine match in the goals");
  add(0, "Shape matching: goals", [&] { return shape_matching(beam, beta); });
  lesson.slider("tau", tau, 1e-3, 1e3, "stabilisation / E", Lesson::Scale::logarithmic);
  add(1, "One virtual element", [&] { return virtual_element(beam, tau); });
  add(2, "Linear blend skinning with our weights", [&] { return skinning(beam); });
  lesson.slider("bending", bending, 1e-4, 1, "b / a, m^2", Lesson::Scale::logarithmic);
  add(3, "D-NURBS: a curve without an inside", [&] { return d_nurbs(beam, bending); });
  lesson.slider("gamma", gamma_h, 1e-2, 1e4, "gamma h / E", Lesson::Scale::logarithmic);
  add(4, "This method", [&] { return this_method(beam, gamma_h); });

  // [7] Fields: relative error of the best fit. Rotation: energy that a rigid rotation costs,
  // stretch: energy of a uniform stretch, both by the exact scale. Loads: work in % (error in %).
  lesson.step(
      "All in one table",
      [&](std::ostream& out) {
        std::vector<std::vector<std::string>> rows{row(reference)};
        for (const auto& answer : answers) rows.push_back(row(answer));
        out << table(headings(), rows);
      },
      [&](Picture& picture) { draw_table(picture, beam, answers, reference); });
  return lesson.run(argc, argv);
}
// Next: step_13_scene, all of the method as the program runs it.
