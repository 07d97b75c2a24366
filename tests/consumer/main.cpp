// A project of somebody else's, found by find_package(saltus): it needs the headers, the library
// with what that links to in turn, and the URDF files beside it.
#include <saltus/saltus.hpp>

#include <iostream>

int main() {
  const saltus::Model model = saltus::load_urdf(SALTUS_URDF_DIR "/newtons_cradle_3.urdf");
  std::cout << model.n_q() << " coordinates\n";
}
