// A Newton's cradle of three balls, the first let go at 0.3 rad. The first impact is at
// sqrt(I/g) K(sin 0.15) = 0.50460 s, I = 1.001 kg m^2 about the pivot.
#include <iomanip>
#include <iostream>
#include <saltus/saltus.hpp>

int main(int argc, char** argv) {
  const auto model = saltus::load_urdf(argc > 1 ? argv[1] : "urdf/newtons_cradle_3.urdf");
  const auto run = saltus::simulate(model, model.state({{"swing_0", 0.3}}), 10.0, {.h = 0.001});
  std::cout << std::fixed << std::setprecision(5) << "first impact at " << run.impacts[0].t
            << " s\n"
            << std::scientific << std::setprecision(1) << run.impacts.size()
            << " impacts, energy error " << run.energy_error() << "\n";
}
