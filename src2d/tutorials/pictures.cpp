#include "src2d/tutorials/pictures.h"

#include <algorithm>
#include <cmath>

#include "sem/lesson/numbers.h"
#include "src2d/picture/outline.h"
#include "src2d/tutorials/plots.h"

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

}  // namespace

void draw_construction(Picture& picture, const Curves& parts, int i, const Vec<2>& foot,
                       const Vec<2>& X, double d2) {
  draw_parts(picture, parts, "ABC");
  const Vec<2> Y = X + std::min(d2, 9.0) * (X - foot).normalized();
  const std::string d1 = rounded((X - foot).norm(), 3);
  picture.line(foot, X, {.color = part_color(i), .width = 4});
  picture.line(X, Y, {.color = colors::black, .width = 2, .dash = {8, 5}});
  draw_mark(picture, foot, "X*", part_color(i), {14, 14});
  draw_mark(picture, Y, "Y", colors::black, {14, -14});
  draw_mark(picture, X, "X", colors::black, {14, 12});
  draw_measure(picture, foot, X, "d₁ = " + d1, part_color(i));
  draw_measure(picture, Y, X, "d₂ = " + rounded(d2, 3), colors::black);
}

void draw_profiles(Picture& picture, const Eigen::VectorXd& at,
                   const std::vector<Eigen::MatrixXd>& variants, const std::vector<int>& parts,
                   const std::vector<std::string>& names, double X) {
  draw_panel(picture, {.label = "distance from X* along the ray, m"},
             {.label = "θ", .lower = 0, .upper = 1}, [&](Panel& panel) {
               for (int v = 0; v < int(variants.size()); ++v)
                 for (const int j : parts)
                   if (j >= 0)
                     panel.curve(
                         column(at, 0), column(variants[v], j),
                         line(std::string(1, "ABC"[j]) + ", " + names[v], part_color(j), v));
               panel.vertical(X, "X");
             });
}

void draw_fields(Picture& picture, const Cells& cells, const Curves& parts,
                 const std::vector<std::pair<std::string, Eigen::MatrixXd>>& rows,
                 const std::string& symbol) {
  const double height = 0.94 / double(rows.size());
  for (std::size_t v = 0; v < rows.size(); ++v) {
    const double top = double(v) * height;
    const Eigen::MatrixXd& field = rows[v].second;
    const double width = 0.79 / double(parts.size());
    for (std::size_t j = 0; j < parts.size(); ++j) {
      const double left = 0.2 + double(j) * width;
      picture.set_view(
          cells.box, picture.part({left, top + 0.01}, {left + width - 0.02, top + height - 0.015}));
      draw_cells(picture, cells, [&](int k) { return colors::viridis(field(k, Eigen::Index(j))); });
      for (std::size_t other = 0; other < parts.size(); ++other)
        picture.curve(polyline(parts[other]),
                      {.color = other == j ? part_color(int(j)) : colors::gray,
                       .width = other == j ? 7.0 : 2.0});
    }
    picture.canvas().text(picture.part({0.015, top + height / 2}, {1, 1}).lower, rows[v].first,
                          {.size = 19, .vertical = TextStyle::Vertical::middle});
  }
  color_bar(picture, picture.part({0.015, 0.95}, {1, 1}).lower, symbol + " = 0", "1");
}

void draw_triangle(Picture& picture, const Curves& parts, const Box<2>& world, const Vec<2>& X,
                   const Eigen::Vector3d& w,
                   const std::function<double(const Eigen::Vector3d&)>& value) {
  constexpr int n = 64;
  const auto place = [](const Eigen::Vector3d& v) {
    return Vec<2>(v[1] + v[2] / 2, v[2] * std::sqrt(0.75));
  };
  const auto corner = [](int b, int c) {
    return Eigen::Vector3d(double(n - b - c) / n, double(b) / n, double(c) / n);
  };
  picture.set_view({{-0.1, -0.1}, {1.1, 0.98}}, picture.part({0.36, 0.05}, {1, 1}));
  for (int b = 0; b < n; ++b)
    for (int c = 0; b + c < n; ++c)
      for (int down = 0; down < (b + c < n - 1 ? 2 : 1); ++down) {
        const Eigen::Vector3d v[] = {corner(b + 1, c), corner(b, c + 1),
                                     corner(b + down, c + down)};
        Points<2> points(2, 3);
        for (int k = 0; k < 3; ++k) points.col(k) = place(v[k]);
        picture.fill(points, colors::viridis(value((v[0] + v[1] + v[2]) / 3)));
      }
  for (int j = 0; j < 3; ++j) {
    const std::string name(1, "ABC"[j]);
    picture.label(place(Eigen::Vector3d::Unit(j)), "only " + name, part_color(j),
                  {0, j < 2 ? 20. : -20.}, 20);
    picture.note("w of " + name + " = " + rounded(w[j], 3), 1 + j, part_color(j));
  }
  picture.dot(place(w), colors::white, 22);
  picture.dot(place(w), part_color(1), 15);
  picture.set_view(world, picture.part({0, 0.5}, {0.36, 1}));
  draw_parts(picture, parts, "ABC");
  draw_mark(picture, X, "X", colors::black);
}

void draw_groups(Picture& picture, const Points<2>& points, const std::vector<int>& group) {
  for (int k = 0; k < points.cols(); ++k) {
    const Color color = group[k] < 7 ? part_color(group[k]) : colors::light_gray;
    picture.dot(points.col(k), color, 9, MarkerShape::square);
  }
}

void draw_network(Picture& picture, const Eigen::MatrixXd& score,
                  const std::vector<std::string>& candidates, const std::vector<int>& taken) {
  std::vector<int> shown;
  for (int c = 0; c < int(candidates.size()); ++c)
    if (!candidates[c].empty() && (c < 9 || std::count(taken.begin(), taken.end(), c) > 0))
      shown.push_back(c);
  const int n_left = int(score.rows()), n_right = int(shown.size());
  picture.set_view({{0, 0}, {1.6, 1}}, picture.area());
  const auto left = [&](int i) { return Vec<2>(0.3, 0.95 - 0.9 * i / std::max(1, n_left - 1)); };
  const auto right = [&](int r) { return Vec<2>(1.1, 0.95 - 0.9 * r / std::max(1, n_right - 1)); };
  for (const bool front : {false, true})
    for (int i = 0; i < n_left; ++i)
      for (int r = 0; r < n_right; ++r) {
        if (!(score(i, shown[r]) > 0) || front != (taken[i] == shown[r])) continue;
        const double width = 1 + 9 * score(i, shown[r]) / score(Eigen::all, shown).maxCoeff();
        const Color color = front ? part_color(i) : colors::light_gray;
        picture.line(left(i), right(r), {.color = color, .width = width});
      }
  for (int i = 0; i < n_left; ++i)
    draw_mark(picture, left(i), "part " + std::to_string(i + 1), part_color(i), {-14, 0});
  for (int r = 0; r < n_right; ++r) {
    const bool used = std::count(taken.begin(), taken.end(), shown[r]) > 0;
    const Color color = used ? colors::black : colors::gray;
    draw_mark(picture, right(r), candidates[shown[r]], color, {16, 0});
  }
}

void draw_origins(Picture& picture, const Curves& parts, const std::vector<int>& of_part,
                  const Points<2>& position, const std::vector<std::string>& names) {
  draw_parts(picture, parts, "12345678");
  for (int o = 0; o < position.cols(); ++o) {
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (of_part[i] == o)
        picture.line(position.col(o), polyline(parts[i], 2).col(1),
                     {.color = part_color(int(i)), .width = 3});
    draw_mark(picture, position.col(o), names[o], colors::black, {0, -18});
  }
}

void draw_shares(Picture& picture, const std::vector<Eigen::MatrixXd>& matrices,
                 const std::vector<std::string>& names) {
  const double width = 1 / double(matrices.size());
  for (std::size_t k = 0; k < matrices.size(); ++k) {
    const Eigen::MatrixXd& m = matrices[k];
    const int n = int(m.rows());
    const double left = width * double(k);
    picture.set_view({{-0.7, -1}, {n + 0.3, n + 1.0}},
                     picture.part({left, 0.08}, {left + width, 0.95}));
    for (int i = 0; i < n; ++i) {
      picture.label({i + 0.5, n}, std::to_string(i + 1), part_color(i), {0, -12});
      picture.label({0, n - i - 0.5}, std::to_string(i + 1), part_color(i), {-8, 0});
      for (int j = 0; j < n; ++j) {
        Points<2> square(2, 4);
        square << j, j + 1, j + 1, j, n - i, n - i, n - i - 1, n - i - 1;
        picture.fill(square, colors::mix(colors::white, part_color(j), std::sqrt(m(i, j))));
        picture.curve(square, {.color = colors::light_gray, .width = 1, .closed = true});
      }
    }
    picture.label({n / 2.0, 0}, names[k], colors::black, {0, 24}, 20);
  }
}

void draw_squares(Picture& picture, const Cells& cells, const Points<2>& moved, double size) {
  for (int k = 0; k < moved.cols(); ++k) {
    const Vec<2> at = cells.center.col(k) / size;
    const bool light = (int(std::floor(at[0])) + int(std::floor(at[1]))) % 2 == 0;
    picture.dot(moved.col(k), light ? colors::light_gray : colors::gray, 6, MarkerShape::square);
  }
}

void draw_opinions(Picture& picture, const Points<2>& p, const Eigen::RowVectorXd& Gamma,
                   const Points<2>& opinions, const Vec<2>& x) {
  draw_parts(picture, three_curves(p), "ABC");
  Eigen::VectorXd of_point = Eigen::VectorXd::Zero(9);
  for (int k = 0; k < 12; ++k) of_point[point_of_control(k)] += Gamma[k];
  for (int k = 0; k < 9; ++k) {
    const Color color = of_point[k] > 0 ? blue : red;
    const double width = 40 * std::abs(of_point[k]);
    picture.line(x, p.col(k), {.color = color.with_alpha(0.5), .width = width});
    draw_mark(picture, p.col(k), rounded(of_point[k], 2), color);
  }
  const Vec<2> beside[] = {{-12, -12}, {12, -12}, {12, 12}};
  for (int i = 0; i < 3; ++i)
    draw_mark(picture, opinions.col(i), std::string(1, "ABC"[i]), part_color(i), beside[i]);
  draw_mark(picture, x, "x", colors::black, {0, 22});
  picture.legend({{"x, and what A, B, C make of it", colors::black, MarkerShape::circle},
                  {"width: entries of Γ > 0, joints added", blue},
                  {"entries of Γ < 0", red}},
                 Picture::Corner::lower_left);
}

void draw_forces(Picture& picture, const Points<2>& p, const Points<2>& forces) {
  draw_parts(picture, three_curves(p), "ABC");
  Points<2> sum = Points<2>::Zero(2, 9);
  for (int j = 0; j < 12; ++j) sum.col(point_of_control(j)) += forces.col(j);
  const double scale = 1.2 / std::max(forces.cwiseAbs().maxCoeff(), 1e-12);
  for (int k = 0; k < 9; ++k) {
    picture.dot(p.col(k), colors::gray, 10);
    picture.arrow(p.col(k), scale * sum.col(k), red, 3);
  }
  picture.note("forces −dV/dp on the control points");
}

void draw_walks(Picture& picture, const Points<2>& image, const Points<2>& diffuse,
                const Points<2>& exact) {
  Box<2> box{diffuse.rowwise().minCoeff(), diffuse.rowwise().maxCoeff()};
  box.include(Box<2>{image.rowwise().minCoeff(), image.rowwise().maxCoeff()});
  picture.set_view(box, picture.part({0.1, 0.05}, {0.9, 0.8}));
  picture.curve(image, {.color = colors::light_gray, .width = 10});
  picture.curve(exact, {.color = part_color(0), .width = 3});
  picture.curve(diffuse, {.color = part_color(1), .width = 4});
  draw_mark(picture, image.col(0), "start", colors::black, {-14, 12});
  draw_mark(picture, diffuse.rightCols(1), "end by (12)", part_color(1), {14, -8});
  picture.legend({{"image of the circle", colors::light_gray},
                  {"sum of F dX by (12)", part_color(1)},
                  {"by (12')", part_color(0)}},
                 Picture::Corner::lower_left);
}

void draw_motion(Picture& picture, const Discretization<2>& body,
                 const std::vector<Eigen::VectorXd>& z, double time) {
  constexpr int n = 6;
  const auto color = [](int shot) { return colors::viridis(shot / (n + 0.5)); };
  for (int shot = 0; shot <= n; ++shot)
    draw_body(picture, body, z[shot * (z.size() - 1) / n], color(shot),
              color(shot).with_alpha(0.12));
  picture.legend({{"t = 0", color(0)}, {"t = " + rounded(time, 2) + " s", color(n)}},
                 Picture::Corner::lower_right);
}

void draw_states(Picture& picture, const Discretization<2>& body,
                 const std::vector<std::tuple<std::string, Color, Eigen::VectorXd>>& states) {
  std::vector<Picture::Entry> entries;
  for (const auto& [name, color, z] : states) {
    const bool first = entries.empty();
    draw_body(picture, body, z, color, color.with_alpha(first ? 0.2 : 0.05), first ? 1.5 : 2.5);
    entries.push_back({name, color});
  }
  picture.legend(entries);
}

void draw_mass(Picture& picture, const Discretization<2>& body, const Eigen::MatrixXd& M) {
  picture.note("M, part by part (red > 0, blue < 0), and the size of its row sums");
  const Vec<2> corner = picture.part({0.03, 0.12}, {1, 1}).lower;
  draw_matrix(picture, M, body.boundary.first_control, {corner, corner + Vec<2>(430, 430)});
  picture.set_view({{-0.6, -0.7}, {2.9, 1.7}}, picture.part({0.54, 0.1}, {1, 0.9}));
  draw_body(picture, body, body.unknowns.rest.reshaped(), colors::gray, pale);
  const Eigen::VectorXd sum = M.rowwise().sum();
  const Eigen::VectorXd size = 40 * (sum / sum.maxCoeff()).cwiseAbs().cwiseSqrt();
  for (int i = 0; i < size.size(); ++i)
    picture.dot(body.unknowns.rest.col(i), red.with_alpha(0.6), size[i]);
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
    picture.label({1, 2.0}, name, colors::black, {0, 0});
  }
  picture.note("curves J p (lines) and points x(X) (dots) after the last good step, at most 0.4 s");
}

void draw_displacement(Picture& picture, const Discretization<2>& body, const Eigen::VectorXd& u) {
  const Eigen::VectorXd rest = body.unknowns.rest.reshaped();
  picture.set_view({{-1, -0.9}, {3.1, 2.1}}, picture.part({0.57, 0.1}, {1, 0.95}));
  picture.canvas().text(picture.part({0.58, 0.06}, {1, 1}).lower, "a soft motion: curve, points",
                        {.size = Picture::text_size});
  draw_body(picture, body, rest, colors::gray, pale);
  draw_body(picture, body, rest + u, red, red.with_alpha(0));
  const Points<2> X = body.quadrature.position, x = evaluate(body.interior, rest + u);
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
  picture.legend({{"the map x(X(u))", blue},
                  {"the curve J(u) p", colors::gray},
                  {"springs, red: most energy", red}},
                 Picture::Corner::lower_left);
}

void draw_weights(Picture& picture, const Discretization<2>& body,
                  const std::vector<Color>& part_colors) {
  const auto& weights = body.weights;
  for (int k = 0; k < body.quadrature.size(); ++k) {
    Color mixed{0, 0, 0};
    double sum = 0;
    for (int e = weights.begin[k]; e < weights.begin[k + 1]; ++e) {
      sum += weights.w[e];
      mixed = colors::mix(mixed, part_colors[weights.part[e]], weights.w[e] / sum);
    }
    picture.dot(body.quadrature.position.col(k), mixed, 12);
  }
  const Outline outline(body);
  for (int i = 0; i < outline.n_parts(); ++i)
    picture.canvas().stroke(picture.view().map(outline.part(i, body.unknowns.rest)),
                            {.color = part_colors[i], .width = 5});
}

}  // namespace sem::tutorial
