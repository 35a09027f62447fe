// Pictures against closed forms: where pixels are, how light they are.
#include <doctest/doctest.h>

#include <cmath>

#include "sem/base/error.h"
#include "sem/draw/offscreen.h"
#include "solids3d.h"
#include "src3d/render/gl.h"
#include "src3d/render/renderer.h"

using namespace sem;
using namespace sem::render;

namespace {

Renderer& renderer() {
  static Renderer instance;
  return instance;
}

const Box<2> whole{Vec<2>(0, 0), Vec<2>(200, 150)};

RenderOptions small() {
  RenderOptions options = frame_quality(200, 150);
  options.occlusion_step = 1;
  options.lighting.gloss = 0;
  return options;
}

double linear(int value) {
  const double c = value / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// Linear light of the pixel that shows the point.
double light_at(const Image& image, const Camera& camera, const Vec<3>& X, int component = 0) {
  const Vec<2> at = camera.project(X);
  return linear(image.pixel(int(at[0]), int(at[1]))[component]);
}

Mesh ink(const Color& color) {
  Mesh like;
  like.color = color;
  like.lit = false;
  return like;
}

double darkness(const Image& image) {
  double sum = 0;
  for (std::size_t k = 0; k < image.rgb.size(); k += 3) sum += 1 - image.rgb[k] / 255.0;
  return sum;
}

Mesh white_albedo() {
  Mesh like;
  like.color = colors::white;
  return like;
}

RenderScene ball_scene() {
  RenderScene scene;
  test::add(scene, test::ball_with_poles(1), white_albedo());
  return scene;
}

Camera ball_camera(const ViewDirection& direction = {.field_of_view = 0}) {
  return framing(corners({Vec<3>(-1, -1, -1), Vec<3>(1, 1, 1)}), direction, whole);
}

}  // namespace

TEST_CASE("a ball covers the area of its disc in parallel projection, an ellipse in perspective") {
  RenderScene scene;
  test::add(scene, test::ball_with_poles(1), ink(colors::black), 3e-4);
  auto options = small();
  options.supersample = 4;
  Camera camera = ball_camera();
  CHECK(darkness(renderer().render(scene, camera, options)) ==
        doctest::Approx(M_PI * camera.focal * camera.focal).epsilon(2e-3));
  camera = ball_camera({.field_of_view = 50});
  camera.center = {100, 75};
  camera.eye = 3 * camera.back;
  camera.focal = 150;
  // The disc of tangents: tan of the half angle is 1 / sqrt(d^2 - 1).
  CHECK(darkness(renderer().render(scene, camera, options)) ==
        doctest::Approx(M_PI * 150 * 150 / 8.0).epsilon(2e-3));
}

TEST_CASE("key light on a ball is the cosine to the exact normal") {
  auto options = small();
  options.lighting.ambient = 0;
  options.lighting.key = 0.8;
  options.lighting.key_radius = 0;
  options.lighting.n_key = 1;
  options.lighting.n_ambient = 0;
  const Vec<3> key = Vec<3>(-0.3, -0.8, 0.6).normalized();
  options.lighting.key_direction = key;
  options.shadow_size = 512;
  const Camera camera = ball_camera();
  const Image image = renderer().render(ball_scene(), camera, options);
  int n_compared = 0;
  for (double a = -1; a <= 1; a += 0.1)
    for (double b = -1; b <= 1; b += 0.1) {
      if (a * a + b * b > 0.9) continue;
      const Vec<2> pixel = camera.project(a * camera.right + b * camera.up).array().floor() + 0.5;
      const Vec<2> ab = (pixel - camera.center).cwiseProduct(Vec<2>(1, -1)) / camera.focal;
      const Vec<3> n =
          ab[0] * camera.right + ab[1] * camera.up + std::sqrt(1 - ab.squaredNorm()) * camera.back;
      if (n.dot(key) < 0.15 && n.dot(key) > 0) continue;  // the shadow map's own edge
      CAPTURE(a);
      CAPTURE(b);
      ++n_compared;
      CHECK(linear(image.pixel(int(pixel[0]), int(pixel[1]))[0]) ==
            doctest::Approx(0.8 * std::max(n.dot(key), 0.0)).epsilon(0.01).scale(0.8));
    }
  CHECK(n_compared > 200);
}

TEST_CASE("light of the sky on a convex body follows from its normal alone") {
  auto options = small();
  options.lighting.key = 0;
  options.lighting.n_key = 0;
  options.lighting.n_ambient = 96;
  options.lighting.ambient = 0.9;
  options.lighting.from_below = 0.4;
  const Camera camera = ball_camera();
  const Image image = renderer().render(ball_scene(), camera, options);
  // Radiance 0.7 + 0.3 h at height h: 0.7 + 0.2 n_z with the cosine, relative to that of n_z = 1.
  for (const double angle : {-40, -20, 0, 20, 40, 60}) {
    const Vec<3> flat = Vec<3>(camera.back[0], camera.back[1], 0).normalized();
    const Vec<3> n =
        std::cos(angle * M_PI / 180) * flat + std::sin(angle * M_PI / 180) * Vec<3>(0, 0, 1);
    CAPTURE(angle);
    CHECK(light_at(image, camera, n) ==
          doctest::Approx(0.9 * (0.7 + 0.2 * n[2]) / 0.9).epsilon(0.03));
  }
}

TEST_CASE("the ground under a ball sees the sky but for the ball") {
  RenderScene scene = ball_scene();
  scene.ground = -2;
  auto options = small();
  options.lighting.key = 0;
  options.lighting.n_key = 0;
  options.lighting.n_ambient = 240;
  options.lighting.from_below = 1;
  const Camera camera = framing(corners({Vec<3>(-1.5, -1.5, -2), Vec<3>(1.5, 1.5, 1)}),
                                {.from = {0, -1, 0.3}, .field_of_view = 0}, whole);
  const Image image = renderer().render(scene, camera, options);
  // Form factor of a ball of radius 1 over a point of a plane at distance d from its centre, at
  // height 2: 2 / d^3.
  for (const double x : {0.0, 0.5, 1.0, 1.5}) {
    const double d = std::sqrt(4 + x * x);
    CAPTURE(x);
    CHECK(light_at(image, camera, {x, 0, -2}) ==
          doctest::Approx(1 - 2 / (d * d * d)).epsilon(0.03));
  }
}

TEST_CASE("a shadow falls where the light's rays through the body meet the ground") {
  RenderScene scene = ball_scene();
  scene.ground = -2;
  auto options = small();
  options.lighting.ambient = 0;
  options.lighting.n_ambient = 0;
  options.lighting.key_radius = 0;
  options.lighting.key_direction = Vec<3>(-0.5, 0.1, 1);
  options.shadow_size = 512;
  const Camera camera = framing(corners({Vec<3>(-1.5, -1.5, -2), Vec<3>(2.5, 1.5, 1)}),
                                {.from = {0.2, -1, 0.9}, .field_of_view = 0}, whole);
  const Image image = renderer().render(scene, camera, options);
  const Vec<3> center(1, -0.2, -2), across(0, 1, 0);  // of the shadow, 1 m wide each way across
  for (const double s : {-1.3, -0.7, -0.5, 0.0}) {
    CAPTURE(s);
    CHECK(std::abs(light_at(image, camera, center + s * across) - (s < -1)) < 0.02);
  }
}

TEST_CASE("translucent layers: what is behind shows through, in any order of the parts") {
  const auto shell = [](double radius, const Color& color) {
    RenderScene scene;
    test::add(scene, test::ball_with_poles(radius), ink(color), 1e-3);
    return scene.meshes;
  };
  const auto outer = shell(1, {1, 0, 0, 0.3}), inner = shell(0.5, {0, 0, 1, 0.5});
  RenderScene scene, reversed;
  scene.meshes = outer;
  scene.meshes.insert(scene.meshes.end(), inner.begin(), inner.end());
  reversed.meshes = {scene.meshes.rbegin(), scene.meshes.rend()};
  scene.spheres = reversed.spheres = {{{0, 0, 0}, 0.2, colors::black}};
  const Camera camera = ball_camera();
  const Image image = renderer().render(scene, camera, small());
  CHECK(image.rgb == renderer().render(reversed, camera, small()).rgb);
  // Off the middle, seen through red, blue, blue, red; opacities grow with the slope.
  const double s = 0.35, red = 1 - std::pow(0.7, 1 / std::sqrt(1 - s * s)),
               blue = 1 - std::pow(0.5, 1 / std::sqrt(1 - 4 * s * s));
  double through[3] = {1, 1, 1};
  const double colors[4][3] = {{1, 0, 0}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}},
               opacity[4] = {red, blue, blue, red};
  for (int layer = 0; layer < 4; ++layer)
    for (int c = 0; c < 3; ++c)
      through[c] = (1 - opacity[layer]) * through[c] + opacity[layer] * colors[layer][c];
  const Vec<2> at = camera.project(s * camera.right);
  for (int c = 0; c < 3; ++c)
    CHECK(image.pixel(int(at[0]), int(at[1]))[c] / 255.0 ==
          doctest::Approx(through[c]).epsilon(0.02).scale(1));
}

TEST_CASE("lines: hidden ones are left out or faint, those on a surface are seen") {
  RenderScene scene;
  test::add(scene, test::ball_with_poles(1), ink(colors::light_gray));
  const Camera camera = ball_camera();
  const Vec<3> a = -0.8 * camera.right, b = 0.8 * camera.right;
  const auto with = [&](const Vec<3>& shift, double hidden) {
    RenderScene all = scene;
    all.lines = {{{{a + shift, b + shift}}, colors::black, 3, hidden}};
    return renderer().render(all, camera, small());
  };
  const Image none = renderer().render(scene, camera, small());
  const double before = darkness(none);
  CHECK(darkness(with(-2 * camera.back, 0)) == doctest::Approx(before).epsilon(1e-4));
  const double faint = darkness(with(-2 * camera.back, 0.3)) - before,
               full = darkness(with(2 * camera.back, 0)) - before;
  CHECK(full > 100);
  CHECK(faint == doctest::Approx(0.3 * full).epsilon(0.05));
  scene.lines = {{outline(test::ball_with_poles(1)[0], {1e-3}), colors::black, 2}};
  CHECK(darkness(renderer().render(scene, camera, small())) > before + 20);
}

TEST_CASE("only the part on one side of a plane is shown") {
  RenderScene scene;
  Mesh half = ink(colors::black);
  const Camera camera = ball_camera();
  half.kept = HalfSpace{camera.right, 0.2};
  test::add(scene, test::ball_with_poles(1), half, 3e-4);
  const double share = 0.5 + (0.2 * std::sqrt(0.96) + std::asin(0.2)) / M_PI;
  CHECK(darkness(renderer().render(scene, camera, small())) ==
        doctest::Approx(share * M_PI * camera.focal * camera.focal).epsilon(4e-3));
}

TEST_CASE("the same scene gives the same pixels, from any renderer, also far from zero and tiny") {
  const Camera camera = ball_camera();
  const Image image = renderer().render(ball_scene(), camera, small());
  CHECK(image.rgb == renderer().render(ball_scene(), camera, small()).rgb);
  CHECK(image.rgb == Renderer().render(ball_scene(), camera, small()).rgb);
  RenderScene moved = ball_scene();
  const Vec<3> away(3e4, -2e4, 1e4);
  for (auto& mesh : moved.meshes)
    for (auto& X : mesh.position) X = 1e-3 * X + away;
  const Camera there = framing(corners({Vec<3>(away.array() - 1e-3), Vec<3>(away.array() + 1e-3)}),
                               {.field_of_view = 0}, whole);
  CHECK(darkness(renderer().render(moved, there, small())) ==
        doctest::Approx(darkness(image)).epsilon(1e-3));
}

TEST_CASE("a camera touches the area with what it frames, and centres it") {
  const Box<3> box{Vec<3>(1, 2, 3), Vec<3>(4, 3, 5)};
  for (const double field : {0.0, 24.0, 70.0})
    for (const Vec<3>& from : {Vec<3>(-0.5, -1, 0.5), Vec<3>(1, 0.1, 0), Vec<3>(0.2, 0.3, -1)}) {
      const Box<2> area{Vec<2>(30, 10), Vec<2>(310, 190)};
      const Camera camera = framing(corners(box), {.from = from, .field_of_view = field}, area);
      Box<2> seen;
      for (const auto& X : corners(box)) {
        CHECK(camera.depth(X) > 0);
        seen.include(camera.project(X));
      }
      const Vec<2> before = seen.lower - area.lower, after = area.upper - seen.upper;
      CHECK(std::min(before[0], before[1]) == doctest::Approx(0).scale(100));
      CHECK(before[0] > -1e-6);
      CHECK(before[1] > -1e-6);
      const int tight = before[0] < before[1] ? 0 : 1;
      CHECK(after[tight] == doctest::Approx(before[tight]).scale(100));
      CHECK(after[1 - tight] > -1e-6);
    }
  CHECK_THROWS_AS(framing({}, {}, whole), InputError);
  CHECK_THROWS_AS(framing(corners(box), {.from = {0, 0, 1}}, whole), InputError);
}

TEST_CASE("bad sizes and a program that does not compile are errors that say why") {
  auto options = small();
  options.width = 5000;
  CHECK_THROWS_AS(renderer().render({}, ball_camera(), options), InputError);
  CHECK(darkness(renderer().render({}, ball_camera(), small())) == 0);
  OffscreenContext context(16, 16, OffscreenContext::Buffer::plain);
  context.make_current();
  const char* good = "#version 330\nvoid main() { gl_Position = vec4(0); }";
  CHECK_THROWS_WITH(Program("odd", good, "#version 330\nvoid main() { undeclared = 1; }"),
                    doctest::Contains("undeclared"));
}
