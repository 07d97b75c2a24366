// Names of two descriptions that become one: prefixes, and names that both have.
#pragma once

#include <set>
#include <string>

#include "saltus/model/model_builder.hpp"

namespace saltus {

/// The same description under other names.
void add_prefix(const AddSpec& how, ModelDescription& d);

struct Names {
  std::set<std::string> links, joints, half_spaces, groups, actuators, springs, loops, states,
      sensors;
};

Names names_of(const ModelDescription& d);

/// @throws ModelError on a name that both have; `given` is the prefix that the other has already.
void check_names(const ModelDescription& ours, const ModelDescription& other,
                 const std::string& given);

}  // namespace saltus
