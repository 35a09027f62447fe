#pragma once
// Internal: a prepared NURBS laid out for the kernels.


#include "sem/nurbs/kernels.h"
#include "sem/nurbs/prepared.h"

namespace sem::detail {

/// Row j: coefficients of t^j in the Bernstein polynomials of (1 + t) / 2.
Eigen::MatrixXd powers_of_bernstein(int degree);

/// Null if powers lose too many digits: above degree 12, or where the terms' magnitudes add up to
/// more than 32 times their sum (high degrees, weights of very different size in one piece).
template <int ParamDim, int Dim>
std::shared_ptr<const PowerForm> make_power_form(const PreparedNurbs<ParamDim, Dim>& part);

}  // namespace sem::detail
