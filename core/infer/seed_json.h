// From the statements that models write to strict `parsel/edit` JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "core/shape/shape.h"

namespace parsel {

/// One statement. Keys that the operator does not take are left out; what its fields may be is said at
/// read_seed_reply(). Error place is a JSON pointer within the statement: "/origin".
Result<nlohmann::json> strict_statement(const Shape& shape, const nlohmann::json& loose);

}  // namespace parsel
