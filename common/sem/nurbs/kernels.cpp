#include "sem/nurbs/kernels.h"

namespace sem::detail {
namespace {

const Kernels* best_kernels() {
#ifdef SEM_AVX2_KERNELS
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return &avx2_kernels;
#endif
  return &portable_kernels;
}

}  // namespace

// Valid before the initialisers of other files have run, then the best.
constinit const Kernels* kernels = &portable_kernels;
[[maybe_unused]] static const bool chosen = (kernels = best_kernels(), true);

}  // namespace sem::detail
