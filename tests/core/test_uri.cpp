#include <doctest/doctest.h>

#include "core/base/random.h"
#include "core/base/uri.h"

using namespace parsel;

TEST_CASE("base64 agrees with the vectors of RFC 4648 and comes back for any bytes") {
  for (const auto& [bytes, text] : {std::pair{"", ""},
                                    {"f", "Zg=="},
                                    {"fo", "Zm8="},
                                    {"foo", "Zm9v"},
                                    {"foob", "Zm9vYg=="},
                                    {"fooba", "Zm9vYmE="},
                                    {"foobar", "Zm9vYmFy"}}) {
    CHECK(base64_encode(bytes) == text);
    CHECK(base64_decode(text) == bytes);
  }
  CHECK(base64_decode("Zm8") == "fo");
  CHECK_FALSE(base64_decode("Zm=8").has_value());
  CHECK_FALSE(base64_decode("Zm 8").has_value());
  Random random(7);
  for (int size = 0; size < 40; ++size) {
    std::string bytes;
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(random.below(256));
    CHECK(base64_decode(base64_encode(bytes)) == bytes);
  }
}

TEST_CASE("percent signs are decoded where two digits follow") {
  CHECK(percent_decode("my%20table%2Ebin") == "my table.bin");
  CHECK(percent_decode("100%") == "100%");
  CHECK(percent_decode("%4") == "%4");
  CHECK(percent_decode("%zz%41") == "%zzA");
}
