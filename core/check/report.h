// What the checker has found.
#pragma once

#include <string>
#include <vector>

namespace parsel {

/// Something that is not as the program or its trace says.
struct Finding {
  std::string place;  ///< a JSON pointer into the program, or "trace" and one into the trace
  std::string text;
  std::string fix;  ///< what would remove it, in the imperative
};

struct CheckReport {
  std::vector<Finding> findings;
  int relations = 0;  ///< reports compared
  int samples = 0;    ///< parameter values looked at, over all layers
  int claims = 0;     ///< statements of the trace replayed
  bool accepted() const { return findings.empty(); }
};

}  // namespace parsel
