#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"
#include "shapes.h"

using namespace sem;
using namespace sem::test;

namespace {
std::atomic<long> n_allocations{0};
}

// Counts for this whole test binary. Not inlined: GCC would warn of a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++n_allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

template <int ParamDim, int Dim>
long allocations_when_repeated(std::mt19937& random, int degree) {
  const auto nurbs = random_nurbs<ParamDim, Dim>(random, degree, 5, true, true);
  const auto part = prepare(nurbs);
  std::vector<Hit<Dim>> hits;
  BasisValues<ParamDim> basis;
  std::vector<Vec<Dim>> X(20);
  for (auto& x : X)
    for (int k = 0; k < Dim; ++k) x[k] = uniform(random, -1, 1);
  long before = 0;
  for (int repeat = 0; repeat < 2; ++repeat) {
    before = n_allocations;
    for (const auto& x : X) {
      hits.clear();
      append_hits<Dim>(part, {x, X[0] + X[1]}, -1e9, 1e9, hits);
      const auto closest = closest_point<Dim>(part, x);
      evaluate_basis(nurbs, closest.u, 2, basis);
      derivatives(nurbs, closest.u);
    }
  }
  return n_allocations - before;
}

}  // namespace

TEST_CASE("evaluation, hits and closest points do not allocate when repeated") {
  std::mt19937 random(61);
  const long start = n_allocations;
  CHECK(allocations_when_repeated<1, 2>(random, 3) == 0);
  CHECK(allocations_when_repeated<1, 2>(random, 9) == 0);
  CHECK(allocations_when_repeated<2, 3>(random, 3) == 0);
  CHECK(n_allocations > start);  // the counter works
}
