// SHA-256 (FIPS 180-4), to name a model by its bytes.
#pragma once

#include <string>
#include <string_view>

namespace parsel {

/// The digest of `bytes` in 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace parsel
