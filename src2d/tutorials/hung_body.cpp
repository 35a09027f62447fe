#include "src2d/tutorials/hung_body.h"

#include <algorithm>
#include <cmath>

#include "sem/lesson/numbers.h"
#include "sem/lesson/plots.h"
#include "sem/mechanics/loads.h"
#include "sem/mechanics/quadratic_forms.h"
#include "src2d/picture/outline.h"
#include "src2d/shapes/shapes.h"
#include "src2d/tutorials/matrices.h"

namespace sem::tutorial {
namespace {

const Color pale = colors::light_gray.with_alpha(0.5);  // inside of a body at rest

// The body for unknowns z: outlines of its regions, filled.
void draw_body(Picture& picture, const Discretization<2>& body, const Eigen::VectorXd& z,
               const Color& line, const Color& fill, double width = 2.5) {
  for (auto region : Outline(body).regions(control_points(body.unknowns, z))) {
    for (auto& loop : region.loops) loop = picture.view().map(loop);
    picture.canvas().fill(region.loops, fill);
    for (const auto& loop : region.loops)
      picture.canvas().stroke(loop, {.color = line, .width = width, .closed = true});
  }
}

// The mouse reads the points inside of several states, and what these are called.
void read_states(Picture& picture, const Discretization<2>& body,
                 const std::vector<std::string>& names, const std::vector<VectorXd>& z) {
  const Points<2>& X = body.quadrature.position;
  const int n = int(X.cols());
  Points<2> x(2, n * z.size());
  for (std::size_t k = 0; k < z.size(); ++k)
    x.middleCols(n * Eigen::Index(k), n) = evaluate(body.interior, z[k]);
  picture.hover(x, [=](int k) {
    const Vec<2> rest = X.col(k % n), u = x.col(k) - rest;
    return names[k / n] + "\nX = " + coordinates(rest) + "\nmoved by " + rounded(u.norm(), 3) +
           " m";
  });
}

}  // namespace

Discretization<2> make_body(int degree) {
  Points<2> p(2, 8);
  p << -0.1, 0.9, 1.9, 2.8, 2.4, 1.2, 0.3, -0.5,  //
      0.0, -0.3, 0.0, 0.5, 1.4, 0.9, 1.5, 0.9;
  std::vector<Nurbs<1, 2>> parts;
  for (const auto& part : shapes2d::make_parts(shapes2d::SplineLoop{p, 4}))
    parts.push_back(part.shape);
  MethodOptions options;
  options.projection.degree = degree;
  options.weights.cutoff = 2;
  options.rays.n_rays = 12;
  options.sampling.points_per_span = 8;  // more than needed: pictures join the samples by lines
  return discretize<2>({parts}, options);
}

std::vector<int> free_entries(const Discretization<2>& body) {
  std::vector<int> free;
  for (int i = 0; i < body.unknowns.size(); ++i)
    if (body.unknowns.rest(0, i) < 2.3)
      for (const int axis : {0, 1}) free.push_back(2 * i + axis);
  return free;
}

std::vector<int> all_entries(const Discretization<2>& body) {
  std::vector<int> all;
  for (int i = 0; i < 2 * body.unknowns.size(); ++i) all.push_back(i);
  return all;
}

std::unique_ptr<InternalEnergy<2>> make_energy(const Discretization<2>& body,
                                               const Material& material,
                                               const Eigen::MatrixXd& stability) {
  const MaterialField field{{material}, std::vector<int>(body.quadrature.size(), 0)};
  return std::make_unique<InternalEnergy<2>>(body.interior, body.quadrature.weight, field,
                                             stability);
}

System make_system(const Discretization<2>& body, InternalEnergy<2>& energy,
                   const Eigen::MatrixXd& M, double density, const Vec<2>& gravity,
                   const std::vector<int>& free) {
  System system{&energy, expand(M, 2), VectorXd::Zero(energy.size()), free, rest_state(body).z};
  add_body_force<2>(body.interior, density * body.quadrature.weight, gravity, system.load);
  return system;
}

State rest_state(const Discretization<2>& body, const Vec<2>& v, double spin) {
  const Mat<2> W = (Mat<2>() << 0, -spin, spin, 0).finished();
  return {affine_field<2>(body.unknowns, Mat<2>::Identity(), {0, 0}),
          affine_field<2>(body.unknowns, W, v), 0, 0};
}

VectorXd heaviest_motion(const Discretization<2>& body, const Eigen::MatrixXd& M2,
                         const Eigen::MatrixXd& motions) {
  Eigen::MatrixXd rigid(M2.rows(), 3);
  rigid << rest_state(body, {1, 0}).v, rest_state(body, {0, 1}).v, rest_state(body, {0, 0}, 1).v;
  const Eigen::MatrixXd P = motions.transpose() * M2 * rigid;
  const Eigen::MatrixXd free = motions * kernel(P * P.transpose(), 1e-9);
  if (free.cols() == 0) return VectorXd::Zero(M2.rows());
  const VectorXd motion = free * last_eigenvector(free.transpose() * M2 * free);
  int largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  return motion * 0.7 / motion[largest];
}

Run simulate(const System& system, const Eigen::MatrixXd& M, State state, double dt,
             double duration, Integrator scheme) {
  Run run;
  TimeStepper stepper(system, dt, scheme);
  for (;;) {
    const Eigen::Map<const Points<2>> z(state.z.data(), 2, M.rows()),
        v(state.v.data(), 2, M.rows());
    const Mat<2> A = z * M * v.transpose();
    run.time.push_back(state.time);
    run.energy.push_back(energies(system, state).total);
    run.momentum.push_back((v * M).rowwise().sum().norm());
    run.angular.push_back(A(0, 1) - A(1, 0));
    run.z.push_back(state.z);
    if (state.time > duration - dt / 2) return run;
    const StepReport report = stepper.step(state);
    run.status = report.status;
    if (run.status != Status::converged) return run;
    run.n_cut += report.n_substeps > 1;
  }
}

std::string change(const std::vector<double>& values, double scale) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value - values[0]));
  return error_text(largest / (scale > 0 ? scale : std::abs(values[0])), 1e-9);
}

void draw_motion(Picture& picture, const Discretization<2>& body,
                 const std::vector<Eigen::VectorXd>& z, double time) {
  constexpr int n = 6;
  const auto color = [](int shot) { return colors::viridis(shot / (n + 0.5)); };
  std::vector<std::string> names;
  std::vector<VectorXd> shots;
  for (int shot = 0; shot <= n; ++shot) {
    const std::size_t k = shot * (z.size() - 1) / n;
    draw_body(picture, body, z[k], color(shot), color(shot).with_alpha(0.12));
    names.push_back("t = " + rounded(time * double(k) / std::max(1.0, z.size() - 1.0), 3) + " s");
    shots.push_back(z[k]);
  }
  read_states(picture, body, names, shots);
  picture.legend({{"t = 0", color(0)}, {"t = " + rounded(time, 2) + " s", color(n)}},
                 Picture::Corner::lower_right);
}

void draw_states(Picture& picture, const Discretization<2>& body,
                 const std::vector<std::tuple<std::string, Color, Eigen::VectorXd>>& states) {
  std::vector<Picture::Entry> entries;
  std::vector<std::string> names;
  std::vector<VectorXd> all;
  for (const auto& [name, color, z] : states) {
    names.push_back(name), all.push_back(z);
    const bool first = entries.empty();
    draw_body(picture, body, z, color, color.with_alpha(first ? 0.2 : 0.05), first ? 1.5 : 2.5);
    entries.push_back({name, color});
  }
  picture.legend(entries);
  read_states(picture, body, names, all);
}

void draw_mass(Picture& picture, const Discretization<2>& body, const Eigen::MatrixXd& M) {
  picture.note("M, part by part (red > 0, blue < 0), and the size of its row sums");
  const Vec<2> corner = picture.part({0.03, 0.12}, {1, 1}).lower;
  draw_matrix(picture, M, body.boundary.first_control, {corner, corner + Vec<2>(430, 430)}, "M");
  picture.set_view({{-0.6, -0.7}, {2.9, 1.7}}, picture.part({0.54, 0.1}, {1, 0.9}));
  draw_body(picture, body, body.unknowns.rest.reshaped(), colors::gray, pale);
  const Eigen::VectorXd sum = M.rowwise().sum();
  const Eigen::VectorXd size = 40 * (sum / sum.maxCoeff()).cwiseAbs().cwiseSqrt();
  for (int i = 0; i < size.size(); ++i)
    picture.dot(body.unknowns.rest.col(i), red.with_alpha(0.6), size[i]);
  picture.hover(body.unknowns.rest,
                [=](int i) { return "row sum of M: " + rounded(sum[i], 3) + " kg"; });
}

void draw_hung(Picture& picture, const Discretization<2>& body,
               const std::vector<std::pair<std::string, Eigen::VectorXd>>& ends) {
  const double n = double(ends.size());
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const auto& [name, z] = ends[k];
    picture.set_view({{-1.2, -2.6}, {3.2, 2.2}},
                     picture.part({double(k) / n, 0.05}, {double(k + 1) / n, 1}));
    draw_body(picture, body, body.unknowns.rest.reshaped(), colors::gray, pale, 1.5);
    picture.canvas().push_clip(picture.view_area());
    draw_body(picture, body, z, k + 1 == ends.size() ? blue : red, colors::white.with_alpha(0));
    picture.canvas().pop_clip();
    picture.dots(evaluate(body.interior, z), blue, 4);
    const Box<2>& panel = picture.view_area();
    picture.canvas().text({(panel.lower[0] + panel.upper[0]) / 2, panel.lower[1] + 20}, name,
                          {.size = 20, .horizontal = TextStyle::Horizontal::center});
    read_states(picture, body, {name}, {z});
  }
  picture.note("curves J p (lines) and points x(X) (dots) after the last good step, at most 0.4 s");
}

void draw_displacement(Picture& picture, const Discretization<2>& body, const Eigen::VectorXd& u) {
  const Eigen::VectorXd rest = body.unknowns.rest.reshaped();
  picture.set_view({{-1, -0.9}, {3.1, 2.1}}, picture.part({0.57, 0.1}, {1, 0.95}));
  picture.canvas().text(picture.part({0.58, 0.06}, {1, 1}).lower,
                        "a soft motion: red curve, blue points", {.size = Picture::text_size});
  draw_body(picture, body, rest, colors::gray, pale);
  draw_body(picture, body, rest + u, red, red.with_alpha(0));
  const Points<2> X = body.quadrature.position, x = evaluate(body.interior, rest + u);
  read_states(picture, body, {"a soft motion"}, {rest + u});
  for (int k = 0; k < X.cols(); k += 2) picture.arrow(X.col(k), x.col(k) - X.col(k), blue, 1.5);
}

void draw_vectors(Picture& picture, const Discretization<2>& body, const Eigen::VectorXd& vectors,
                  double scale, const std::vector<int>& free) {
  draw_body(picture, body, body.unknowns.rest.reshaped(), colors::gray, pale);
  for (int i = 0; i < body.unknowns.size(); ++i) {
    const Vec<2> X = body.unknowns.rest.col(i);
    picture.arrow(X, scale * vectors.segment<2>(2 * i), red, 3);
    if (std::binary_search(free.begin(), free.end(), 2 * i))
      picture.dot(X, colors::gray, 9);
    else
      picture.dot(X, colors::black, 14, MarkerShape::triangle);
  }
  picture.hover(body.unknowns.rest, [=, rest = body.unknowns.rest](int i) {
    return coordinates(vectors.segment<2>(2 * i)) + " N at " + coordinates(rest.col(i)) +
           (std::binary_search(free.begin(), free.end(), 2 * i) ? "" : "\npinned");
  });
}

void draw_springs(Picture& picture, const Samples<2>& samples, const Points<2>& map,
                  const Points<2>& curve, const Eigen::VectorXd& energy) {
  for (std::size_t i = 0; i + 1 < samples.first.size(); ++i) {
    const auto part = Eigen::seq(samples.first[i], samples.first[i + 1] - 1);
    picture.curve(map(Eigen::all, part), {.color = blue, .width = 4});
    picture.curve(curve(Eigen::all, part), {.color = colors::gray, .width = 4});
  }
  const double largest = std::max(energy.maxCoeff(), 1e-300);
  for (int s = 0; s < samples.size(); ++s)
    picture.line(map.col(s), curve.col(s),
                 {.color = colors::mix(colors::light_gray, red, energy[s] / largest), .width = 5});
  picture.hover((map + curve) / 2, [=](int s) {
    return "length " + rounded((map.col(s) - curve.col(s)).norm(), 3) + " m\nenergy " +
           rounded(energy[s], 3) + " J";
  });
  picture.legend({{"the map x(X(u))", blue},
                  {"the curve J(u) p", colors::gray},
                  {"springs, red: most energy", red}},
                 Picture::Corner::lower_left);
}

Trace spectrum(const std::string& label, const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd values = eigenvalues(matrix);
  Trace trace{label, {}, {}};
  for (int i = 0; i < values.size(); ++i) {
    trace.x.push_back(i + 1);
    trace.y.push_back(std::max(1e-18, std::abs(values[i]) / values.maxCoeff()));
  }
  return trace;
}

}  // namespace sem::tutorial
