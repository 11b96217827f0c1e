#include "core/base/result.h"

namespace parsel {

std::string Error::message() const {
  std::string text = stage;
  if (!place.empty()) text += ": " + place;
  text += ": " + cause;
  if (!fix.empty()) text += "; " + fix;
  return text + ".";
}

}  // namespace parsel
