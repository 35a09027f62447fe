#include "sem/solve/dense_kernels.h"

namespace sem {

const DenseKernels& dense_kernels() {
#ifdef SEM_AVX2_KERNELS
  static const bool has_avx2 = (__builtin_cpu_init(), __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"));
  if (has_avx2) return detail::avx2_dense_kernels;
#endif
  return detail::portable_dense_kernels;
}

}  // namespace sem
