#include "stability/case.h"

#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

#include "sem/base/error.h"

namespace sem::stability {
namespace {

constexpr rlim_t memory_limit = rlim_t(6) << 30;  // bytes, of a child

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

Result run_here(const Case& one) try {
  return one.run();
} catch (const Refusal& refusal) {
  return {Outcome::refused, refusal.text, 0};
} catch (const InputError& error) {
  return {Outcome::refused, error.what(), 0};
} catch (const std::exception& error) {
  return {Outcome::failed, std::string("exception: ") + error.what(), 0};
}

// The child: runs the case, writes outcome, error and text, ends without the parent's cleanup.
[[noreturn]] void run_in_child(const Case& one, double seconds, int pipe) {
  const rlimit memory{memory_limit, memory_limit};
  setrlimit(RLIMIT_AS, &memory);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  alarm(unsigned(std::ceil(seconds)));
  const Result result = run_here(one);
  char head[64];
  const int n = std::snprintf(head, sizeof head, "%d %.17g\n", int(result.outcome), result.error);
  const std::string text = std::string(head, n) + result.text;
  const bool written = write(pipe, text.data(), text.size()) == ssize_t(text.size());
  _exit(written ? 0 : 1);
}

std::string read_all(int pipe) {
  std::string text;
  char buffer[4096];
  for (ssize_t n; (n = read(pipe, buffer, sizeof buffer)) > 0;) text.append(buffer, size_t(n));
  return text;
}

}  // namespace

void Checks::add(const std::string& what, double error, double bound) {
  const double ratio = std::isfinite(error) ? std::abs(error) / bound : std::numeric_limits<double>::infinity();
  if (ratio <= worst_.error) return;
  worst_ = {ratio <= 1 ? Outcome::solved : Outcome::failed,
            what + " " + number(error) + " (bound " + number(bound) + ")", ratio};
}

Result run_isolated(const Case& one, double seconds) {
  int ends[2];
  if (pipe(ends) != 0) return {Outcome::failed, "no pipe", 0};
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) return {Outcome::failed, "no process", 0};
  if (child == 0) {
    close(ends[0]);
    run_in_child(one, seconds, ends[1]);
  }
  close(ends[1]);
  const std::string text = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status))
    return {Outcome::failed,
            WTERMSIG(status) == SIGALRM ? "time limit of " + number(seconds) + " s"
                                        : std::string("crash: ") + strsignal(WTERMSIG(status)),
            0};
  Result result;
  int outcome = 0, begin = 0;
  if (std::sscanf(text.c_str(), "%d %lf\n%n", &outcome, &result.error, &begin) != 2)
    return {Outcome::failed, "the process ended without a result", 0};
  result.outcome = Outcome(outcome);
  result.text = text.substr(size_t(begin));
  return result;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto& group : {geometry_cases(), kinematics_cases(), mechanics_cases(), solver_cases()})
    cases.insert(cases.end(), group.begin(), group.end());
  return cases;
}

}  // namespace sem::stability
