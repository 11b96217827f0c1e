// Reading editing programs in either form.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/edit/program.h"

namespace parsel::cli {

enum class ProgramForm { json, text };

struct ProgramFile {
  Program program;
  ProgramForm form = ProgramForm::json;
};

/// JSON when the first character that is no blank is '{', else the text form.
Result<ProgramFile> load_program(const std::string& path);

}  // namespace parsel::cli
