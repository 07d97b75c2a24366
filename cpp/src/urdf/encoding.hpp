// Texts of any encoding as UTF-8.
#pragma once

#include <string>

namespace saltus::reader {

/// Text in memory is UTF-8, whatever its declaration says of the file that it was in.
enum class Origin { file, memory };

struct Decoded {
  std::string text;  ///< UTF-8
  std::string flaw;  ///< what was not as it should be; "" where all was
};

/// The bytes of a file by its byte order mark or its XML declaration, which says UTF-8 afterwards.
/// Where it says nothing and they are no UTF-8, they are taken for windows-1252. Zero bytes at the
/// end are left out.
/// @throws ModelError "is in encoding ...", what a sentence about the file goes on with.
Decoded decode(const std::string& bytes, Origin origin);

}  // namespace saltus::reader
