#define SEM_KERNELS portable_dense_kernels
#define SEM_KERNEL_NAME "baseline"
#define SEM_KERNEL_EIGEN sem_eigen_portable
#include "sem/solve/dense_kernels_body.h"
