// What data URIs and file references are written in.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace parsel {

/// Base64 with padding (RFC 4648 §4).
std::string base64_encode(std::string_view bytes);
/// The bytes of base64 text, padding optional; none when another character occurs.
std::optional<std::string> base64_decode(std::string_view text);

/// %41 → A (RFC 3986 §2.1). A percent sign without two hexadecimal digits stays as it is.
std::string percent_decode(std::string_view uri);

}  // namespace parsel
