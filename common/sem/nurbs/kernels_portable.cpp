#define SEM_KERNELS portable_kernels
#include "sem/nurbs/kernels_body.h"
