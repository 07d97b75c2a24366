#include "urdf/encoding.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

#include "saltus/error.hpp"

namespace saltus::reader {
namespace {

void append(std::uint32_t c, std::string& out) {
  const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | (c >> 6)), put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | (c >> 12)), put(0x80 | ((c >> 6) & 0x3F)), put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | (c >> 18)), put(0x80 | ((c >> 12) & 0x3F));
    put(0x80 | ((c >> 6) & 0x3F)), put(0x80 | (c & 0x3F));
  }
}

/// How many bytes the character at `i` has; 0 where it is none of UTF-8.
std::size_t length_at(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
  };
  const unsigned first = byte(i);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xC0) != 0x80) return 0;
  }
  const unsigned second = byte(i + 1);  // too long, surrogates, above U+10FFFF
  const bool is_wrong = (first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) ||
                        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90);
  return is_wrong ? 0 : length;
}

/// Where UTF-8 ends, the text's size if nowhere.
std::size_t end_of_utf8(const std::string& text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t length = length_at(text, i);
    if (length == 0) break;
    i += length;
  }
  return i;
}

std::string from_bytes(const std::string& bytes, bool windows) {
  // windows-1252 from 0x80 on; the five that it has not are as in Latin-1
  constexpr std::array<std::uint32_t, 32> special = {
      0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
      0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
      0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};
  std::string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    append(windows && byte >= 0x80 && byte < 0xA0 ? special[byte - 0x80] : byte, out);
  }
  return out;
}

std::string from_utf16(const std::string& bytes, bool big_end_first) {
  const auto unit = [&](std::size_t i) -> std::uint32_t {
    const auto a = static_cast<unsigned char>(bytes[i]);
    const auto b = static_cast<unsigned char>(bytes[i + 1]);
    return big_end_first ? (a << 8) | b : (b << 8) | a;
  };
  std::string out;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t c = unit(i);
    if (c >= 0xD800 && c < 0xE000) {
      const std::uint32_t low = i + 3 < bytes.size() ? unit(i + 2) : 0;
      if (c >= 0xDC00 || low < 0xDC00 || low >= 0xE000) {
        throw ModelError("is no UTF-16: half a character at byte " + std::to_string(i));
      }
      c = 0x10000 + (((c - 0xD800) << 10) | (low - 0xDC00));
      i += 2;
    }
    append(c, out);
  }
  return out;
}

/// Where the name of the encoding is in `<?xml version="1.0" encoding="UTF-8"?>`; none is empty.
struct Span {
  std::size_t begin = 0, size = 0;
};

Span declared(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos || text.compare(begin, 5, "<?xml") != 0) return {};
  const std::size_t end = text.find("?>", begin), at = text.find("encoding", begin);
  if (end == std::string::npos || at > end) return {};
  const std::size_t open = text.find_first_of("\"'", at);
  if (open > end) return {};
  const std::size_t close = text.find(text[open], open + 1);
  return close > end ? Span{} : Span{open + 1, close - open - 1};
}

/// "Windows-1252" as "windows1252".
std::string simple(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter)) out += static_cast<char>(std::tolower(letter));
  }
  return out;
}

bool is_one_of(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Decoded from_undeclared(const std::string& text, const std::string& encoding) {
  const std::size_t end = end_of_utf8(text);
  if (end == text.size()) return {text, ""};
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  return {from_bytes(text, true), "has bytes that are no UTF-8, the first in line " +
                                      std::to_string(line) +
                                      (encoding.empty() ? ", and does not say its encoding"
                                                        : ", and says that it is " + encoding) +
                                      "; it is read as windows-1252"};
}

Decoded from_declared(const std::string& text) {
  const Span span = declared(text);
  const std::string encoding = text.substr(span.begin, span.size), name = simple(encoding);
  if (is_one_of(name, {"", "utf8", "ascii", "usascii", "utf16"})) {
    return from_undeclared(text, encoding);  // as UTF-16 such a text would not be readable here
  }
  const bool windows = is_one_of(name, {"windows1252", "cp1252"});
  if (!windows && !is_one_of(name, {"iso88591", "latin1", "l1"})) {
    throw ModelError("is in encoding \"" + encoding +
                     "\", which is not known; known are UTF-8, UTF-16, ISO-8859-1, "
                     "windows-1252 (iconv -f " +
                     encoding + " -t UTF-8 makes it UTF-8)");
  }
  // one that is declared and was saved as UTF-8 all the same is UTF-8: no text looks so by chance
  const bool is_utf8 = end_of_utf8(text) == text.size();
  std::string out = is_utf8 ? text : from_bytes(text, windows);
  return {out.replace(span.begin, span.size, "UTF-8"), ""};
}

}  // namespace

Decoded decode(const std::string& bytes, Origin origin) {
  const auto begins = [&](const char* mark, std::size_t size) {
    return bytes.compare(0, size, mark, size) == 0;
  };
  const bool big = begins("\xFE\xFF", 2) || begins("\0<", 2);
  if (big || begins("\xFF\xFE", 2) || begins("<\0", 2)) {
    std::string text = from_utf16(bytes, big);
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
    const Span span = declared(text);
    if (span.size > 0) text.replace(span.begin, span.size, "UTF-8");
    return {text, ""};
  }
  const std::size_t last = bytes.find_last_not_of(std::string(" \t\r\n\0", 5));
  const std::size_t zero = bytes.find('\0');
  if (zero == std::string::npos || last == std::string::npos || zero < last) {
    return origin == Origin::file ? from_declared(bytes) : from_undeclared(bytes, "");
  }
  Decoded out = decode(bytes.substr(0, zero), origin);
  if (out.flaw.empty()) out.flaw = "ends with a zero byte";
  return out;
}

}  // namespace saltus::reader
