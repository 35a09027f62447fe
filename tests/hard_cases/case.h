#pragma once
// A hard case: what is run, what counts as right, and what came out.

#include <functional>
#include <string>
#include <vector>

namespace sem::stability {

enum class Rule {
  must_solve,  ///< right within its bounds
  may_refuse,  ///< right, or a clear status that says why
};

enum class Outcome { solved, refused, failed };

struct Result {
  Outcome outcome = Outcome::failed;
  std::string text;  ///< what happened: the worst check, or why it was refused or failed
  double error = 0;  ///< the largest error by its bound; refused, failed without a number: 0
};

struct Case {
  std::string group, name;
  std::string variant;  ///< "2D projected": dimension and formulation; empty: neither plays a part
  Rule rule = Rule::must_solve;
  bool fast = true;     ///< part of the fast subset
  std::function<Result()> run;

  bool passes(const Result& result) const {
    return result.outcome == Outcome::solved ||
           (result.outcome == Outcome::refused && rule == Rule::may_refuse);
  }
};

/// A line of the table.
struct Row {
  Case one;
  Result result;
  double seconds;

  bool failed() const { return !one.passes(result); }
  bool refused() const { return !failed() && result.outcome == Outcome::refused; }  ///< and may
};

/// A status other than converged, or a doubt that the program reports: thrown by a case, a refusal.
struct Refusal {
  std::string text;
};

/// The checks of a case: each an error, computed against something that does not come from the
/// library, and the bound it has to stay below.
class Checks {
 public:
  /// An error that is not a number is above every bound.
  void add(const std::string& what, double error, double bound);
  /// Solved if all errors are within their bounds.
  Result result() const { return worst_; }

 private:
  Result worst_{Outcome::failed, "nothing was checked", -1};
};

/// All cases, in the order of the table.
std::vector<Case> all_cases();
std::vector<Case> geometry_cases();
std::vector<Case> kinematics_cases();
std::vector<Case> mechanics_cases();
std::vector<Case> solver_cases();

/// Called once for every case, in their order: its index, what came out, its wall time.
using OnResult = std::function<void(size_t, const Result&, double seconds)>;

/// Runs every case in a process of its own, some at a time, with a time limit each: a crash, an endless loop
/// or an allocation beyond 6 GB ends that process alone and is a failed result. InputError and Refusal are
/// refusals, other exceptions failures.
void run_isolated(const std::vector<Case>& cases, double seconds, int n_processes, const OnResult& on_result);

}  // namespace sem::stability
