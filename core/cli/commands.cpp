// The list of commands. Each lives in the file of its name.
#include "core/cli/command.h"

namespace parsel::cli {

std::span<const Command> commands() {
  static const std::vector<Command> all = {};
  return all;
}

}  // namespace parsel::cli
