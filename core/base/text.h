// Text from outside, made fit for people and messages.
#pragma once

#include <string>
#include <string_view>

namespace parsel {

/// A name from the file for people and messages: control characters and broken UTF-8 removed, at most `limit` bytes.
std::string printable(std::string_view text, std::size_t limit = 64);

}  // namespace parsel
