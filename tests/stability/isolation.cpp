// sem_stability's frame: whatever a case does, the others go on.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>

#include "sem/base/error.h"
#include "tests/hard_cases/case.h"

using namespace sem;
using namespace sem::stability;

namespace {

Result solved() { return {Outcome::solved, "fine", 0.5}; }

std::vector<Result> run(const std::vector<std::function<Result()>>& bodies, double seconds = 20) {
  std::vector<Case> cases;
  for (const auto& body : bodies) cases.push_back({"group", "name", "", Rule::may_refuse, true, body});
  std::vector<Result> results;
  run_isolated(cases, seconds, 2, [&](size_t k, const Result& result, double) {
    CHECK(k == results.size());
    results.push_back(result);
  });
  return results;
}

}  // namespace

TEST_CASE("a crash, an abort and an exception fail their own case and no other") {
  const auto results = run({solved, [] { std::abort(); return solved(); },
                            [] { raise(SIGSEGV); return solved(); },
                            []() -> Result { throw std::runtime_error("why"); },
                            [] { _exit(0); return solved(); }, solved});
  REQUIRE(results.size() == 6);
  for (const int k : {0, 5}) {
    CHECK(results[k].outcome == Outcome::solved);
    CHECK(results[k].text == "fine");
    CHECK(results[k].error == 0.5);
  }
  for (const int k : {1, 2, 3, 4}) CHECK(results[k].outcome == Outcome::failed);
  CHECK(results[1].text.starts_with("crash"));
  CHECK(results[3].text == "exception: why");
}

TEST_CASE("an endless loop ends with the time limit") {
  const auto results = run({[] { volatile bool on = true; while (on) {} return solved(); }, solved}, 1);
  CHECK(results[0].outcome == Outcome::failed);
  CHECK(results[0].text.starts_with("time limit"));
  CHECK(results[1].outcome == Outcome::solved);
}

TEST_CASE("input errors and refusals are refused, and pass only where a case may refuse") {
  const auto results = run({[]() -> Result { throw InputError("", "field", "this", "that"); },
                            []() -> Result { throw Refusal{"singular"}; }});
  for (const auto& result : results) {
    CHECK(result.outcome == Outcome::refused);
    CHECK(Case{"", "", "", Rule::may_refuse, true, {}}.passes(result));
    CHECK_FALSE(Case{"", "", "", Rule::must_solve, true, {}}.passes(result));
  }
  CHECK(results[1].text == "singular");
}

TEST_CASE("checks: the worst counts, not a number is worse than all, none is not a solution") {
  Checks checks;
  checks.add("small", 1e-9, 1e-8);
  checks.add("larger", -5e-9, 1e-8);
  CHECK(checks.result().outcome == Outcome::solved);
  CHECK(checks.result().error == doctest::Approx(0.5));
  CHECK(checks.result().text.starts_with("larger"));
  checks.add("nan", std::nan(""), 1e-8);
  CHECK(checks.result().outcome == Outcome::failed);
  CHECK(Checks().result().outcome == Outcome::failed);
}
