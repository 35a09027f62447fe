// Compiled with AVX2 and FMA: only plain data may be included here, see kernels.h.
#define SEM_KERNELS avx2_kernels
#include "sem/nurbs/kernels_body.h"
