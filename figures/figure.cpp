#include "figures/figure.h"

#include "sem/draw/image.h"
#include "sem/scene/files.h"

namespace sem::figures {

const std::vector<Figure>& all_figures() {
  static const std::vector<Figure> figures = {teaser(),
                                              nurbs_curve(),
                                              nurbs_surface(),
                                              error_energy(),
                                              distance_construction(),
                                              distance_weights(),
                                              raycast_quadrature(),
                                              theta_function(),
                                              limb_weights(),
                                              origin_network(),
                                              projection_blocks(),
                                              quadrature_convergence(),
                                              quadrature_work(),
                                              patch_test(),
                                              deflection_parts(),
                                              condensed_convergence(),
                                              error_estimates(),
                                              manufactured(),
                                              work_precision(),
                                              stiffness_sparsity(),
                                              nonzeros_step_time(),
                                              pruning(),
                                              integrators(),
                                              integrators_work(),
                                              release(),
                                              solid_quadrature(),
                                              limb_slices(),
                                              torus_origins(),
                                              beam_parts_3d(),
                                              work_precision_3d(),
                                              growing_beam(),
                                              beam_sparsity(),
                                              twist(),
                                              gallery_3d(),
                                              cad_models(),
                                              teaser_3d()};
  return figures;
}

Plot plot_of(const Figure& figure, const Data& data) {
  Plot plot(figure.width, figure.height);
  figure.draw(plot, data);
  return plot;
}

void make_figure(const Figure& figure, const std::string& folder) {
  const std::string path = folder + "/" + figure.name;
  write_file(path + ".csv", to_csv(figure.compute()));
  const Plot plot = plot_of(figure, from_csv(read_file(path + ".csv"), path + ".csv"));
  write_png(path + ".png", plot_image(plot, dots_per_inch), dots_per_inch);
  write_file(path + ".svg", plot_svg(plot, dots_per_inch));
}

}  // namespace sem::figures
