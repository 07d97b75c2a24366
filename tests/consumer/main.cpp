// A project of somebody else's: found by find_package(saltus), it needs the headers, the library with
// what it links to in turn, and the URDF files beside it.
#include <iostream>
#include <saltus/saltus.hpp>

int main() {
  const saltus::Model model = saltus::load_urdf(SALTUS_URDF_DIR "/newtons_cradle_3.urdf").build();
  std::cout << model->coordinates.size() << " coordinates\n";
}
