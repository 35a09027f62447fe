// Frames: what their pixels show, and that they depend on nothing but scene and state.
#include <doctest/doctest.h>

#include <algorithm>

#include "builtin.h"
#include "sem/draw/raster.h"
#include "sem/draw/view.h"
#include "sem/picture/scales.h"
#include "sem/scene/analysis.h"
#include "src2d/picture/frame.h"

using namespace sem;
using sem::test::Body;

namespace {

const Mat<2> identity = Mat<2>::Identity();

Image frame(FramePainter& painter, const Body& body, const State& state) {
  RasterCanvas canvas(400, 300, 1);
  painter.draw(canvas, *body.model, state);
  return canvas.finish();
}

Image frame(const Body& body, const State& state) {
  FramePainter painter(body.scene);
  return frame(painter, body, state);
}

Box<2> area() { return FramePainter::area(RasterCanvas(400, 300, 1)); }

// Pixels that differ, by region of the picture.
struct Difference {
  int inside = 0, above = 0, elsewhere = 0;  // of the world's area; above it; around it otherwise
};

Difference compare(const Image& a, const Image& b) {
  Difference difference;
  const Box<2> world = area();
  for (int row = 0; row < a.height; ++row)
    for (int column = 0; column < a.width; ++column) {
      if (std::equal(a.pixel(column, row), a.pixel(column, row) + 3, b.pixel(column, row)))
        continue;
      const Vec<2> at(column + 0.5, row + 0.5);
      // The frame line is one pixel wide at most.
      if (((at - world.lower).array() > -1).all() && ((world.upper - at).array() > -1).all())
        ++difference.inside;
      else
        ++(at[1] < world.lower[1] ? difference.above : difference.elsewhere);
    }
  return difference;
}

// The pixels of a square in the world: its darkest and its brightest value of red, green and blue.
struct Brightness {
  int darkest = 255;
  std::array<int, 3> brightest = {0, 0, 0};
};

Brightness look(const Image& image, const Body& body, const Vec<2>& center, double half) {
  const View2 view(view_box(body.scene, *body.model), area());
  const Vec<2> a = view.map({center[0] - half, center[1] + half});
  const Vec<2> b = view.map({center[0] + half, center[1] - half});
  Brightness range;
  for (int row = int(std::ceil(a[1])); row < int(b[1]); ++row)
    for (int column = int(std::ceil(a[0])); column < int(b[0]); ++column)
      for (int i = 0; i < 3; ++i) {
        const int value = image.pixel(column, row)[i];
        range.darkest = std::min(range.darkest, value);
        range.brightest[i] = std::max(range.brightest[i], value);
      }
  return range;
}

}  // namespace

TEST_CASE("the same state gives the same pixels, whatever was drawn before") {
  const Body body("blob");
  const State still = body.moved(identity, {0, 0});
  Mat<2> stretch;
  stretch << 1.3, 0.2, 0, 0.8;
  const State later = body.moved(stretch, {0.3, -0.4}, 0.7);
  FramePainter painter(body.scene);
  frame(painter, body, still);
  const Image second = frame(painter, body, later);
  CHECK(second.rgb == frame(body, later).rgb);
  CHECK(second.rgb != frame(body, still).rgb);
}

TEST_CASE("a hole stays empty, the material around it does not") {
  const Body ring("annulus");
  const Image image = frame(ring, ring.model->initial);
  // Within the square in the hole there are hairlines of the axes, but no tint.
  CHECK(look(image, ring, {0, 0}, 0.5).darkest >= 225);
  CHECK(look(image, ring, {1.06, 1.06}, 0.3).darkest < 150);
}

TEST_CASE("where two solids overlap, both tints are seen") {
  const Body discs("two_discs");
  const Image image = frame(discs, discs.model->initial);
  const auto first = look(image, discs, {-0.3, 0.3}, 0.15).brightest;
  const auto second = look(image, discs, {1.6, 0.3}, 0.15).brightest;
  const auto both = look(image, discs, {0.75, 0.2}, 0.15).brightest;
  // The second solid's tint, of some opacity, on white or on the first.
  for (int i = 0; i < 3; ++i) {
    CAPTURE(i);
    CHECK(both[i] == doctest::Approx(second[i] - 0.4 * (255 - first[i])).epsilon(0.015));
    CHECK(both[i] < second[i] - 5);
  }
}

TEST_CASE("a body that has left the view leaves no trace outside of the world's area") {
  const Body body("blob");
  const Image at_rest = frame(body, body.model->initial);
  for (const Vec<2>& shift : {Vec<2>(2.2, 0), Vec<2>(0, 1.5), Vec<2>(-1.5, -1.5), Vec<2>(90, 90)}) {
    CAPTURE(shift);
    const Difference change = compare(at_rest, frame(body, body.moved(identity, shift)));
    CHECK(change.inside > 100);
    CHECK(change.above == 0);
    CHECK(change.elsewhere == 0);
  }
}

TEST_CASE("the time is written above the world and nowhere else") {
  const Body body("blob");
  const Difference change = compare(frame(body, body.moved(identity, {0, 0}, 0.5)),
                                    frame(body, body.moved(identity, {0, 0}, 1.25)));
  CHECK(change.above > 10);
  CHECK(change.inside == 0);
  CHECK(change.elsewhere == 0);
}

TEST_CASE("an inverted body is drawn, gray, with a warning above it") {
  const Body body("disc");
  Mat<2> mirror;
  mirror << -1, 0, 0, 1;
  const State state = body.moved(mirror, {0, 0});
  CHECK(von_mises(*body.model, state.z).array().isNaN().all());
  const Image image = frame(body, state);
  CHECK(compare(frame(body, body.model->initial), image).above > 50);
  // viridis is never gray; the tint's brightest value is far from it.
  const Brightness seen = look(image, body, {0, 0}, 0.5);
  CHECK(seen.darkest >= 120);
}

TEST_CASE("the colour scale and the view follow from the scene: no stress, no scale of its own") {
  // A body in free fall has no stress, neither has one that only drifts.
  const Body drifting("disc", {"initial.angular_velocity=0", "gravity=[0,-10]"});
  const double weight = 100 * 10;  // density times gravity times radius
  CHECK(expected_stress(*drifting.model) < 1e-5 * weight);
  const Body spinning("disc");
  CHECK(expected_stress(*spinning.model) > 100);
}

TEST_CASE("the stress expected is twice what 2 % of the points exceed in the linear answer") {
  Scene<2> scene = test::builtin("cantilever");
  scene.solids[0].material.model = MaterialModel::linear;
  const Body bar(scene);
  State state = bar.model->initial;
  const auto report = equilibrium(bar.model->system, scene.analysis, bar.model->target, state);
  REQUIRE(report.status == Status::converged);
  Eigen::VectorXd stress = von_mises(*bar.model, state.z);
  std::sort(stress.begin(), stress.end());
  const double twice_exceeded = 2 * stress[Eigen::Index(0.98 * double(stress.size() - 1))];
  CHECK(twice_exceeded > 1000);
  CHECK(expected_stress(*bar.model) == doctest::Approx(twice_exceeded).epsilon(1e-3));
}

TEST_CASE("the view holds the way of a free body, and a swing about a point") {
  const Body disc("disc");
  const Box<2> flight = view_box(disc.scene, *disc.model);
  CHECK(flight.lower[0] < -1);
  CHECK(flight.upper[0] > 1 + 0.5 * 2);  // drifts at 0.5 m/s for 2 s
  const Body square("square");
  const Box<2> swing = view_box(square.scene, *square.model);
  const double reach = 2 * std::sqrt(2.0);  // from the corner (0, 2) to (2, 0)
  CHECK(swing.lower[0] < -reach);
  CHECK(swing.lower[1] < 2 - reach);
  CHECK(swing.upper[1] < 3);
  const Body given("square", {"output.view={\"lower\":[-7,-3],\"upper\":[1,4]}"});
  CHECK(view_box(given.scene, *given.model).lower == Vec<2>(-7, -3));
}
