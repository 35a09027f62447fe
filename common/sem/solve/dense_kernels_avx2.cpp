// Compiled with AVX2 and FMA: nothing that other files share may be included here, see dense_kernels_body.h.
#define SEM_KERNELS avx2_dense_kernels
#define SEM_KERNEL_NAME "AVX2"
#define SEM_KERNEL_EIGEN sem_eigen_avx2
#include "sem/solve/dense_kernels_body.h"
