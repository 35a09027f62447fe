#pragma once
// Which control points the polynomials of every part depend on: tables, and their picture.

#include "figures/figure.h"
#include "sem/method/discretization.h"

namespace sem::figures {

/// Adds the tables `size` and `first_control` that draw_projection needs.
template <int Dim>
void add_projection_size(Data& data, const Discretization<Dim>& body);

/// Adds a table of the entries of the projection p -> (c, t) that are not zero: rows by part, in a
/// part the translation, then the monomials by degree.
template <int Dim>
void add_projection(Data& data, const std::string& name, const Projection<Dim>& projection);

/// The entries of such a table as cells, coloured by degree, with lines between parts.
void draw_projection(Panel& panel, const Data& data, const std::string& name);

}  // namespace sem::figures
