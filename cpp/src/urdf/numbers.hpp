// Numbers in attributes, the same in every locale.
#pragma once

#include <string>
#include <vector>

namespace saltus::reader {

struct Numbers {
  std::vector<double> values;
  std::string
      bad;  ///< the first word that is no number or has no double; then values end before it
  bool has_commas = false;  ///< read as white space
  bool has_dots = false;    ///< "1.5.", read as 1.5
};

/// Words separated by white space. "inf" and "nan" are numbers here; the caller judges them.
Numbers parse_numbers(const std::string& text);

/// The shortest text that reads back as the same double.
std::string print_number(double value);

}  // namespace saltus::reader
