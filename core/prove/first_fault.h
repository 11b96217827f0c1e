// How far along a slider nothing goes wrong, by numbers at single places.
#pragma once

#include <functional>
#include <string>

namespace parsel {

/// What goes wrong at a value of a parameter, a clause; empty when nothing does.
using FaultAt = std::function<std::string(double)>;

/// The end of a range, and why it goes no further.
struct RangeEnd {
  double x = 0;
  std::string reason;  ///< empty where nothing was found to go wrong
};

/// Between `good`, where nothing is wrong, and `bad`, where it is for `reason`: the last good value that `halvings`
/// bisections find, and what is wrong at the bad value next to it.
RangeEnd bisect_fault(double good, double bad, std::string reason, int halvings, const FaultAt& fault);

/// From `from`, where nothing counts as wrong, towards `to` (on either side) in `steps` equal ones: the last good value
/// before the first bad step, bisected. {to, ""} when no step is bad; what goes wrong between two good steps is not
/// seen.
RangeEnd first_fault(double from, double to, int steps, int halvings, const FaultAt& fault);

/// After so many bisections an interval of `width` is no wider than `precision` (> 0).
int halvings_to(double width, double precision);

/// Ends of ranges are written with four decimals, rounded towards 0.
double shortened(double end);

}  // namespace parsel
