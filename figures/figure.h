#pragma once
// A figure: its numbers first, then a picture drawn only from them.
//
// To write one:
//  1. figures/NAME.cpp holds, in an unnamed namespace, `Data compute()` and
//     `void draw(Plot& plot, const Data& data)`, and below it `Figure NAME() { return {...}; }`.
//  2. compute() runs the method and fills tables (data.h): one table per kind of thing, one row per
//     thing, units in SI, names of columns that say what they hold. Columns that depend on the
//     machine end in `_seconds` (or stand in Figure::measured): their values are not compared.
//  3. draw() sets up panels (sem/plot/plot.h) from the tables and nothing else. The tool has
//     written the tables to NAME.csv and read them back. No number is typed in except truths with
//     their source.
//  4. Declare NAME() below, list it in all_figures() (figure.cpp) and in CMakeLists.txt.
//  5. Look at NAME.png at 100 %, then `sem_figures NAME --update` stores its reference.

#include <functional>
#include <string>
#include <vector>

#include "figures/data.h"
#include "sem/plot/plot.h"

namespace sem::figures {

inline constexpr double dots_per_inch = 300;

struct Figure {
  std::string name;
  std::string caption;   ///< what it shows, for the gallery and --list
  double width, height;  ///< inches; 3.3 or 7 wide
  std::function<Data()> compute;
  std::function<void(Plot&, const Data&)> draw;
  std::vector<std::string> measured = {};  ///< columns that no check compares, besides *_seconds
  /// compute() takes longer than some 5 s. The stored reference has all numbers, and takes their
  /// place unless the figure is asked for by name.
  bool slow = false;
};

/// All figures, in the order of the gallery.
const std::vector<Figure>& all_figures();

/// Writes NAME.csv into the folder, then NAME.png (300 dots per inch) and NAME.svg from what the
/// file holds. Throws InputError if a file cannot be written.
void make_figure(const Figure& figure, const std::string& folder);

/// The plot of the figure with these numbers.
Plot plot_of(const Figure& figure, const Data& data);

Figure teaser();
Figure nurbs_curve();
Figure nurbs_surface();
Figure error_energy();
Figure distance_construction();
Figure distance_weights();
Figure raycast_quadrature();
Figure theta_function();
Figure limb_weights();
Figure origin_network();
Figure projection_blocks();
Figure quadrature_convergence();
Figure quadrature_work();
Figure patch_test();
Figure deflection_parts();
Figure condensed_convergence();
Figure error_estimates();
Figure manufactured();
Figure work_precision();
Figure work_precision_3d();
Figure stiffness_sparsity();
Figure nonzeros_step_time();
Figure pruning();
Figure integrators();
Figure integrators_work();
Figure release();
Figure solid_quadrature();
Figure limb_slices();
Figure torus_origins();
Figure beam_parts_3d();
Figure growing_beam();
Figure beam_sparsity();
Figure twist();
Figure gallery_3d();
Figure cad_models();
Figure teaser_3d();

}  // namespace sem::figures
