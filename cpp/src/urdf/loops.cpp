#include "urdf/loops.hpp"

#include <array>

#include "urdf/attributes.hpp"

namespace saltus::reader {
namespace {

LoopType type_of(const Document& document, const XMLElement& e, const Owner& owner) {
  constexpr std::array<LoopType, 4> types = {LoopType::point, LoopType::weld, LoopType::distance,
                                             LoopType::on_plane};
  const std::string given = attribute(e, "type");
  std::vector<std::string> known;
  for (const LoopType each : types) {
    known.push_back(loop_type_name(each));
    if (known.back() == given) return each;
  }
  document.fail(e, owner, "has type=" + in_quotes(given) + "; known are " + list_names(known));
}

At checked_end(const Document& document, const XMLElement& e, const Owner& owner, const At& end) {
  if (document.find("link", end.link) != nullptr) return end;
  document.fail(e, owner,
                "names link " + in_quotes(end.link) + ", which does not exist; links are " +
                    list_names(document.names("link")));
}

}  // namespace

bool add_loop_element(const Document& document, const XMLElement& e, ModelBuilder& builder) {
  const std::string kind = e.Name();
  if (kind != "loop" && kind != "coupling" && kind != "prescribed") return false;
  const Owner owner{kind, attribute(e, kind == "loop" ? "name" : "joint")};
  try {
    if (kind == "loop") {
      const auto end = [&](const At& at) { return checked_end(document, e, owner, at); };
      builder.add_loop(owner.name, type_of(document, e, owner),
                       end(end_on(e, "link1", "xyz1", "rpy1")),
                       end(end_on(e, "link2", "xyz2", "rpy2")), number(e, "distance", 0));
    } else if (kind == "coupling") {
      builder.add_coupling(owner.name, attribute(e, "of"),
                           numbers(document, e, owner, "polynomial"));
    } else {
      builder.set_prescribed(owner.name, numbers(document, e, owner, "times"),
                             numbers(document, e, owner, "values"));
    }
  } catch (const ModelError& error) {
    if (std::string(error.what()).find(document.at(e)) == 0) throw;
    throw ModelError(document.at(e) + error.what(), error.element, error.name);
  }
  return true;
}

}  // namespace saltus::reader
