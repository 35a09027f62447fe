#pragma once
// A lesson of three steps whose numbers can be foretold, for tests of the stepping.

#include "sem/lesson/lesson.h"

namespace sem::test {

struct SmallLesson {
  double a = 2, b = 10;
  int k = 1, method = 0;
  bool fail = false;
  Vec<2> corner{1, 1};
  double product = 0, sum = 0;
  int n_draws = 0;
  Lesson lesson{"A small lesson", {{0, 0}, {3, 2}}};

  SmallLesson() {
    lesson.slider("a", a, 0, 4, "m");
    lesson.slider("b", b, 0.1, 1000, "", Lesson::Scale::logarithmic);
    lesson.handle("corner", corner);
    lesson.step(
        "Product",
        [this](std::ostream& out) {
          product = a * corner[0];
          out << "product " << rounded(product) << "\n";
        },
        [this](Picture& picture) {
          ++n_draws;
          picture.line({0, 0}, corner, {.width = 3});
          picture.dot(corner, colors::categorical(1));
        },
        [](const Vec<2>& X) { return "at " + rounded(X[0], 3) + ", " + rounded(X[1], 3); });
    lesson.slider("k", k, 1, 5);
    lesson.toggle("fail", fail);
    lesson.step(
        "Sum",
        [this](std::ostream& out) {
          if (fail) throw std::runtime_error("failed as asked");
          sum = product + k;
          out << "sum " << rounded(sum) << "\n";
        },
        [this](Picture& picture) {
          picture.canvas().fill_box({{100, 100}, {100 + 50 * sum, 150}}, colors::categorical(2));
        });
    lesson.choice("method", method, {"none", "first", "second"});
    lesson.step(
        "Method", [this](std::ostream& out) { out << "method " << method << "\n"; },
        [](Picture& picture) { picture.note("a note"); });
  }
};

}  // namespace sem::test
