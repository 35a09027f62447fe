// The draft's figure 4: what the distance weight of one curve at one point is made of.
#include "figures/blob.h"
#include "sem/base/error.h"
#include "sem/draw/view.h"

namespace sem::figures {
namespace {

// What a row of the data is. Values: curve: its part; the point X: the cutoff alpha; its closest
// point X* on the green curve: d1; the hit of the ray: d_total; theta: the published and, in x, the
// draft's.
constexpr double curve = 0, point_X = 1, foot = 2, hit = 3, theta = 4;
constexpr int green = 2;

// The pair of the point and the green curve; theta is 0 if it is not listed.
struct Pair {
  Vec<2> foot;
  double closest, reach, theta;
};
Pair measure(const Discretization<2>& body, const Vec<2>& X, DistanceWeight variant) {
  WeightOptions options = body.options.weights;
  options.variant = variant;
  const auto distances =
      measure_distances<2>(body.boundary, body.loops, X, variant, options.cutoff);
  const auto weights = distance_weights(distances, options);
  for (size_t k = 0; k < distances.part.size(); ++k) {
    if (distances.part[k] != green) continue;
    Pair pair{distances.foot[k], distances.closest[k], distances.reach[k], 0};
    for (size_t e = 0; e < weights.part.size(); ++e)
      if (weights.part[e] == green) pair.theta = weights.theta[e];
    return pair;
  }
  throw InputError("", "point", "out of the green curve's reach", "a point in its reach");
}

Data compute() {
  const auto body = builtin_body("blob");
  const Vec<2> X(1.18, 0.7);
  const Pair published = measure(body, X, DistanceWeight::published);
  const Pair draft = measure(body, X, DistanceWeight::draft);
  Data data{{"kind", "x", "y", "value"}, {}};
  for (const auto& [part, x, y] : part_points(body.boundary))
    data.rows.push_back({curve, x, y, part});
  const Vec<2> direction = (X - published.foot) / published.closest;
  const Vec<2> end = published.foot + published.reach * direction;
  data.rows.push_back({point_X, X[0], X[1], body.options.weights.cutoff});
  data.rows.push_back({foot, published.foot[0], published.foot[1], published.closest});
  data.rows.push_back({hit, end[0], end[1], published.reach});
  data.rows.push_back({theta, draft.theta, 0, published.theta});
  return data;
}

// A dimension line beside the segment a-b, `offset` to the right of the way from a to b, with its
// text.
void dimension(Canvas& canvas, const Vec<2>& a, const Vec<2>& b, double offset,
               const std::string& text) {
  const Vec<2> along = (b - a).normalized(), across = Vec<2>(-along[1], along[0]);
  const Stroke thin{.width = 0.6 * point};
  const Vec<2> shift = offset * across, half_tick = 2.5 * point * across;
  canvas.line(a + shift, b + shift, thin);
  for (const Vec<2>& end : {a, b})
    canvas.line(end + shift - half_tick, end + shift + half_tick, thin);
  const double side = offset > 0 ? 1 : -1;
  canvas.text((a + b) / 2 + shift + side * 8 * point * across, text,
              {.size = text_size,
               .horizontal = TextStyle::Horizontal::center,
               .vertical = TextStyle::Vertical::middle});
}

void draw(Canvas& canvas, const Data& data) {
  Box<2> world;
  for (const auto& row : data.where("kind", curve).rows) world.include(Vec<2>(row[1], row[2]));
  const View2 view(world, {Vec<2>(8 * point, 8 * point),
                           Vec<2>(canvas.width() - 8 * point, canvas.height() - 38 * point)});
  const auto row = [&](double kind) { return data.where("kind", kind).rows[0]; };
  const auto at = [&](double kind) { return view.map({row(kind)[1], row(kind)[2]}); };
  const Vec<2> X = at(point_X), start = at(foot), end = at(hit);
  const double alpha = row(point_X)[3], d1 = row(foot)[3], d_total = row(hit)[3];
  canvas.line(start, end, {.width = 0.8 * point, .dash = {3 * point, 2 * point}});
  draw_parts(canvas, view, data.where("kind", curve), "value", green);
  for (const Vec<2>& marked : {X, start, end})
    canvas.marker(marked, MarkerShape::circle, 5 * point, colors::black);
  dimension(canvas, start, X, -8 * point, "d₁");
  dimension(canvas, X, end, -8 * point, "d₂");
  dimension(canvas, start, end, 18 * point, "d");
  const TextStyle label{.size = text_size, .vertical = TextStyle::Vertical::middle};
  canvas.text(X + Vec<2>(6, 5) * point, "X", label);
  canvas.text(start + Vec<2>(-16, 10) * point, "X*", label);
  char text[96];
  std::snprintf(text, sizeof text, "published: θ = 1 − d₁ / min(d, α) = %.2f", row(theta)[3]);
  canvas.text({10 * point, canvas.height() - 26 * point}, text, label);
  std::snprintf(text, sizeof text, "draft (eq. 25): θ = 1 − d₁ / min(d₂, α) = %.2f", row(theta)[1]);
  canvas.text({10 * point, canvas.height() - 14 * point}, text, label);
  const std::pair<const char*, double> lengths[] = {{"d₁ = %.2f m", d1},
                                                    {"d₂ = %.2f m", d_total - d1},
                                                    {"d = %.2f m", d_total},
                                                    {"α = %.2f m", alpha}};
  double y = 14 * point;
  for (const auto& [format, value] : lengths) {
    std::snprintf(text, sizeof text, format, value);
    canvas.text({10 * point, y}, text, label);
    y += 11 * point;
  }
}

}  // namespace

Figure distance_construction() {
  return {"distance_construction",
          "Draft figure 4: the distances that make theta of the green curve",
          3.3,
          3.5,
          compute,
          draw};
}

}  // namespace sem::figures
