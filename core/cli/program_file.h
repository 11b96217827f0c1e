// Reading editing programs in either form, and the values that options give their parameters.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/cli/command.h"
#include "core/edit/program.h"

namespace parsel::cli {

enum class ProgramForm { json, text };

struct ProgramFile {
  Program program;
  ProgramForm form = ProgramForm::json;
};

/// JSON when the first character that is no blank is '{', else the text form.
Result<ProgramFile> load_program(const std::string& path);

/// Puts the value of a parameter into `values`, one a layer. Error, with that place: no layer has the parameter, or the
/// value is not within its range.
Status set_value(const Program& program, const std::string& parameter, double value, const std::string& place,
                 std::vector<double>& values);

/// One value a layer: `--set x1=0.2` for some of the parameters; the others have their value in the program.
Result<std::vector<double>> parameter_values(const Program& program, const Arguments& arguments);

}  // namespace parsel::cli
