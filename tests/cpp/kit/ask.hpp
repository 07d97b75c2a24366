// What errors say, and what a model says of a pair.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "saltus/model/model.hpp"

namespace saltus::test {

/// The message of the error that this throws; "" (and a failure) if it throws none.
template <class Error = ModelError, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "no \"" << part << "\" in: " << text;
}

/// This throws a ModelError whose message contains all parts.
template <class Call>
void expect_error(const Call& call, const std::vector<std::string>& parts) {
  const std::string text = message_of(call);
  for (const std::string& part : parts) expect_contains(text, part);
}

/// Likewise, about an element with this name.
template <class Call>
void expect_error(const Call& call, const std::string& element, const std::string& name,
                  const std::vector<std::string>& parts) {
  expect_error(call, parts);
  try {
    call();
  } catch (const ModelError& error) {
    EXPECT_EQ(error.element, element) << error.what();
    EXPECT_EQ(error.name, name) << error.what();
  }
}

/// What happens between the two shapes of the pair with this name.
inline ContactProperties between(const Model& model, const std::string& pair) {
  for (int k = 0; k < model->pairs.size(); ++k) {
    if (model.pair_name(k) == pair) return model.contact_properties(k);
  }
  throw ModelError("no pair " + pair);
}

}  // namespace saltus::test
