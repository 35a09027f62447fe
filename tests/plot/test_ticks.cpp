// Ticks of axes: where they are and how they read.
#include <doctest/doctest.h>

#include <cmath>

#include "sem/plot/axis.h"

using namespace sem;

namespace {

std::vector<std::string> labels(const Ticks& ticks) {
  std::vector<std::string> result;
  for (const auto& tick : ticks.ticks)
    if (!tick.label.empty()) result.push_back(tick.label);
  return result;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("linear ticks are 1, 2 or 5 times a decade, with the minus sign U+2212") {
  CHECK(labels(linear_ticks(0, 1, 5)) == Texts{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"});
  CHECK(labels(linear_ticks(-7, 7, 4)) == Texts{"\u22125", "0", "5"});
  CHECK(labels(linear_ticks(0, 0.07, 4)) == Texts{"0.00", "0.02", "0.04", "0.06"});
}

TEST_CASE("very small and large numbers share a power of ten, which goes into the unit") {
  const Ticks small = linear_ticks(0, 3e-6, 3), large = linear_ticks(0, 2e7, 2);
  CHECK(labels(small) == Texts{"0", "1", "2", "3"});
  CHECK(small.factor == "10⁻⁶");
  CHECK(small.ticks[1].value == doctest::Approx(1e-6));
  CHECK(labels(large) == Texts{"0", "1", "2"});
  CHECK(axis_label("energy (J)", large) == "energy (10⁷ J)");
  CHECK(axis_label("error", small) == "error (10⁻⁶)");
  CHECK(axis_label("error", linear_ticks(0, 1, 3)) == "error");
}

TEST_CASE("logarithmic ticks are decades as powers, the steps between them without text") {
  const Ticks ticks = log_ticks(3, 1500, 5);
  CHECK(labels(ticks) == Texts{"10¹", "10²", "10³"});
  CHECK(ticks.ticks.front().value == 3);
  CHECK(ticks.ticks.size() == 7 + 9 + 9 + 1);  // 3...9, 10...90, 100...900, 1000
  for (const auto& tick : ticks.ticks) CHECK((tick.value >= 3 && tick.value <= 1500));
}

TEST_CASE("many decades are thinned to one stride, without the steps between them") {
  const Ticks ticks = log_ticks(1e-12, 1, 6);
  const Texts texts = labels(ticks);
  CHECK(texts.size() <= 7);
  CHECK(texts.size() >= 5);
  CHECK(texts[0] == "10⁻¹²");
  for (const auto& tick : ticks.ticks) {
    const double decade = std::log10(tick.value);
    CHECK(std::abs(decade - std::round(decade)) < 1e-9);
  }
}

TEST_CASE("a logarithmic axis within a decade has plain numbers") {
  CHECK(labels(log_ticks(1.5, 8, 5)) == Texts{"2", "5"});
  CHECK(labels(log_ticks(0.02, 0.15, 5)) == Texts{"0.02", "0.05", "0.1"});
}

TEST_CASE("numbers in texts: significant digits, minus sign, powers of ten where shorter") {
  CHECK(number_text(0.25) == "0.25");
  CHECK(number_text(-3.1) == "−3.1");
  CHECK(number_text(1234.4, 4) == "1234");
  CHECK(number_text(0) == "0");
  CHECK(number_text(2.5e-6) == "2.5×10⁻⁶");
  CHECK(number_text(1e9) == "10⁹");
  CHECK(number_text(-1.5) == "−1.5");
  CHECK(number_text(0.9999) == "1");
  CHECK(number_text(std::nan("")) == "–");
}

TEST_CASE("automatic limits hold all data; given ones stay") {
  DataRange data;
  for (const double value : {2.0, 7.0, std::nan(""), double(INFINITY)}) data.include(value);
  const auto [lower, upper] = axis_limits({}, data);
  CHECK(lower == doctest::Approx(1.75));
  CHECK(upper == doctest::Approx(7.25));
  CHECK(axis_limits({.lower = 0, .upper = 5}, data) == std::pair(0.0, 5.0));
  CHECK(axis_limits({.lower = 0}, data).first == 0);
  data.include(-3);
  const auto log = axis_limits({.logarithmic = true}, data);
  CHECK(log.first == doctest::Approx(2));
  CHECK(log.second == doctest::Approx(10));
}

TEST_CASE("limits without extent or data are still an interval") {
  DataRange constant, none;
  constant.include(4);
  for (const bool logarithmic : {false, true})
    for (const auto& data : {constant, none}) {
      const auto [lower, upper] = axis_limits({.logarithmic = logarithmic}, data);
      CHECK(lower < upper);
      CHECK((!logarithmic || lower > 0));
    }
}

TEST_CASE("a logarithmic scale has no place for what is not positive") {
  const AxisScale scale{1, 100, 0, 50, true};
  CHECK(scale(10) == doctest::Approx(25));
  CHECK(std::isnan(scale(0)));
  CHECK(std::isnan(scale(-1)));
}
