// The draft's figure 4: what the distance weight of one curve is made of, by the draft and as
// published.
#include "figures/blob.h"
#include "figures/interior.h"
#include "sem/base/error.h"

namespace sem::figures {
namespace {

constexpr int green = 2;
constexpr int n_on_ray = 200;

// The pair of the point and the green curve; theta is 0 if it is not listed.
struct Pair {
  Vec<2> foot;
  double closest, reach, theta;
};
Pair measure(const Discretization<2>& body, const Vec<2>& X, DistanceWeight variant) {
  const auto distances =
      measure_distances<2>(body.boundary, body.loops, X, variant, body.options.weights.cutoff);
  for (size_t k = 0; k < distances.part.size(); ++k)
    if (distances.part[k] == green)
      return {distances.foot[k], distances.closest[k], distances.reach[k],
              theta_field(body, X, variant)(0, green)};
  throw InputError("", "point", "out of the green curve's reach", "a point in its reach");
}

Data compute() {
  const auto body = builtin_body("blob");
  const Vec<2> X(1.18, 0.7);
  const Pair published = measure(body, X, DistanceWeight::published);
  const Pair draft = measure(body, X, DistanceWeight::draft);
  Data data;
  add_curves(data, body.boundary);
  const Vec<2> direction = (X - published.foot) / published.closest;
  const Vec<2> hit = published.foot + published.reach * direction;
  auto& points = data.add("points", {"x", "y"});  // X, its closest point X*, the hit of the ray
  for (const Vec<2>& at : {X, published.foot, hit}) points.add({at[0], at[1]});
  data.add("values", {"alpha", "d1", "d", "theta_published", "theta_draft"})
      .add({body.options.weights.cutoff, published.closest, published.reach, published.theta,
            draft.theta});
  Points<2> on_ray(2, n_on_ray - 1);
  for (int k = 1; k < n_on_ray; ++k)
    on_ray.col(k - 1) = published.foot + published.reach * k / n_on_ray * direction;
  const Eigen::VectorXd theta[] = {theta_field(body, on_ray, DistanceWeight::draft).col(green),
                                   theta_field(body, on_ray, DistanceWeight::published).col(green)};
  auto& profile = data.add("profile", {"distance", "theta_draft", "theta_published"});
  for (int k = 1; k < n_on_ray; ++k)
    profile.add({published.reach * k / n_on_ray, theta[0][k - 1], theta[1][k - 1]});
  return data;
}

// A dimension line from a to b, `offset` points to the left of the way (right if negative), with
// its text at a share of the way.
void dimension(Panel& panel, const Vec<2>& a, const Vec<2>& b, double offset,
               const std::string& text, const Color& color, double share = 0.5) {
  panel.draw([=](const Pen& pen) {
    const Vec<2> from = pen.map(a), to = pen.map(b);
    const Vec<2> along = (to - from).normalized(), left(along[1], -along[0]);
    const Vec<2> shift = offset * pen.point * left, half_tick = 2.5 * pen.point * left;
    const Stroke thin = pen.stroke(color, 0.9);
    pen.canvas.line(from + shift, to + shift, thin);
    for (const Vec<2>& end : {from, to})
      pen.canvas.line(end + shift - half_tick, end + shift + half_tick, thin);
    const double side = offset > 0 ? 1 : -1;
    TextStyle style = pen.text();
    style.color = color;
    pen.canvas.text(from + share * (to - from) + shift + side * 8 * pen.point * left, text, style);
  });
}

Series draft_style() {
  return {.label = "draft", .color = colors::okabe_ito[3], .width = 1.4, .dash = {4, 2}};
}
Series published_style() { return {.label = "published", .color = colors::black, .width = 1.4}; }

void draw_construction(Panel& panel, const Data& data, bool draft) {
  panel.equal = true;
  panel.frame = false;
  const auto points = zip(data["points"]["x"], data["points"]["y"]);
  const Vec<2>&X = points[0], &foot = points[1], &hit = points[2];
  const DataTable& values = data["values"];
  const Color color = draft ? draft_style().color : published_style().color;
  panel.title = draft ? "draft (eq. 25)" : "published";
  panel.curve({foot, hit}, {.width = 0.8, .dash = {3, 2}});
  draw_parts(panel, data, green);
  panel.curve(points, {.width = 0, .marker = MarkerShape::circle, .marker_size = 4.5});
  dimension(panel, foot, X, -9, "d₁", color);
  if (draft)
    dimension(panel, X, hit, -9, "d₂", color);
  else
    dimension(panel, foot, hit, 17, "d", color, 0.68);
  panel.note(X, "X", {.offset = {-4, 6}});
  panel.note(foot, "X*", {.offset = {-4, -9}});
  const double d1 = values.value("d1"), d = values.value("d");
  const std::string last = draft ? "d₂ = " + number_text(d - d1) : "d = " + number_text(d);
  panel.lines_below = {"d₁ = " + number_text(d1) + " m,  " + last +
                           " m,  α = " + number_text(values.value("alpha")) + " m",
                       std::string("θ = 1 − d₁ / min(") + (draft ? "d₂" : "d") + ", α) = " +
                           number_text(values.value(draft ? "theta_draft" : "theta_published"))};
}

void draw_profile(Panel& panel, const Data& data) {
  const DataTable &profile = data["profile"], &values = data["values"];
  panel.title = "along the ray";
  panel.x = {.label = "distance from X* (m)", .lower = 0, .upper = values.value("d")};
  panel.y = {.label = "θ of the green curve", .lower = 0, .upper = 1};
  const auto line = [&](const std::string& column, const Series& style) {
    panel.curve(profile["distance"], profile[column], style);
    panel.curve(
        {values.value("d1")}, {values.value(column)},
        {.color = style.color, .width = 0, .marker = MarkerShape::circle, .marker_size = 4.5});
  };
  line("theta_published", published_style());
  line("theta_draft", draft_style());
  panel.vertical(values.value("d1"), "", {.color = colors::gray, .width = 0.6});
  panel.note({values.value("d1"), 1}, "X", {.offset = {-6, -8}, .color = colors::gray});
  // Where theta jumps upward another point of the curve becomes the closest.
  const auto& theta = profile["theta_published"];
  int jump = 0;
  for (int k = 1; k + 1 < profile.n_rows(); ++k)
    if (theta[k + 1] - theta[k] > theta[jump + 1] - theta[jump]) jump = k;
  panel.note({profile["distance"][jump], theta[jump + 1]}, "X* jumps",
             {.offset = {4, 12}, .leader = true});
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.column_shares = {1, 1, 1.1};
  draw_construction(plot.panel(0, 0), data, true);
  draw_construction(plot.panel(0, 1), data, false);
  draw_profile(plot.panel(0, 2), data);
}

}  // namespace

Figure distance_construction() {
  return {
      "distance_construction",
      "Draft figure 4: the distances that make theta of the green curve at X; along the ray the "
      "draft's theta vanishes midway, the published one at the far side, and both jump with X*",
      7,
      2.9,
      compute,
      draw};
}

}  // namespace sem::figures
