#include "sem/plot/ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "sem/draw/view.h"

namespace sem {
namespace {

constexpr double slack = 1e-9;  // of a decade or step: limits may be rounded

}  // namespace

std::string power_of_ten(int exponent) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

std::string number_text(double value, int n_digits) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value < 0 ? "−∞" : "∞";
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.*e", n_digits - 1, std::abs(value));
  std::string mantissa(digits);
  const auto e = mantissa.find('e');
  const int exponent = std::atoi(mantissa.c_str() + e + 1);
  mantissa.resize(e);
  const std::string sign = value < 0 ? "−" : "";
  if (exponent >= -3 && exponent < std::max(5, n_digits)) {
    std::snprintf(digits, sizeof digits, "%.*f", std::max(0, n_digits - 1 - exponent),
                  std::atof(digits));
    std::string plain(digits);
    if (plain.find('.') != std::string::npos) {
      plain.erase(plain.find_last_not_of('0') + 1);
      if (plain.back() == '.') plain.pop_back();
    }
    return sign + plain;
  }
  if (mantissa.find('.') != std::string::npos) {
    mantissa.erase(mantissa.find_last_not_of('0') + 1);
    if (mantissa.back() == '.') mantissa.pop_back();
  }
  return sign + (mantissa == "1" ? "" : mantissa + "×") + power_of_ten(exponent);
}

std::string axis_label(const std::string& label, const Ticks& ticks) {
  if (ticks.factor.empty()) return label;
  const auto unit = label.rfind('(');
  if (unit != std::string::npos && label.back() == ')')
    return label.substr(0, unit + 1) + ticks.factor + " " + label.substr(unit + 1);
  return label.empty() ? "×" + ticks.factor : label + " (" + ticks.factor + ")";
}

Ticks linear_ticks(double lower, double upper, int n) {
  const double step = nice_step(lower, upper, n);
  const double largest = std::max(std::abs(lower), std::abs(upper));
  const int exponent = int(std::floor(std::log10(largest) + slack));
  const bool plain = exponent >= -3 && exponent < 5;
  const double unit = plain ? 1 : std::pow(10.0, exponent);
  Ticks result{{}, plain ? "" : power_of_ten(exponent)};
  for (const double value : nice_ticks(lower, upper, n))
    result.ticks.push_back({value, tick_label(value / unit, step / unit)});
  return result;
}

Ticks log_ticks(double lower, double upper, int n) {
  const double first = std::log10(lower), last = std::log10(upper);
  const int low = int(std::ceil(first - slack)), high = int(std::floor(last + slack));
  const auto inside = [&](double value) {
    return std::log10(value) >= first - slack && std::log10(value) <= last + slack;
  };
  const bool plain = high - low < 1;  // at most one decade within the limits
  const int stride = std::max(1, (high - low + n) / (n + 1));
  Ticks result;
  for (int e = low - 1; e <= high; ++e)
    for (int m = 1; m < 10; ++m) {
      const double value = e < 0 ? m / std::pow(10.0, -e) : m * std::pow(10.0, e);
      if (!inside(value)) continue;
      std::string label;
      if (plain && (m == 1 || m == 2 || m == 5))
        label = number_text(value);
      else if (m == 1 && (e - low) % stride == 0)
        label = power_of_ten(e);
      if (m > 1 && label.empty() && (stride > 1 || high - low > 6)) continue;
      result.ticks.push_back({value, label});
    }
  return result;
}

}  // namespace sem
