#include "tests/hard_cases/body_cases.h"

namespace sem::stability {
namespace {

template <int Dim>
Result run_body_case(const BodyCase& one, Formulation formulation) {
  const Body<Dim> unchanged = body_of<Dim>(one.shape);
  const auto& change = std::get<BodyChange<Dim>>(one.change);
  const Body<Dim> body = change ? change(unchanged) : unchanged;
  Checks checks;
  const double lowered = check_body(body, formulation, one.bounds, one.method, checks);
  if (one.as_unchanged) {
    Checks other;
    const double expected = check_body(unchanged, formulation, one.bounds, one.method, other);
    checks.add("change of displacement", lowered / expected - 1, one.bounds.balance);
  }
  return checks.result();
}

bool has_prism(const PlaneShape& shape) {
  for (const auto& solid : shape.solids)
    if (solid.cells.empty()) return false;
  return true;
}

}  // namespace

void add_body_case(std::vector<Case>& cases, const std::string& group, const BodyCase& one) {
  for (const Formulation formulation : both_formulations)
    cases.push_back({group, one.name, variant<2>(formulation), one.rule, one.fast,
                     [=] { return run_body_case<2>(one, formulation); }});
  if (!has_prism(one.shape)) return;
  for (const Formulation formulation : both_formulations)
    cases.push_back({group, one.name, variant<3>(formulation), one.rule, one.fast_3d,
                     [=] { return run_body_case<3>(one, formulation); }});
}

}  // namespace sem::stability
