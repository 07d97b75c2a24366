#include "urdf/numbers.hpp"

#include <charconv>

namespace saltus::reader {

Numbers parse_numbers(const std::string& text) {
  constexpr const char* white_space = " \t\r\n\v\f,";
  Numbers numbers;
  numbers.has_commas = text.find(',') != std::string::npos;
  for (std::size_t begin = text.find_first_not_of(white_space); begin != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(white_space, begin), text.size());
    const char* first = text.data() + begin;
    const char* last = text.data() + end;
    // from_chars knows no "+1", which other readers take
    if (*first == '+' && end - begin > 1 && first[1] != '-') ++first;
    double value = 0;
    const auto [stop, error] = std::from_chars(first, last, value);
    const bool has_dot = error == std::errc() && stop + 1 == last && *stop == '.';
    numbers.has_dots = numbers.has_dots || has_dot;
    if (error != std::errc() || (stop != last && !has_dot)) {
      numbers.bad = text.substr(begin, end - begin);
      return numbers;
    }
    numbers.values.push_back(value);
    begin = text.find_first_not_of(white_space, end);
  }
  return numbers;
}

std::string print_number(double value) {
  char text[32];  // -2.2250738585072014e-308 has 24
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace saltus::reader
