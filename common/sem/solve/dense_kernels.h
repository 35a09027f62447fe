#pragma once
// The dense inner loops of factorisation and assembly: Eigen's, compiled once for every processor and once
// with AVX2 and FMA (2 to 3 times faster there), once with AVX-512; which ones run is decided when the program
// starts. All matrices are stored by columns; ld: entries from one column to the next.

#include <vector>

namespace sem {

/// A set of instructions' kernels.
struct DenseKernels {
  const char* name;  ///< of the instructions
  /// A = L L^T in the lower triangle of the n by n A, in place; the rest is not touched. False if A is not
  /// positive definite.
  bool (*cholesky)(double* A, int n, int ld);
  /// B := B L^-T, B m by n, L n by n, its lower triangle read.
  void (*solve_right)(const double* L, int ld_l, double* B, int ld_b, int m, int n);
  /// C += factor A B^T, C m by n, A m by k, B n by k.
  void (*add_scaled_product)(double factor, double* C, int ld_c, const double* A, int ld_a, const double* B, int ld_b, int m, int n, int k);
  /// C += A^T B, C m by n, A k by m, B k by n.
  void (*add_product)(double* C, int ld_c, const double* A, int ld_a, const double* B, int ld_b, int m, int n, int k);
  /// The lower triangle of C += A^T B, C n by n, for a product that is symmetric.
  void (*add_lower_product)(double* C, int ld_c, const double* A, int ld_a, const double* B, int ld_b, int n, int k);
  /// C = sum_d diag(factor_d) A_d, m by n, A the A_d one below the other, n_factors m by n.
  void (*weigh_rows)(double* C, int ld_c, const double* const* factors, int n_factors, const double* A, int ld_a, int m, int n);
  /// A panel of a symmetric matrix times a vector: the n by n A above the m by n B, of A the lower triangle read;
  /// y += A x + B^T u, v = B x.
  void (*multiply_panel)(const double* A, int ld, int n, int m, const double* x, const double* u, double* y, double* v);
};

/// Those that this processor runs, the fastest last.
std::vector<const DenseKernels*> available_dense_kernels();
/// The fastest of them.
const DenseKernels& dense_kernels();

namespace detail {
extern const DenseKernels portable_dense_kernels, avx2_dense_kernels, avx512_dense_kernels;
}

}  // namespace sem
