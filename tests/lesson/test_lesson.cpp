#include <doctest/doctest.h>

#include "sem/base/error.h"
#include "small_lesson.h"

using namespace sem;
using sem::test::SmallLesson;

namespace {

const Parameter& find(const Lesson& lesson, const std::string& name) {
  for (const auto& p : lesson.parameters())
    if (p.name == name) return p;
  throw std::runtime_error("no parameter " + name);
}

std::vector<int> runs(const Lesson& lesson) {
  return {lesson.n_runs(0), lesson.n_runs(1), lesson.n_runs(2)};
}

std::string error_of(const std::function<void()>& what) {
  try {
    what();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

using Runs = std::vector<int>;

}  // namespace

TEST_CASE("a step runs once when it is first shown, and not on the way back") {
  SmallLesson small;
  Lesson& lesson = small.lesson;
  CHECK(runs(lesson) == Runs{0, 0, 0});
  lesson.show(0);
  CHECK(runs(lesson) == Runs{1, 0, 0});
  lesson.show(2);
  CHECK(runs(lesson) == Runs{1, 1, 1});
  lesson.show(0);
  lesson.show(2);
  CHECK(runs(lesson) == Runs{1, 1, 1});
  CHECK(lesson.numbers(0) == "product 2\n");
  CHECK(lesson.numbers(1) == "sum 3\n");
}

TEST_CASE("a parameter reruns its step and the later ones that are shown, the others when shown") {
  SmallLesson small;
  Lesson& lesson = small.lesson;
  lesson.show(2);
  lesson.change(find(lesson, "k"), {4, 0});
  CHECK(runs(lesson) == Runs{1, 2, 2});
  CHECK(lesson.numbers(1) == "sum 6\n");
  lesson.show(0);
  lesson.change(find(lesson, "a"), {3, 0});
  CHECK(runs(lesson) == Runs{2, 2, 2});
  CHECK(!lesson.fresh(1));
  lesson.show(1);
  CHECK(runs(lesson) == Runs{2, 3, 2});
  CHECK(lesson.numbers(1) == "sum 7\n");
  lesson.change(find(lesson, "method"), {2, 0});  // of a step that is not shown
  CHECK(runs(lesson) == Runs{2, 3, 2});
}

TEST_CASE("an unchanged or clamped value runs nothing") {
  SmallLesson small;
  Lesson& lesson = small.lesson;
  lesson.show(0);
  lesson.change(find(lesson, "a"), {2, 0});
  CHECK(runs(lesson) == Runs{1, 0, 0});
  lesson.change(find(lesson, "a"), {99, 0});
  CHECK(small.a == 4);
  lesson.change(find(lesson, "a"), {100, 0});
  CHECK(runs(lesson) == Runs{2, 0, 0});
  lesson.change(find(lesson, "corner"), {-1, 5});
  CHECK(small.corner == Vec<2>(0, 2));
}

TEST_CASE("reset restores every parameter and shows the first step anew") {
  SmallLesson small;
  Lesson& lesson = small.lesson;
  lesson.show(2);
  for (const char* setting :
       {"a=3", "b=0.5", "k=5", "method=second", "corner=0.5,0.25", "fail=off"})
    lesson.set(setting);
  CHECK(lesson.settings() ==
        "--set a=3 --set b=0.5 --set corner=0.5,0.25 --set k=5 --set method=second");
  lesson.reset();
  CHECK(lesson.settings() == "");
  CHECK(small.corner == Vec<2>(1, 1));
  CHECK(lesson.current() == 0);
  CHECK(lesson.numbers(0) == "product 2\n");
  lesson.show(2);
  CHECK(lesson.numbers(1) == "sum 3\n");
  CHECK(lesson.numbers(2) == "method 0\n");
}

TEST_CASE("settings read back bit for bit") {
  SmallLesson one, other;
  one.lesson.show(0);
  one.lesson.change(find(one.lesson, "a"), {1.0 / 3, 0});
  one.lesson.change(find(one.lesson, "corner"), {2.0 / 3, 1e-7});
  other.lesson.set("a=" + value_text(find(one.lesson, "a"), {one.a, 0}));
  other.lesson.set("corner=" + value_text(find(one.lesson, "corner"), one.corner));
  CHECK(other.a == one.a);
  CHECK(other.corner == one.corner);
}

TEST_CASE("--set rejects what is not allowed and names what is") {
  SmallLesson small;
  const auto rejected = [&](const std::string& text, const std::string& piece) {
    CAPTURE(text);
    const std::string error = error_of([&] { small.lesson.set(text); });
    CAPTURE(error);
    CHECK(error.find(piece) != std::string::npos);
  };
  rejected("methd=first", "'method' (did you mean that?)");
  rejected("zzzzzz=1", "--list");
  rejected("a", "name=value");
  rejected("a=5", "allowed: 0 to 4");
  rejected("a=nan", "allowed: 0 to 4");
  rejected("a=1x", "'1x'");
  rejected("a=", "''");
  rejected("b=0", "0.1 to 1000");
  rejected("k=2.5", "whole numbers from 1 to 5");
  rejected("k=6", "whole numbers from 1 to 5");
  rejected("fail=yes", "on or off");
  rejected("method=secnd", "did you mean 'second'?");
  rejected("method=1", "none, first or second");
  rejected("corner=1", "x,y with x in 0 to 3, y in 0 to 2");
  rejected("corner=1,2,3", "'1,2,3'");
  rejected("corner=1,7", "y in 0 to 2");
  CHECK(small.lesson.settings() == "");
}

TEST_CASE("a step that throws stays out of date, and the next change mends it") {
  SmallLesson small;
  Lesson& lesson = small.lesson;
  lesson.show(1);
  CHECK_THROWS_WITH(lesson.set("fail=on"), "failed as asked");
  CHECK(lesson.current() == 1);
  CHECK(!lesson.fresh(1));
  CHECK_THROWS(lesson.show(2));
  CHECK(lesson.n_runs(2) == 0);
  lesson.set("fail=off");
  CHECK(lesson.fresh(2));
  CHECK(lesson.numbers(1) == "sum 3\n");
}

TEST_CASE("an enumeration is chosen by name") {
  enum class Rule { published, draft };
  Rule rule = Rule::draft;
  Lesson lesson("Rules", {{0, 0}, {1, 1}});
  lesson.choice<Rule>("rule", rule, {{"published", Rule::published}, {"draft", Rule::draft}});
  lesson.step(
      "Only", [](std::ostream&) {}, [](Picture&) {});
  CHECK(value_text(lesson.parameters()[0], lesson.parameters()[0].get()) == "draft");
  lesson.set("rule=published");
  CHECK(rule == Rule::published);
  lesson.reset();
  CHECK(rule == Rule::draft);
}

TEST_CASE("what a step computed coarsely while changes were quick runs again when they end") {
  double a = 1;
  int n = 0;
  Lesson lesson("Quick", {{0, 0}, {1, 1}});
  lesson.slider("a", a, 0, 9);
  lesson.step(
      "First", [](std::ostream& out) { out << "first"; }, [](Picture&) {});
  lesson.step(
      "Second", [&](std::ostream&) { n = lesson.quick() ? 3 : 9; }, [](Picture&) {});
  lesson.show(1);
  CHECK(n == 9);
  CHECK(!lesson.coarse());
  lesson.set_quick(true);
  lesson.change(find(lesson, "a"), {2, 0});
  CHECK(n == 3);
  CHECK(lesson.coarse());
  lesson.set_quick(false);
  lesson.refine();
  CHECK(n == 9);
  CHECK(!lesson.coarse());
  CHECK(lesson.n_runs(0) == 2);  // never asked
  CHECK(lesson.n_runs(1) == 3);
  lesson.refine();
  CHECK(lesson.n_runs(1) == 3);
}
