#include "postproc/figures/plot_style.hpp"

namespace cupola {

std::string plot_style() {
  return "set border 3 lc rgb '#444444'\nset tics nomirror textcolor rgb '#222222'\n"
         "set grid lc rgb '#cccccc' lw 1\nset key opaque samplen 2 spacing 1.1\n";
}

ForceUnit force_unit(double largest) {
  if (largest >= 1e5) return {1e-6, "MN"};
  if (largest >= 100.0) return {1e-3, "kN"};
  return {1.0, "N"};
}

bool is_vault(const Evaluation& e) {
  return e.shell.num_rings() > 0 &&
         traits_of(e.scene.geometry.surface).meridians == SurfaceTraits::Meridians::by_azimuth;
}

}  // namespace cupola
