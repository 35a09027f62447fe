#include "sem/solve/dense_kernels.h"

namespace sem {

std::vector<const DenseKernels*> available_dense_kernels() {
  std::vector<const DenseKernels*> available{&detail::portable_dense_kernels};
#ifdef SEM_X86_KERNELS
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2) available.push_back(&detail::avx2_dense_kernels);
  if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    available.push_back(&detail::avx512_dense_kernels);
#endif
  return available;
}

const DenseKernels& dense_kernels() {
  static const DenseKernels& best = *available_dense_kernels().back();
  return best;
}

}  // namespace sem
