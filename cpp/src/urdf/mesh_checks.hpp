// What is wrong with a mesh file that Assimp would not say, or not survive.
#pragma once

#include <filesystem>
#include <string>

namespace saltus::reader {

/// Throws ModelError with the rest of a sentence about a mesh file.
[[noreturn]] void fail_mesh(const std::string& what);

/// @throws ModelError on a text that stands for the file where it was not fetched (Git LFS).
void check_is_here(const std::filesystem::path& file);

/// @throws ModelError on an STL that is cut short; Assimp reads as far as an ASCII one goes, and
/// does not say why it refuses a binary one.
void check_stl(const std::filesystem::path& file, std::uintmax_t size);

/// @throws ModelError on a COLLADA file that is no XML, whose elements and nodes are nested more
/// than 500 deep, whose nodes contain themselves, or are more than 10^5 with all their instances:
/// Assimp follows them until its stack or the memory ends.
void check_dae(const std::filesystem::path& file);

}  // namespace saltus::reader
