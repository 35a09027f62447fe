#include "sem/solve/dense_kernels.h"

namespace sem {
namespace {

const DenseKernels& chosen_kernels() {
#ifdef SEM_X86_KERNELS
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
    return detail::avx512_dense_kernels;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return detail::avx2_dense_kernels;
#endif
  return detail::portable_dense_kernels;
}

}  // namespace

const DenseKernels& dense_kernels() {
  static const DenseKernels& kernels = chosen_kernels();
  return kernels;
}

}  // namespace sem
