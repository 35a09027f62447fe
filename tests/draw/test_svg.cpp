// The vector canvas: well-formed, the same calls as the pixels, the same bytes twice.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <map>
#include <regex>

#include "sem/draw/image.h"
#include "sem/draw/raster.h"
#include "sem/draw/svg.h"

using namespace sem;

namespace {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;
  int depth = 0;
  double number(const std::string& key) const { return std::stod(attributes.at(key)); }
};

// The elements in order; fails the test if tags do not match or an attribute is malformed.
std::vector<Element> parse(const std::string& svg) {
  std::vector<Element> elements;
  std::vector<std::size_t> open;
  std::size_t at = svg.find("?>") + 2;
  const std::regex attribute(R"re(\s+([\w:-]+)="([^"<]*)")re");
  while ((at = svg.find('<', at)) != std::string::npos) {
    const std::size_t end = svg.find('>', at);
    REQUIRE(end != std::string::npos);
    std::string tag = svg.substr(at + 1, end - at - 1);
    at = end + 1;
    if (tag[0] == '/') {
      REQUIRE(!open.empty());
      CHECK(elements[open.back()].name == tag.substr(1));
      open.pop_back();
      continue;
    }
    const bool leaf = tag.back() == '/';
    if (leaf) tag.pop_back();
    Element element;
    const std::size_t name_end = tag.find(' ');
    element.name = tag.substr(0, name_end);
    element.depth = int(open.size());
    std::string rest = name_end == std::string::npos ? "" : tag.substr(name_end);
    for (std::smatch match;
         std::regex_search(rest, match, attribute, std::regex_constants::match_continuous);
         rest = match.suffix()) {
      CHECK(element.attributes.emplace(match[1], match[2]).second);
    }
    CHECK(rest.empty());
    if (!leaf) element.text = svg.substr(at, svg.find('<', at) - at);
    elements.push_back(element);
    if (!leaf) open.push_back(elements.size() - 1);
  }
  CHECK(open.empty());
  return elements;
}

std::vector<Element> named(const std::vector<Element>& elements, const std::string& name) {
  std::vector<Element> found;
  for (const auto& element : elements)
    if (element.name == name) found.push_back(element);
  return found;
}

const Polyline triangle = {{10, 10}, {90, 10}, {10, 70}};

void draw_everything(Canvas& canvas) {
  const std::vector<Polyline> with_hole = {triangle, {{20, 20}, {40, 20}, {20, 40}}};
  canvas.fill(with_hole, colors::okabe_ito[1].with_alpha(0.4));
  canvas.stroke(triangle,
                {.color = colors::okabe_ito[0], .width = 3, .closed = true, .dash = {5, 3}});
  canvas.text({5, 90}, "α = −0.5 & x < \"y\"", {.size = 10});
  canvas.marker({20, 20}, MarkerShape::cross, 8, colors::black);
  Image image(2, 1);
  image.set(0, 0, colors::white);
  canvas.push_clip({Vec<2>(0, 0), Vec<2>(50, 50)});
  canvas.image(image, {Vec<2>(30, 30), Vec<2>(70, 50)});
  canvas.pop_clip();
}

// Area of the polygons in path data of M, L and Z.
double path_area(const std::string& d) {
  double area = 0;
  std::vector<Vec<2>> loop;
  const std::regex command(R"(([MLZ])(?:(-?[\d.]+) (-?[\d.]+))?)");
  for (std::sregex_iterator it(d.begin(), d.end(), command), end; it != end; ++it) {
    if ((*it)[1] == "Z") {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec<2>&a = loop[k], &b = loop[(k + 1) % loop.size()];
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
      }
      loop.clear();
    } else {
      loop.emplace_back(std::stod((*it)[2]), std::stod((*it)[3]));
    }
  }
  return std::abs(area);
}

}  // namespace

TEST_CASE("an SVG states its size in inches and its coordinates in pixels") {
  SvgCanvas canvas(990, 600, 300);
  const auto elements = parse(canvas.finish());
  REQUIRE(elements[0].name == "svg");
  CHECK(elements[0].attributes.at("width") == "3.3in");
  CHECK(elements[0].attributes.at("height") == "2in");
  CHECK(elements[0].attributes.at("viewBox") == "0 0 990 600");
}

TEST_CASE("an SVG is well-formed and has the same bytes twice") {
  std::string texts[2];
  for (auto& text : texts) {
    SvgCanvas canvas(100, 100);
    draw_everything(canvas);
    text = canvas.finish();
  }
  CHECK(texts[0] == texts[1]);
  const auto elements = parse(texts[0]);
  CHECK(named(elements, "path").size() == 3);
  CHECK(named(elements, "text").size() == 1);
  CHECK(named(elements, "text")[0].text == "α = −0.5 &amp; x &lt; &quot;y&quot;");
  CHECK(named(elements, "image").size() == 1);
}

TEST_CASE("an open clip rectangle is closed at the end, and rectangles nest") {
  SvgCanvas canvas(100, 100);
  canvas.push_clip({Vec<2>(0, 0), Vec<2>(50, 50)});
  canvas.push_clip({Vec<2>(10, 10), Vec<2>(90, 90)});
  canvas.fill(triangle, colors::black);
  const auto elements = parse(canvas.finish());
  const auto groups = named(elements, "g"), clips = named(elements, "clipPath");
  REQUIRE(groups.size() == 2);
  REQUIRE(clips.size() == 2);
  for (int i = 0; i < 2; ++i)
    CHECK(groups[i].attributes.at("clip-path") == "url(#" + clips[i].attributes.at("id") + ")");
  CHECK(groups[1].depth == groups[0].depth + 1);
  CHECK(named(elements, "path")[0].depth == groups[1].depth + 1);
}

TEST_CASE("coordinates have at most two decimals and no trailing zeros") {
  SvgCanvas canvas(100, 100);
  canvas.fill(Polyline{{1.0 / 3, 2}, {50.004, 10.10}, {-1e-9, 1e2}}, colors::black);
  CHECK(named(parse(canvas.finish()), "path")[0].attributes.at("d") == "M0.33 2L50 10.1L0 100Z");
}

TEST_CASE("areas are those of the raster canvas") {
  SvgCanvas vectors(100, 100);
  RasterCanvas pixels(100, 100, 4);
  for (Canvas* canvas : {static_cast<Canvas*>(&vectors), static_cast<Canvas*>(&pixels)})
    canvas->fill(triangle, colors::black);
  double ink = 0;
  const Image image = pixels.finish();
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) ink += 1 - image.rgb[i] / 255.0;
  const auto path = named(parse(vectors.finish()), "path")[0];
  CHECK(path_area(path.attributes.at("d")) == doctest::Approx(ink).epsilon(0.003));
}

TEST_CASE("text has the widths of the raster canvas, and its anchors") {
  SvgCanvas vectors(400, 400);
  RasterCanvas pixels(10, 10);
  for (const double size : {8.0, 12.0, 33.3})
    for (const char* text : {"x", "relative error (10⁻⁶ m²)", "θ − ∂Ψ/∂F"})
      CHECK(vectors.text_width(text, size) ==
            doctest::Approx(pixels.text_width(text, size)).epsilon(1e-4));
  using Horizontal = TextStyle::Horizontal;
  using Vertical = TextStyle::Vertical;
  vectors.text({100, 100}, "left", {.size = 20});
  vectors.text({100, 100}, "middle",
               {.size = 20, .horizontal = Horizontal::center, .vertical = Vertical::middle});
  vectors.text(
      {100, 100}, "up",
      {.size = 20, .horizontal = Horizontal::right, .vertical = Vertical::top, .upward = true});
  const auto texts = named(parse(vectors.finish()), "text");
  CHECK(!texts[0].attributes.count("text-anchor"));
  CHECK(texts[0].number("y") == 100);
  CHECK(texts[1].attributes.at("text-anchor") == "middle");
  CHECK(texts[1].number("y") == std::round(100 + 0.729 * 10));
  CHECK(texts[2].attributes.at("text-anchor") == "end");
  CHECK(texts[2].number("x") == std::round(100 + 0.729 * 20));
  CHECK(texts[2].attributes.at("transform") == "rotate(-90 115 100)");
}

TEST_CASE("lines break at gaps, sharp corners are round, transparent ones do not add up") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SvgCanvas canvas(100, 100);
  canvas.stroke(Polyline{{0, 0}, {10, 0}, {nan, 0}, {20, 0}, {30, 0}}, {});
  canvas.stroke(Polyline{{0, 0}, {50, 0}, {0, 10}}, {.width = 4});
  canvas.stroke(Polyline{{0, 0}, {50, 0}, {50, 50}}, {.width = 4});
  canvas.stroke(Polyline{{0, 0}, {50, 0}, {0, 10}}, {.color = {0, 0, 0, 0.5}, .width = 4});
  canvas.stroke(Polyline{{5, 5}}, {.width = 4, .cap = Stroke::Cap::round});
  canvas.stroke(Polyline{{5, 5}}, {.width = 4});  // nothing
  const auto elements = parse(canvas.finish());
  const auto paths = named(elements, "path"), circles = named(elements, "circle"),
             groups = named(elements, "g");
  REQUIRE(paths.size() == 5);
  CHECK(paths[0].attributes.at("d") == "M0 0L10 0M20 0L30 0");
  REQUIRE(circles.size() == 2);  // of the second and fourth line
  CHECK(circles[0].number("cx") == 50);
  CHECK(circles[0].number("r") == 2);
  REQUIRE(groups.size() == 1);
  CHECK(groups[0].number("opacity") == 0.5);
  CHECK(!paths[3].attributes.count("stroke-opacity"));
  CHECK(paths[4].attributes.at("d") == "M5 5h0");
}

TEST_CASE("pixels of the colour left out show what is below, on both canvases") {
  Image image(2, 1);
  image.set(0, 0, {1, 0, 0});
  image.set(1, 0, {0, 0, 1});
  image.left_out = {0, 0, 255};
  RasterCanvas pixels(20, 10);
  pixels.fill_box({Vec<2>(0, 0), Vec<2>(20, 10)}, {0, 1, 0});
  pixels.image(image, {Vec<2>(0, 0), Vec<2>(20, 10)});
  const Image drawn = pixels.finish();
  CHECK(drawn.pixel(3, 5)[0] == 255);
  CHECK(drawn.pixel(15, 5)[0] == 0);
  CHECK(drawn.pixel(15, 5)[1] == 255);
  const auto png = encode_png(image);
  const std::string bytes(png.begin(), png.end());
  const std::size_t chunk = bytes.find("tRNS");
  REQUIRE(chunk != std::string::npos);
  CHECK(bytes.substr(chunk + 4, 6) == std::string("\0\0\0\0\0\xff", 6));
  CHECK(chunk < bytes.find("IDAT"));
}
