#include "core/prove/first_fault.h"

#include <cmath>
#include <utility>

namespace parsel {

namespace {
constexpr double decimals = 1e4;
}

RangeEnd bisect_fault(double good, double bad, std::string reason, int halvings, const FaultAt& fault) {
  for (int k = 0; k < halvings; ++k) {
    const double middle = (good + bad) / 2;
    std::string here = fault(middle);
    if (here.empty()) {
      good = middle;
    } else {
      bad = middle;
      reason = std::move(here);
    }
  }
  return {good, std::move(reason)};
}

RangeEnd first_fault(double from, double to, int steps, int halvings, const FaultAt& fault) {
  if (from == to) return {to, ""};
  double good = from;
  for (int i = 1; i <= steps; ++i) {
    const double next = i == steps ? to : from + (to - from) * i / steps;
    std::string reason = fault(next);
    if (!reason.empty()) return bisect_fault(good, next, std::move(reason), halvings, fault);
    good = next;
  }
  return {to, ""};
}

int halvings_to(double width, double precision) {
  return width > precision ? static_cast<int>(std::ceil(std::log2(width / precision))) : 0;
}

double shortened(double end) {
  return std::trunc(end * decimals) / decimals;
}

}  // namespace parsel
