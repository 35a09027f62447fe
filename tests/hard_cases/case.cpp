#include "tests/hard_cases/case.h"

#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>

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

// A child at work.
struct Running {
  size_t index;
  pid_t process;
  int pipe;
  std::string text;
  std::chrono::steady_clock::time_point start;
};

Running start(const std::vector<Case>& cases, size_t index, double seconds) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  std::fflush(nullptr);
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("no process");
  if (process == 0) {
    close(ends[0]);
    run_in_child(cases[index], seconds, ends[1]);
  }
  close(ends[1]);
  return {index, process, ends[0], "", std::chrono::steady_clock::now()};
}

// Reads what there is; false at the end.
bool read_some(Running& child) {
  char buffer[4096];
  const ssize_t n = read(child.pipe, buffer, sizeof buffer);
  if (n > 0) child.text.append(buffer, size_t(n));
  return n > 0;
}

Result finish(const Running& child, double seconds) {
  close(child.pipe);
  int status = 0;
  waitpid(child.process, &status, 0);
  if (WIFSIGNALED(status))
    return {Outcome::failed,
            WTERMSIG(status) == SIGALRM ? "time limit of " + number(seconds) + " s"
                                        : std::string("crash: ") + strsignal(WTERMSIG(status)),
            0};
  Result result;
  int outcome = 0, begin = 0;
  if (std::sscanf(child.text.c_str(), "%d %lf\n%n", &outcome, &result.error, &begin) != 2)
    return {Outcome::failed, "the process ended without a result", 0};
  result.outcome = Outcome(outcome);
  result.text = child.text.substr(size_t(begin));
  return result;
}

}  // namespace

void Checks::add(const std::string& what, double error, double bound) {
  const double ratio = std::isfinite(error) ? std::abs(error) / bound : std::numeric_limits<double>::infinity();
  if (ratio <= worst_.error) return;
  worst_ = {ratio <= 1 ? Outcome::solved : Outcome::failed,
            what + " " + number(error) + " (bound " + number(bound) + ")", ratio};
}

void run_isolated(const std::vector<Case>& cases, double seconds, int n_processes, const OnResult& on_result) {
  struct Done {
    Result result;
    double seconds;
  };
  std::map<size_t, Done> done;  // not yet reported
  std::vector<Running> running;
  size_t next = 0, reported = 0;
  while (reported < cases.size()) {
    while (int(running.size()) < n_processes && next < cases.size()) running.push_back(start(cases, next++, seconds));
    std::vector<pollfd> waiting;
    for (const auto& child : running) waiting.push_back({child.pipe, POLLIN, 0});
    poll(waiting.data(), waiting.size(), -1);
    for (size_t k = running.size(); k-- > 0;) {
      if (waiting[k].revents == 0 || read_some(running[k])) continue;
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - running[k].start;
      done[running[k].index] = {finish(running[k], seconds), spent.count()};
      running.erase(running.begin() + k);
    }
    for (; done.count(reported) > 0; ++reported) {
      const Done one = done[reported];
      done.erase(reported);
      on_result(reported, one.result, one.seconds);
    }
  }
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto& group : {geometry_cases(), kinematics_cases(), mechanics_cases(), solver_cases()})
    cases.insert(cases.end(), group.begin(), group.end());
  return cases;
}

}  // namespace sem::stability
