#pragma once

#include <string>
#include <string_view>

namespace gazeloop::drivers {

/// JSON has no NaN and no infinity, and its readers refuse a number beyond a double's range.
/// Programs write them all the same: "NaN", "-Infinity", "inf", "1e999". The text with those in
/// quotes, so that each is a text where a number is asked for. Strings are left as they are.
[[nodiscard]] std::string with_numbers_quoted_that_json_lacks(std::string_view json);

}  // namespace gazeloop::drivers
