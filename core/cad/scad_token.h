// OpenSCAD's words: names, numbers, strings and signs with their places, and the comments that say something.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/cad/model.h"

namespace parsel::cad {

struct Token {
  enum class Kind { name, number, string, sign, end };
  Kind kind = Kind::end;
  std::string text;  ///< of a string: what it says, escapes resolved
  double number = 0;
  Place place;
  std::string note;     ///< the only line of comment that stands alone right above, trimmed; empty when there is none
  std::string remark;   ///< the comment that follows on the token's own line, trimmed: of a `;` or `}`
  std::string section;  ///< the Customizer's section that it stands in: /* [Legs] */
};

/// Any bytes → tokens, the last one of kind end. Error stage "cad/read", place "line L, column C".
Result<std::vector<Token>> scad_tokens(std::string_view text);

/// An error of reading, at a place.
Error refusal(const Place& place, std::string cause, std::string fix);

}  // namespace parsel::cad
