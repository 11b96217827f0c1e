// Work on many items that may crash or hang: it runs in a child process, which is given up and started anew behind the
// item that it died of.
#pragma once

#include <functional>
#include <string>

namespace parsel::eval {

/// How the child's work ended.
struct Ending {
  enum class Kind { done, crashed, timed_out } kind = Kind::done;
  std::string detail;  ///< signal or exit code, and the last line on stderr
};

/// Runs `work` in a child process. It sends lines by the function it is given; `receive` gets them here, in order. The
/// child is ended when `seconds` pass without a line.
Ending run_isolated(const std::function<void(const std::function<void(const std::string&)>& send)>& work,
                    const std::function<void(const std::string& line)>& receive, double seconds);

}  // namespace parsel::eval
