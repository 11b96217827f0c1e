// Where the files are that tests read.
#pragma once

#include <string>

namespace parsel::test {

/// The absolute path of `tests`. CMake writes the definition: a path on every compiler's command line would keep the
/// compiler's cache from finding what another checkout has compiled.
std::string tests_folder();

}  // namespace parsel::test
