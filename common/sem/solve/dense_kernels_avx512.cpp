// Compiled with AVX-512: nothing that other files share may be included here, see dense_kernels_body.h.
#define SEM_KERNELS avx512_dense_kernels
#define SEM_KERNEL_NAME "AVX-512"
#define SEM_KERNEL_EIGEN sem_eigen_avx512
#include "sem/solve/dense_kernels_body.h"
