// Where the text comes from: a file or the argument itself.
#pragma once

#include <filesystem>
#include <string>

namespace saltus::reader {

struct Source {
  std::string label;             ///< begins every message: the path as given, or "URDF text"
  std::filesystem::path folder;  ///< absolute; relative meshes are looked up here
  std::string text;              ///< UTF-8
  std::string flaw = {};         ///< of its encoding, see decode
};

/// @throws ModelError on a path that cannot be read, with what was tried; on text that is empty,
/// too long, binary, or in an encoding that is not known. `format`, "URDF" or "SRDF", is for
/// messages.
Source read_source(const std::string& path_or_text, const std::string& format = "URDF");

}  // namespace saltus::reader
