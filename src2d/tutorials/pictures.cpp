#include "src2d/tutorials/pictures.h"

#include <algorithm>
#include <cmath>

#include "sem/draw/image.h"
#include "sem/lesson/numbers.h"
#include "sem/lesson/part_canvas.h"
#include "sem/lesson/plots.h"
#include "sem/picture/scales.h"
#include "src2d/picture/frame.h"
#include "src2d/picture/outline.h"

namespace sem::tutorial {

void draw_boundary(Picture& picture, const Boundary<2>& boundary) {
  for (const auto& part : boundary.parts)
    picture.curve(polyline(part.nurbs), {.color = blue, .width = 3.5});
}

void draw_ray(Picture& picture, const Box<2>& box, int axis, double height,
              const std::vector<RayHit>& hits, const std::vector<RayInterval>& inside,
              double width) {
  const auto at = [&](double t) { return axis == 0 ? Vec<2>(t, height) : Vec<2>(height, t); };
  picture.line(at(box.lower[axis]), at(box.upper[axis]),
               {.color = hits.empty() ? red : colors::gray, .dash = {6, 5}});
  for (const auto& i : inside)
    picture.line(at(i.begin), at(i.end), {.color = green, .width = width});
  for (const auto& h : hits)
    picture.dot(at(h.t), colors::black, 6 + width,
                h.crosses ? MarkerShape::circle : MarkerShape::cross);
}

void draw_function(Picture& picture, const Box<2>& square, const std::string& name, bool pale,
                   const std::function<double(const Vec<2>&)>& f) {
  constexpr int n = 60;
  Image image(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Color color = colors::diverging(0.5 + f(Vec<2>(2 * i + 1 - n, n - 2 * j - 1) / n) / 2);
      image.set(i, j, pale ? colors::mix(colors::white, color, 0.15) : color);
    }
  picture.canvas().image(image, square);
  picture.canvas().text(square.lower - Vec<2>(0, 7), name,
                        {.size = 18, .color = pale ? colors::gray : colors::black});
  picture.hover(square, [=](const Vec<2>& pixel) {
    const Vec<2> half = (square.upper - square.lower) / 2, d = pixel - square.lower - half,
                 X = d.cwiseQuotient(Vec<2>(half[0], -half[1]));
    return name + " = " + rounded(f(X), 3) + " at " + coordinates(X);
  });
}

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
  std::vector<Trace> curves;
  const auto content = [&](Panel& panel) {
    for (int v = 0; v < int(variants.size()); ++v)
      for (const int j : parts)
        if (j >= 0) {
          curves.push_back(
              {std::string(1, "ABC"[j]) + ", " + names[v], column(at, 0), column(variants[v], j)});
          panel.curve(curves.back().x, curves.back().y,
                      line(curves.back().label, part_color(j), v));
        }
    panel.vertical(X, "X");
  };
  draw_panel(picture, {.label = "distance from X* along the ray, m"},
             {.label = "θ", .lower = 0, .upper = 1}, content, curves);
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
      draw_field(picture, cells, field.col(Eigen::Index(j)),
                 rows[v].first + "\n" + symbol + " of " + "ABC"[j]);
      for (std::size_t other = 0; other < parts.size(); ++other)
        picture.curve(polyline(parts[other]),
                      {.color = other == j ? part_color(int(j)) : colors::gray,
                       .width = other == j ? 7.0 : 2.0});
    }
    picture.canvas().text(picture.part({0.015, top + height / 2}, {1, 1}).lower, rows[v].first,
                          {.size = 19, .vertical = TextStyle::Vertical::middle});
  }
  color_bar(picture, symbol + " = 0", "1", picture.part({0.015, 0.95}, {1, 1}).lower);
}

void draw_triangle(Picture& picture, const Curves& parts, const Box<2>& world, const Vec<2>& X,
                   const Eigen::Vector3d& w, const TriangleValue& value) {
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
        picture.fill(points, colors::viridis(value((v[0] + v[1] + v[2]) / 3).first));
      }
  for (int j = 0; j < 3; ++j) {
    const std::string name(1, "ABC"[j]);
    picture.label(place(Eigen::Vector3d::Unit(j)), "only " + name, part_color(j),
                  {0, j < 2 ? 20. : -20.}, 20);
    picture.note("w of " + name + " = " + rounded(w[j], 3), 1 + j, part_color(j));
  }
  picture.hover([value](const Vec<2>& at) -> std::string {
    const double c = at[1] / std::sqrt(0.75), b = at[0] - c / 2;
    const Eigen::Vector3d v(1 - b - c, b, c);
    return v.minCoeff() < 0 ? "" : "w = " + list(v, 2) + "\n" + value(v).second;
  });
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
  const auto left = [=](int i) { return Vec<2>(0.3, 0.95 - 0.9 * i / std::max(1, n_left - 1)); };
  const auto right = [=](int r) { return Vec<2>(1.1, 0.95 - 0.9 * r / std::max(1, n_right - 1)); };
  for (const bool front : {false, true})
    for (int i = 0; i < n_left; ++i)
      for (int r = 0; r < n_right; ++r) {
        if (!(score(i, shown[r]) > 0) || front != (taken[i] == shown[r])) continue;
        const double width = 1 + 9 * score(i, shown[r]) / score(Eigen::all, shown).maxCoeff();
        const Color color = front ? part_color(i) : colors::light_gray;
        picture.line(left(i), right(r), {.color = color, .width = width});
      }
  picture.hover([=, names = candidates](const Vec<2>& at) {  // the line that is nearest there
    double least = 0.03;
    std::string text;
    for (int i = 0; i < n_left; ++i)
      for (int r = 0; r < n_right; ++r) {
        const double s = std::clamp((at[0] - 0.3) / 0.8, 0.0, 1.0);
        const double distance = (left(i) + s * (right(r) - left(i)) - at).norm();
        if (!(score(i, shown[r]) > 0) || distance > least) continue;
        least = distance;
        text = "part " + std::to_string(i + 1) + ", " + names[shown[r]] + "\nscore " +
               rounded(score(i, shown[r]), 3) + " m²" + (taken[i] == shown[r] ? ", taken" : "");
      }
    return text;
  });
  for (int i = 0; i < n_left; ++i)
    draw_mark(picture, left(i), "part " + std::to_string(i + 1), part_color(i), {-14, 0});
  for (int r = 0; r < n_right; ++r) {
    const bool used = std::count(taken.begin(), taken.end(), shown[r]) > 0;
    const Color color = used ? colors::black : colors::gray;
    draw_mark(picture, right(r), candidates[shown[r]], color, {16, 0});
  }
}

std::string text(const std::vector<int>& set) {
  std::string list;
  for (const int i : set) list += (list.empty() ? "" : " ") + std::to_string(i + 1);
  return "{" + list + "}";
}

void draw_origins(Picture& picture, const Curves& parts, const Origins<2>& origins) {
  draw_parts(picture, parts, "12345678");
  std::vector<std::string> names;
  for (int o = 0; o < origins.position.cols(); ++o) {
    const Vec<2> at = origins.position.col(o);
    names.push_back(text(origins.members[o]) + " at " + coordinates(at) + "\norigin of");
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (origins.of_part[i] != o) continue;
      picture.line(at, polyline(parts[i], 2).col(1), {.color = part_color(int(i)), .width = 3});
      names.back() += " " + std::to_string(i + 1);
    }
    draw_mark(picture, at, text(origins.members[o]), colors::black, {0, -18});
  }
  picture.hover(origins.position, [=](int o) { return names[o]; });
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
    const Vec<2> a = picture.view().map(Vec<2>(0, n)), b = picture.view().map(Vec<2>(n, 0));
    read_matrix(picture, m, {a, b}, "share");
  }
}

void draw_squares(Picture& picture, const Cells& cells, const Points<2>& moved, double size) {
  const double dot = std::max(6.0, 0.9 * cells.size * picture.view().scale());  // pixels
  for (int k = 0; k < moved.cols(); ++k) {
    const Vec<2> at = cells.center.col(k) / size;
    const bool light = (int(std::floor(at[0])) + int(std::floor(at[1]))) % 2 == 0;
    picture.dot(moved.col(k), light ? colors::light_gray : colors::gray, dot, MarkerShape::square);
  }
  read_motion(picture, cells.center, moved);
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
  picture.hover([=](const Vec<2>& at) {
    const int k = nearest(p, at);
    return (p.col(k) - at).norm() > 0.2
               ? ""
               : "p" + std::to_string(k + 1) + ": Γ = " + rounded(of_point[k], 3);
  });
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
    picture.arrow(p.col(k), scale * sum.col(k), colors::black, 3);
  }
  picture.note("forces −dV/dp on the control points");
  picture.hover(p, [=](int k) {
    return "force on p" + std::to_string(k + 1) + ": " + coordinates(sum.col(k));
  });
}

void draw_walks(Picture& picture, const Points<2>& image, const Points<2>& diffuse,
                const Points<2>& exact) {
  Box<2> box{diffuse.rowwise().minCoeff(), diffuse.rowwise().maxCoeff()};
  box.include(Box<2>{image.rowwise().minCoeff(), image.rowwise().maxCoeff()});
  picture.set_view(box, picture.part({0.1, 0.05}, {0.9, 0.8}));
  picture.curve(image, {.color = colors::light_gray, .width = 10});
  picture.curve(exact, {.color = part_color(0), .width = 3});
  picture.curve(diffuse, {.color = part_color(1), .width = 4});
  picture.hover(diffuse, [=](int k) {
    const auto off = [&](const Points<2>& walk) {
      return rounded((walk.col(k) - image.col(k)).norm(), 2) + " m";
    };
    return rounded(100.0 * k / double(image.cols() - 1), 3) + " % of the way\n(12) is off by " +
           off(diffuse) + "\n(12') is off by " + off(exact);
  });
  draw_mark(picture, image.col(0), "start", colors::black, {-14, 12});
  draw_mark(picture, diffuse.rightCols(1), "end by (12)", part_color(1), {14, -8});
  picture.legend({{"image of the circle", colors::light_gray},
                  {"sum of F dX by (12)", part_color(1)},
                  {"by (12')", part_color(0)}},
                 Picture::Corner::lower_left);
}

void draw_frame(Picture& picture, const Scene<2>& scene, const Model<2>& model,
                const State& state) {
  PartCanvas part(picture.canvas(), picture.area());
  FramePainter(scene).draw(part, model, state);
  picture.set_view(view_box(scene, model), part.moved(FramePainter::area(part)));
  read_values(picture, evaluate(model.discretization.interior, state.z), von_mises(model, state.z),
              "von Mises stress, Pa");
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
  const Eigen::MatrixXd w = dense(weights);
  picture.hover(body.quadrature.position, [=, v = body.quadrature.weight](int k) {
    return "w = " + list(w.row(k).transpose(), 3) + "\nv = " + rounded(v[k], 3) + " m²";
  });
  const Outline outline(body);
  for (int i = 0; i < outline.n_parts(); ++i)
    picture.canvas().stroke(picture.view().map(outline.part(i, body.unknowns.rest)),
                            {.color = part_colors[i], .width = 5});
}

}  // namespace sem::tutorial
