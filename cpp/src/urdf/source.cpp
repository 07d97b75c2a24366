#include "urdf/source.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <vector>

#include "saltus/error.hpp"
#include "saltus/model/model.hpp"
#include "urdf/encoding.hpp"

namespace saltus::reader {
namespace {

namespace fs = std::filesystem;

// Real robots have 1e4 to 1e6 characters; a parsed document takes some ten times its text.
constexpr std::size_t max_size = std::size_t{64} << 20;
constexpr const char* white_space = " \t\r\n\v\f";
constexpr const char* byte_order_mark = "\xEF\xBB\xBF";

bool is_text(const std::string& argument) {
  const std::size_t begin = argument.rfind(byte_order_mark, 0) == 0 ? 3 : 0;
  const std::size_t first = argument.find_first_not_of(white_space, begin);
  return first != std::string::npos && argument[first] == '<';
}

/// A path in a message; whoever passes text by mistake is not shown all of it.
std::string show(const std::string& path) {
  return "\"" + (path.size() <= 200 ? path : path.substr(0, 200) + "...") + "\"";
}

std::string a(const std::string& format) { return (format == "SRDF" ? "an " : "a ") + format; }

/// "; URDF files there are a, b"; "" where the folder has none.
std::string files_in(const fs::path& folder, const std::string& format) {
  const std::string ending = format == "SRDF" ? ".srdf" : ".urdf";
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() == ending) names.push_back(it->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names.empty() ? "" : "; " + format + " files there are " + list_names(names);
}

[[noreturn]] void fail_missing(const std::string& path, const std::string& format) {
  if (path.find_first_not_of(white_space) == std::string::npos) {
    throw ModelError("an empty string is neither the path of " + a(format) + " file nor " + format +
                     " text");
  }
  std::error_code error;
  const fs::path tried = fs::absolute(path, error).lexically_normal();
  const fs::path folder = tried.parent_path();
  std::string what = "no file " + show(path);
  if (tried.is_relative() || tried.string() != path) what += "; tried " + show(tried.string());
  if (path.find('\n') != std::string::npos) {
    what += "; " + format + " text must begin with '<'";
  } else if (!fs::is_directory(folder, error)) {
    what += "; the folder " + show(folder.string()) + " does not exist";
  } else {
    what += files_in(folder, format);
  }
  throw ModelError(what);
}

/// Not by the file's size: what is no regular file (a pipe) has none.
std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ModelError("file " + show(path) + " cannot be opened for reading");
  std::string text;
  std::vector<char> block(1 << 16);
  while (file && text.size() <= max_size) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) throw ModelError("file " + show(path) + " cannot be read");
  return text;
}

Source read_path(const std::string& path, const std::string& format) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail_missing(path, format);
  if (fs::is_directory(status)) {
    throw ModelError(show(path) + " is a directory, not " + a(format) + " file" +
                     files_in(path, format));
  }
  return {path, fs::absolute(path, error).lexically_normal().parent_path(), read_file(path)};
}

void decode(Source& source, Origin origin) {
  try {
    Decoded decoded = decode(source.text, origin);
    source.text = std::move(decoded.text);
    if (!decoded.flaw.empty()) source.flaw = source.label + ": " + decoded.flaw;
  } catch (const ModelError& error) {
    throw ModelError(source.label + ": " + error.what());
  }
}

}  // namespace

Source read_source(const std::string& path_or_text, const std::string& format) {
  std::error_code error;
  const bool in_memory = is_text(path_or_text);
  Source source = in_memory ? Source{format + " text", fs::current_path(error), path_or_text}
                            : read_path(path_or_text, format);
  if (source.text.find_first_not_of(white_space) == std::string::npos) {
    throw ModelError(source.label + ": the file is empty");
  }
  if (source.text.size() > max_size) {
    throw ModelError(source.label + ": more than " + std::to_string(max_size >> 20) +
                     " MiB, the most that is read as " + format);
  }
  decode(source, in_memory ? Origin::memory : Origin::file);
  if (source.text.find('\0') != std::string::npos) {
    throw ModelError(source.label + ": not a text file (it contains zero bytes); " + format +
                     " is XML");
  }
  return source;
}

}  // namespace saltus::reader
