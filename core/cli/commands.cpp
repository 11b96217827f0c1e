// The list of commands. Each lives in the file of its name.
#include "core/cli/command.h"

namespace parsel::cli {

extern const Command inspect_command;

std::span<const Command> commands() {
  static const std::vector<Command> all = {inspect_command};
  return all;
}

}  // namespace parsel::cli
