#pragma once
// Dimension-free tests: TEST_CASE_TEMPLATE("...", T, D2, D3) with Dim = T::value.

#include <doctest/doctest.h>

#include <type_traits>

using D2 = std::integral_constant<int, 2>;
using D3 = std::integral_constant<int, 3>;
TYPE_TO_STRING_AS("2D", D2);
TYPE_TO_STRING_AS("3D", D3);
