#include "src2d/tutorials/beam.h"

#include <algorithm>
#include <cmath>

#include "sem/lesson/numbers.h"
#include "sem/mechanics/quadratic_forms.h"
#include "sem/method/monomials.h"
#include "sem/nurbs/basis.h"
#include "src2d/shapes/shapes.h"
#include "src2d/tutorials/drawing.h"
#include "src2d/tutorials/matrices.h"

namespace sem::tutorial {

Beam make_beam(const MethodOptions& options) {
  constexpr int per_part = 10;
  Beam beam;
  const shapes2d::Rectangle shape{{0, 0}, {beam.length, beam.height}, {4, 1, 4, 1}, 3};
  std::vector<Nurbs<1, 2>> parts;
  for (const auto& part : shapes2d::make_parts(shape)) parts.push_back(part.shape);
  beam.body = discretize<2>({parts}, options);
  const int n = per_part * int(parts.size());
  beam.X.resize(2, n);
  beam.J = MatrixXd::Zero(n, beam.body.boundary.n_controls());
  BasisValues<1> basis;
  for (int i = 0; i < n; ++i) {
    const int part = i / per_part;
    evaluate_basis(parts[part], Param<1>(double(i % per_part) / per_part), 0, basis);
    for (std::size_t k = 0; k < basis.value.size(); ++k)
      beam.J(i, beam.body.boundary.first_control[part] + basis.column[k]) = basis.value[k];
  }
  beam.X = rest_controls(beam.body.boundary) * beam.J.transpose();
  beam.weight = VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    const double edge = (beam.X.col(next) - beam.X.col(i)).norm();
    beam.weight[i] += edge / 2;
    beam.weight[next] += edge / 2;
    if (beam.X(0, i) < 1e-9) beam.left.push_back(i);
  }
  return beam;
}

MatrixXd galerkin(const Material& material, const MatrixXd& Gx, const MatrixXd& Gy,
                  const VectorXd& weight) {
  const StressDerivative<2> C = stress_derivative<2>(material, Mat<2>::Identity());
  const MatrixXd* G[] = {&Gx, &Gy};
  MatrixXd product[2][2];  // integral of G_b^T G_e
  for (int b = 0; b < 2; ++b)
    for (int e = 0; e < 2; ++e) product[b][e] = G[b]->transpose() * weight.asDiagonal() * *G[e];
  const int n = int(Gx.cols());
  MatrixXd K(2 * n, 2 * n);
  for (int a = 0; a < 2; ++a)
    for (int c = 0; c < 2; ++c) {
      MatrixXd block = MatrixXd::Zero(n, n);
      for (int b = 0; b < 2; ++b)
        for (int e = 0; e < 2; ++e) block += C(a + 2 * b, c + 2 * e) * product[b][e];
      K(Eigen::seqN(a, n, 2), Eigen::seqN(c, n, 2)) = block;
    }
  return K;
}

namespace {

// Basis of the grid at points, or its derivative along an axis.
MatrixXd element_rows(const Beam& beam, const Points<2>& X, int n_x, int n_y, int derivative = -1) {
  MatrixXd rows = MatrixXd::Zero(X.cols(), (2 * n_x + 1) * (2 * n_y + 1));
  const int n[] = {n_x, n_y};
  const double size[] = {beam.length / n_x, beam.height / n_y};
  for (int k = 0; k < X.cols(); ++k) {
    double N[2][3];
    int cell[2];
    for (int a = 0; a < 2; ++a) {
      cell[a] = std::clamp(int(X(a, k) / size[a]), 0, n[a] - 1);
      const double t = X(a, k) / size[a] - cell[a];
      const double value[] = {(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)};
      const double slope[] = {4 * t - 3, 4 - 8 * t, 4 * t - 1};
      for (int j = 0; j < 3; ++j) N[a][j] = a == derivative ? slope[j] / size[a] : value[j];
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        rows(k, 2 * cell[0] + i + (2 * n_x + 1) * (2 * cell[1] + j)) = N[0][i] * N[1][j];
  }
  return rows;
}

// Traction at the nodes, N/m; both halves of the pinch balance.
Points<2> traction(const Beam& beam, int load) {
  Points<2> t = Points<2>::Zero(2, beam.X.cols());
  for (int i = 0; i < t.cols(); ++i) {
    const Vec<2> X = beam.X.col(i);
    const bool right = X[0] > beam.length - 1e-9, middle = std::abs(X[0] - beam.length / 2) < 0.25;
    if (load == 0 && right) t(0, i) = 1;
    if (load == 1 && right) t(1, i) = -1;
    if (load == 2 && middle) t(1, i) = X[1] > beam.height / 2 ? -1 : 1;
  }
  return t;
}

// Minimises 1/2 u.K u - f.u with the nodes on the left held. A little of the identity is added: a
// motion without energy stays finite, and if the load does work on it the forces do not balance.
Points<2> respond(const Beam& beam, const Method& method, const Points<2>& t, bool& holds) {
  const MatrixXd C = method.boundary(beam.left, Eigen::all);
  const MatrixXd N = expand(kernel(C.transpose() * C, 1e-10), 2);
  const MatrixXd f = t * beam.weight.asDiagonal() * method.boundary;
  const VectorXd b = N.transpose() * Eigen::Map<const VectorXd>(f.data(), f.size());
  const MatrixXd A = N.transpose() * method.K * N;
  const double little = 1e-12 * A.diagonal().maxCoeff();
  const VectorXd y = solve(A + little * MatrixXd::Identity(A.rows(), A.cols()), b);
  holds = (A * y - b).norm() < 1e-6 * b.norm();
  const VectorXd u = N * y;
  return Eigen::Map<const Points<2>>(u.data(), 2, u.size() / 2) * method.boundary.transpose();
}

double norm(const Beam& beam, const Points<2>& u) {
  return std::sqrt(beam.weight.dot(u.colwise().squaredNorm()));
}

void ask_fields(const Beam& beam, const Method& method, Answer& answer) {
  const auto n_boundary = method.boundary.rows(), n_inside = method.inside.rows();
  MatrixXd rows(n_boundary + n_inside, method.boundary.cols());
  rows << method.boundary, method.inside;
  const Monomials<2> monomials(3);
  MatrixXd values(rows.rows(), monomials.size());
  for (int k = 0; k < rows.rows(); ++k) {
    const Vec<2> X =
        k < n_boundary ? beam.X.col(k) : beam.body.quadrature.position.col(k - n_boundary);
    monomials.values(X - Vec<2>(beam.length, beam.height) / 2, values.row(k));
  }
  const MatrixXd z = least_squares(rows, values), rest = values - rows * z;
  for (int degree = 1; degree <= 3; ++degree)
    for (int m = monomials.first(degree); m < monomials.first(degree + 1); ++m)
      answer.field[degree - 1] =
          std::max(answer.field[degree - 1], rest.col(m).norm() / values.col(m).norm());
  // z.col(0), z.col(1) are the fields x and y.
  MatrixXd turned(2, z.rows()), stretched = MatrixXd::Zero(2, z.rows());
  turned << -z.col(1).transpose(), z.col(0).transpose();
  stretched.row(0) = z.col(0).transpose();
  const auto energy = [&](const MatrixXd& u) {
    const Eigen::Map<const VectorXd> v(u.data(), u.size());
    return v.dot(method.K * v) / 2;
  };
  const double area = beam.length * beam.height, E = beam.material.youngs_modulus;
  answer.rotation = energy(turned) / (E * area / 2);
  answer.stretch =
      energy(stretched) / ((beam.material.lame_lambda() + 2 * beam.material.lame_mu()) * area / 2);
}

}  // namespace

Method finite_elements(const Beam& beam, int n_x, int n_y) {
  const double gauss[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
  const double share[] = {5 / 18.0, 8 / 18.0, 5 / 18.0};
  const double dx = beam.length / n_x, dy = beam.height / n_y;
  Points<2> X(2, 9 * n_x * n_y);
  VectorXd weight(X.cols());
  for (int k = 0; k < X.cols(); ++k) {
    const int element = k / 9, i = k % 3, j = k / 3 % 3;
    X.col(k) = Vec<2>((element % n_x + gauss[i]) * dx, (element / n_x + gauss[j]) * dy);
    weight[k] = share[i] * share[j] * dx * dy;
  }
  return {"finite elements", element_rows(beam, beam.X, n_x, n_y),
          element_rows(beam, beam.body.quadrature.position, n_x, n_y),
          galerkin(beam.material, element_rows(beam, X, n_x, n_y, 0),
                   element_rows(beam, X, n_x, n_y, 1), weight)};
}

Answer ask(const Beam& beam, const Method& method, const Answer* reference) {
  Answer answer;
  answer.name = method.name;
  answer.n_unknowns = int(method.K.rows());
  ask_fields(beam, method, answer);
  double factor = 1;
  for (int load = 0; load < n_loads; ++load) {
    const Points<2> t = traction(beam, load);
    answer.u[load] = factor * respond(beam, method, t, answer.holds[load]);
    if (method.fitted && !answer.holds[0]) answer.holds[load] = false;  // nothing to fit to
    const Points<2>& truth = reference ? reference->u[load] : answer.u[load];
    const auto work = [&](const Points<2>& u) {
      return beam.weight.dot(t.cwiseProduct(u).colwise().sum().transpose());
    };
    if (load == 0 && method.fitted && answer.holds[0]) {
      factor = work(truth) / work(answer.u[0]);  // u ~ 1 / stiffness
      answer.u[0] *= factor;
      answer.rotation /= factor;
      answer.stretch /= factor;
    }
    answer.work[load] = work(answer.u[load]) / work(truth);
    answer.error[load] = norm(beam, answer.u[load] - truth) / norm(beam, truth);
  }
  return answer;
}

std::string percent(double share) {
  const double number = 100 * share;
  return rounded(number, number < 99.5 ? 2 : number < 999.5 ? 3 : 4);
}

namespace {

// The work of a load in % or "no hold".
std::string work_text(const Answer& answer, int load) {
  return answer.holds[load] ? percent(answer.work[load]) : "no hold";
}

}  // namespace

std::vector<std::string> headings() {
  return {"",         "unknowns", "affine", "quadratic", "cubic",
          "rotation", "stretch",  "pull",   "bend",      "pinch"};
}

std::vector<std::string> row(const Answer& answer) {
  std::vector<std::string> cells{answer.name, std::to_string(answer.n_unknowns)};
  for (const double error : answer.field) cells.push_back(error_text(error, 1e-9));
  cells.push_back(error_text(answer.rotation, 1e-9));
  cells.push_back(answer.stretch < 1e-9 ? "< 1e-09" : rounded(answer.stretch, 3));
  for (int load = 0; load < n_loads; ++load)
    cells.push_back(work_text(answer, load) +
                    (answer.holds[load] ? " (" + percent(answer.error[load]) + ")" : ""));
  return cells;
}

namespace {

// The boundary for one load over the reference's in gray, enlarged, in a rectangle; an answer too
// large for it is drawn smaller, with a note.
void draw_answer(Picture& picture, const Beam& beam, const Answer& answer, const Answer& reference,
                 int load, const Color& color, const Box<2>& rectangle) {
  const double largest[] = {0.5, 0.9, 0.25};  // m on the picture
  const double scale = largest[load] / reference.u[load].colwise().norm().maxCoeff();
  picture.set_view({{-0.2, -1.0}, {beam.length + 1.3, beam.height + 0.2}}, rectangle);
  const bool holds = answer.holds[load];
  const double size = holds ? scale * answer.u[load].colwise().norm().maxCoeff() : 0;
  const double shrink = size > 1.25 ? largest[load] / size : 1;
  if (shrink < 1) {
    const double left = rectangle.lower[0] + 0.4 * (rectangle.upper[0] - rectangle.lower[0]);
    picture.canvas().text({left, rectangle.upper[1] - 6},
                          "drawn at " + rounded(100 * shrink, 2) + " %",
                          {.size = 13, .color = color});
  }
  picture.canvas().push_clip(rectangle);
  for (const Answer* which : {&reference, &answer}) {
    if (!which->holds[load]) continue;
    const double enlarged = which == &answer ? scale * shrink : scale;
    auto loop = Polyline();
    for (int i = 0; i < beam.X.cols(); ++i)
      loop.push_back(picture.view().map(Vec<2>(beam.X.col(i) + enlarged * which->u[load].col(i))));
    if (which == &reference)
      picture.canvas().fill(loop, colors::light_gray);
    else
      picture.canvas().stroke(loop, {.color = color, .width = 3, .closed = true});
  }
  picture.canvas().pop_clip();
  const Points<2> truth = reference.u[load];
  const Points<2> shown = beam.X + (holds ? shrink * scale * answer.u[load] : scale * truth);
  picture.hover(shown, [=, name = answer.name, u = answer.u[load]](int i) {
    const std::string own = holds ? coordinates(u.col(i)) + " m" : "no answer";
    return name + ": u = " + own + "\nreference: " + coordinates(truth.col(i)) + " m";
  });
}

}  // namespace

void draw_answers(Picture& picture, const Beam& beam, const Answer& answer, const Answer& reference,
                  const Color& color) {
  for (int load = 0; load < n_loads; ++load) {
    const Box<2> panel = picture.part({0.02, load / 3.0}, {0.62, (load + 1) / 3.0});
    draw_answer(picture, beam, answer, reference, load, color, panel);
    const Vec<2> at(picture.part({0.64, 0}, {1, 1}).lower[0],
                    (panel.lower[1] + panel.upper[1]) / 2);
    const std::string measured =
        answer.holds[load] ? "work " + percent(answer.work[load]) + " % of the reference's"
                           : "nothing resists it";
    picture.canvas().text(at - Vec<2>(0, 16), load_names[load], {.size = 21});
    picture.canvas().text(at + Vec<2>(0, 12), measured,
                          {.size = Picture::text_size, .color = color});
    if (answer.holds[load])
      picture.canvas().text(at + Vec<2>(0, 36), "error " + percent(answer.error[load]) + " %",
                            {.size = Picture::text_size, .color = color});
  }
}

void draw_table(Picture& picture, const Beam& beam, const std::vector<Answer>& answers,
                const Answer& reference) {
  Canvas& canvas = picture.canvas();
  canvas.text(picture.part({0, 0.05}, {1, 1}).lower + Vec<2>(14, 0), "work of the load",
              {.size = 15});
  for (int i = 0; i < int(answers.size()); ++i) {
    const Color color = colors::categorical(i);
    for (int load = 0; load < n_loads; ++load) {
      const Vec<2> corner(0.2 + 0.265 * load, 0.07 + 0.185 * i);
      const Box<2> panel = picture.part(corner, corner + Vec<2>(0.26, 0.17));
      draw_answer(picture, beam, answers[i], reference, load, color, panel);
      const std::string text = work_text(answers[i], load) + (answers[i].holds[load] ? " %" : "");
      canvas.text({panel.lower[0] + 6, panel.upper[1] - 6}, text, {.size = 15});
      if (load == 0)
        canvas.text({14, (panel.lower[1] + panel.upper[1]) / 2}, answers[i].name,
                    {.size = 17, .color = color});
      if (i == 0)
        canvas.text({panel.lower[0] + 70, panel.lower[1] - 8}, load_names[load], {.size = 19});
    }
  }
}

}  // namespace sem::tutorial
