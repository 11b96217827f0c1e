// The list of commands. Each lives in the file of its name.
#include "core/cli/command.h"

namespace parsel::cli {

extern const Command apply_command;
extern const Command cad_command;
extern const Command check_command;
extern const Command convert_command;
extern const Command evaluate_command;
extern const Command family_command;
extern const Command gallery_command;
extern const Command inspect_command;
extern const Command job_command;
extern const Command offers_command;
extern const Command prompt_command;
extern const Command propagate_command;
extern const Command read_command;
extern const Command reply_command;
extern const Command sample_command;
extern const Command score_command;
extern const Command split_command;

std::span<const Command> commands() {
  static const std::vector<Command> all = {
      inspect_command, offers_command, read_command,  prompt_command, reply_command,   propagate_command,
      apply_command,   sample_command, check_command, score_command,  convert_command, evaluate_command,
      cad_command,     family_command, split_command, job_command,    gallery_command};
  return all;
}

}  // namespace parsel::cli
