// sem_stability: every hard case in a process of its own, and a table of what happened.
#include <cstdio>
#include <fstream>

#include <CLI/CLI.hpp>

#include "sem/base/error.h"
#include "tests/hard_cases/case.h"
#include "tests/hard_cases/picture.h"

namespace {

using namespace sem;
using namespace sem::stability;

const char* verdict(const Row& row) { return row.failed() ? "FAIL" : row.refused() ? "refused" : "pass"; }

const char* rule_name(Rule rule) { return rule == Rule::must_solve ? "must" : "may"; }

void print(const Row& row) {
  std::printf("%-7s %-4s %-10s %-38s %-13s %7.2f s  %s\n", verdict(row), rule_name(row.one.rule),
              row.one.group.c_str(), row.one.name.c_str(), row.one.variant.c_str(), row.seconds,
              row.result.text.c_str());
  std::fflush(stdout);
}

std::string quoted(std::string text) {
  for (size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, "\"");
  return '"' + text + '"';
}

void write_csv(const std::string& file, const std::vector<Row>& rows) {
  std::ofstream out(file);
  out << "group,case,variant,rule,verdict,error_by_bound,what_happened\n";
  for (const auto& row : rows)
    out << row.one.group << ',' << quoted(row.one.name) << ',' << row.one.variant << ',' << rule_name(row.one.rule)
        << ',' << verdict(row) << ',' << row.result.error << ',' << quoted(row.result.text) << '\n';
  if (!out) throw InputError("", "--csv", file, "a file that can be written");
}

// At most a tenth of all may be refused.
int summarise(const std::vector<Row>& rows, bool all) {
  int n_failed = 0, n_refused = 0;
  for (const auto& row : rows) {
    n_failed += row.failed();
    n_refused += row.refused();
  }
  const bool too_many = all && 10 * n_refused > int(rows.size());
  std::printf("\n%zu cases: %zu solved, %d refused%s, %d failed\n", rows.size(),
              rows.size() - size_t(n_refused) - size_t(n_failed), n_refused, too_many ? " (more than a tenth)" : "",
              n_failed);
  return n_failed > 0 || too_many;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Runs the hard cases, each in a process of its own, and prints what happened. Exit code 1: a case "
               "failed, or more than a tenth were refused."};
  bool fast = false, list = false;
  double seconds = 120;
  int n_processes = 2;
  std::string only, csv, picture;
  app.add_flag("--fast", fast, "the fast subset");
  app.add_flag("--list", list, "names the cases");
  app.add_option("--only", only, "cases whose group, name or variant contains this");
  app.add_option("--csv", csv, "also writes the table to this file");
  app.add_option("--picture", picture, "also draws the table as a matrix (.png or .svg)");
  app.add_option("--seconds", seconds, "time limit of a case")->check(CLI::PositiveNumber);
  app.add_option("--processes", n_processes, "cases at a time")->check(CLI::Range(1, 64));
  CLI11_PARSE(app, argc, argv);
  std::vector<Case> cases;
  for (const auto& one : all_cases()) {
    const std::string label = one.group + ": " + one.name + " " + one.variant;
    if ((fast && !one.fast) || label.find(only) == std::string::npos) continue;
    if (list) std::printf("%s\n", label.c_str());
    cases.push_back(one);
  }
  if (list) return 0;
  if (!picture.empty()) check_picture_name(picture);
  if (cases.empty()) throw InputError("", "--only", only, "part of a case's name (--list)");
  std::vector<Row> rows;
  run_isolated(cases, seconds, n_processes, [&](size_t k, const Result& result, double spent) {
    rows.push_back({cases[k], result, spent});
    print(rows.back());
  });
  if (!csv.empty()) write_csv(csv, rows);
  if (!picture.empty()) write_picture(picture, rows);
  return summarise(rows, only.empty() && !fast);
} catch (const InputError& error) {
  std::fprintf(stderr, "sem_stability: %s\n", error.what());
  return 2;
}
